#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vector.h"
#include "charts/colour.h"
#include "charts/image.h"

namespace icome::charts {

/// A rectangle of a page, in page units; y grows downward.
struct Area {
  double x, y, width, height;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

/// The look of a line; lengths in page units.
struct Stroke {
  Colour colour;
  double width = 1.0;
  std::vector<double> dashes;  ///< lengths on, off, on, ...; empty is solid
};

/// A closed loop of cubics: where it starts, then three points (two control points and the end) for each. Its
/// end is joined to its start by a straight line where they differ.
struct CubicLoop {
  std::vector<base::Vector2> points;  ///< page units
};

/// The look of text, which is set as lettering.h says.
struct TextStyle {
  double size = 14.0;  ///< page units
  Colour colour;
  bool bold = false;
  double align = 0.0;  ///< 0: starts at the point, 0.5: is centred on it, 1: ends there
  double turn = 0.0;   ///< rad, counter-clockwise
};

/// A white or clear page to draw and write on. Owns its pixels, or the recorded drawing if it has none;
/// `scale` pixels make one page unit.
class Canvas {
 public:
  /// Sides in pixels, 1 ... 32767 each; scale > 0.
  Canvas(int width, int height, double scale);
  /// A page with pixels that is clear where nothing is drawn.
  static Canvas clear(int width, int height, double scale);
  /// A page without pixels, which svg() gives; sides in page units.
  static Canvas of_lines(double width, double height);
  /// A clear page without pixels, which pdf() gives; sides in page units, of which 72 make an inch.
  static Canvas of_pdf(double width, double height);
  Canvas(Canvas&&) noexcept;
  ~Canvas();

  double width() const;   ///< page units
  double height() const;  ///< page units

  void fill(const Area& area, const Colour& colour);
  /// A gradient evenly through all colours, from left to right or, if `upward`, from bottom to top.
  void fill_gradient(const Area& area, std::span<const Colour> colours, bool upward);
  /// The polygon, filled with `colours` from the bottom of `span` to its top.
  void fill_gradient(std::span<const base::Vector2> polygon, const Area& span,
                     std::span<const Colour> colours);
  void fill_polygon(std::span<const base::Vector2> points, const Colour& colour);
  /// All loops as one path: what they wind around, in all, another number of times than zero.
  void fill_path(std::span<const CubicLoop> loops, const Colour& colour);
  void fill_disc(const base::Vector2& centre, double radius, const Colour& colour);
  void circle(const base::Vector2& centre, double radius, const Stroke& stroke);
  /// An open line through the points, with round joins and ends.
  void line(std::span<const base::Vector2> points, const Stroke& stroke);
  /// The text's baseline passes through `at`. Bytes that are not UTF-8 show as a replacement mark.
  void text(const base::Vector2& at, std::string_view text, const TextStyle& style);
  /// Width of the text, page units.
  double text_width(std::string_view text, const TextStyle& style) const;
  /// Draws an image, scaled to fit the area; sharp when it has exactly the area's pixels.
  void image(const Image& image, const Area& area);

  /// Draws only inside the area until unclip().
  void clip(const Area& area);
  void unclip();

  /// All that is drawn until end_group(), only inside the area, becomes one picture, which is then laid on
  /// the page with that opacity (0 to 1): things in a group do not show through each other.
  void begin_group(const Area& area);
  void end_group(double opacity);

  /// The drawing so far. Only for a page with pixels.
  Image snapshot() const;
  /// The drawing as an SVG file in which letters are shapes, so that it needs no font; a page unit is a
  /// pixel of CSS. Only for a page without pixels, which accepts no drawing afterwards.
  std::string svg();
  /// Begins another page of the same size. Only for a page made by of_pdf().
  void next_page();
  /// The drawing as a PDF file, the same bytes at any time. Only for a page made by of_pdf(),
  /// which accepts no drawing afterwards.
  std::string pdf();

 private:
  struct Page;
  static std::unique_ptr<Page> pixels(int width, int height, double scale);
  explicit Canvas(std::unique_ptr<Page> page);

  std::unique_ptr<Page> page_;
};

/// The text, cut with an ellipsis where it would be wider than `width` page units.
std::string fitted(const Canvas& canvas, std::string_view text, const TextStyle& style, double width);

}  // namespace icome::charts
