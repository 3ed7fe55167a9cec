#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "geometry/curve/cubic_bezier.h"

namespace icome::drawing {

/// A line that a path draws without lifting the pen, in the units of its data.
struct SvgSubpath {
  std::vector<geometry::CubicBezier> segments;
  bool closed = false;
};

/// Makes subpaths out of what a path or a shape draws, as cubics: lines and quadratics exactly, arcs within
/// 3e-5 of their radius.
class SvgPathBuilder {
 public:
  using Vector2 = base::Vector2;

  void move_to(const Vector2& to);
  void line_to(const Vector2& to);
  void cubic_to(const Vector2& control1, const Vector2& control2, const Vector2& to);
  void quadratic_to(const Vector2& control, const Vector2& to);
  /// An elliptical arc as SVG 2, appendix B.2, has it: `turn` is the angle (rad) of the ellipse's x axis,
  /// `large` and `sweep` choose one of four arcs. Radii that are too small for it grow.
  void arc_to(const Vector2& radii, double turn, bool large, bool sweep, const Vector2& to);
  /// Draws a line to the start where there is one to draw.
  void close();

  const Vector2& current() const { return current_; }
  std::size_t segment_count() const { return segments_; }
  /// Those with a segment at least. Call once.
  std::vector<SvgSubpath> take();

 private:
  void append(const geometry::CubicBezier& segment);

  std::vector<SvgSubpath> subpaths_;
  Vector2 start_ = Vector2::Zero(), current_ = Vector2::Zero();
  bool is_moved_ = false;    // to where nothing was drawn yet
  bool is_drawing_ = false;  // the last subpath goes on
  std::size_t segments_ = 0;
};

/// The lines of an element, as far as they can be read.
struct SvgShape {
  std::vector<SvgSubpath> subpaths;
  std::string
      fault;  ///< what ended the reading, as a sentence without file and line; empty where nothing did
};

/// The subpaths of path data: all commands of SVG, up to the first fault.
SvgShape parse_svg_path(std::string_view data);

}  // namespace icome::drawing
