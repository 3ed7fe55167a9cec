#pragma once
#include <vector>

#include "drawing/outline/swept_part.h"

namespace icome::drawing {

/// A line of cubics under way.
class Rim {
 public:
  explicit Rim(const Vector2& start) : start_(start), at_(start) {}

  /// A straight line, none where the rim is there already.
  void line_to(const Vector2& point);
  /// A cubic from where the rim is.
  void curve_to(const Vector2& first_control, const Vector2& second_control, const Vector2& end);
  /// Along a circle by `turn` (rad, positive from x towards y) to `end`; off it by `tolerance` (m) at most.
  void arc_to(const Vector2& centre, double turn, const Vector2& end, double tolerance);
  /// The other rim from its end to its start.
  void append_reversed(const Rim& other);
  /// A straight line to the start where the rim is not there yet.
  void close() { line_to(start_); }

  const Vector2& at() const { return at_; }
  std::vector<CubicBezier>& edges() { return edges_; }

 private:
  Vector2 start_;
  Vector2 at_;
  std::vector<CubicBezier> edges_;
};

/// Lengthens the rim on one side (1 or -1) of a part whose disc sweeps, from its touching point at the start
/// to that at the end. Where the curve turns so tightly that the true rim runs back, inside the line, it runs
/// along the crossings of the spokes instead: this way the spokes, which together are the painted region,
/// never overturn.
void append_side(Rim& rim, const SweptPart& part, double side, double tolerance);

}  // namespace icome::drawing
