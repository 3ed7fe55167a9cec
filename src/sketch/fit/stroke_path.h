#pragma once
#include <cstdint>
#include <vector>

#include "sketch/fit/pen_sample.h"

namespace icome::sketch {

using base::Vector2;

/// The way of a pen as a line from sample to sample, with samples left out that say nothing new. Lengths here
/// are in units of the fit's error bound, counted from the first sample, so that the same drawing in mm and
/// in m is the same path.
struct StrokePath {
  std::vector<Vector2> points;         ///< no two neighbours are equal
  std::vector<double> along;           ///< length of the line up to each point
  std::vector<std::uint32_t> samples;  ///< the sample that each point is

  double length() const { return along.empty() ? 0.0 : along.back(); }
  /// The point at a length from the start, 0 to length().
  Vector2 at(double distance) const;
};

/// A place in units of `error` from an origin, rounded to a millionth of it: the same drawing in mm and in m
/// then gives the same numbers, and not nearly the same ones, which long computations take apart.
Vector2 in_units_of(double error, const Vector2& place, const Vector2& origin);
/// By how much in_units_of() moves a place at most, in those units.
inline constexpr double kUnitRounding = 7e-7;

/// The path of a stroke: points leave the line from sample to sample by at most `tolerance` (in units of
/// `error`; 0 keeps all). Samples that are nearer to the last one than a thousandth of the error are taken
/// for a pen at rest.
StrokePath path_of(const PenStroke& stroke, double error, double tolerance);

/// Leaves out points of a line on the way (the opening cone of Williams 1978): says of each new point whether
/// the one before it must be kept, so that none is farther than the tolerance from the line that is kept.
/// Constant time and memory.
class ConeSimplifier {
 public:
  explicit ConeSimplifier(double tolerance) : tolerance_(tolerance) {}

  /// Begins at a point that is kept.
  void begin(const Vector2& anchor);
  /// Can the line run straight from the anchor to `next`, past all points since? If not, the point before
  /// `next` must be kept: begin() there, and ask again.
  bool reaches(const Vector2& next);

 private:
  double tolerance_;
  Vector2 anchor_ = Vector2::Zero();
  Vector2 axis_ = Vector2::Zero();  // the first direction; angles count from it
  double low_ = 0.0;                // rad, the cone in which the line may run
  double high_ = 0.0;
  double farthest_ = 0.0;  // from the anchor
};

/// The points of a path, without its ends, at which it turns by more than `angle` (rad) within `reach` on
/// either side: corners, however many samples were taken there. The sharpest of neighbours within `reach`.
std::vector<std::size_t> corners_of(const StrokePath& path, double angle, double reach);

}  // namespace icome::sketch
