#pragma once
#include <optional>
#include <span>
#include <vector>

#include "geometry/curve/cubic_bezier.h"
#include "sketch/fit/band_system.h"
#include "sketch/fit/stroke_path.h"

namespace icome::sketch {

using geometry::CubicBezier;

/// A curve of cubics that turns without a break from one to the next: joints with a direction each, and how
/// far the control points lie before and behind them. Lengths in the units of the path that it is fitted to.
class SmoothSpline {
 public:
  /// A joint of two segments, or an end.
  struct Joint {
    Vector2 place;
    double direction;  ///< rad, of the way along the curve
    double before;     ///< length of the handle that comes to it, > 0
    double after;      ///< length of the handle that leaves it, > 0
  };

  static constexpr double kShortestHandle = 1e-3;  ///< of the path's unit: without one there is no direction

  explicit SmoothSpline(std::vector<Joint> joints) : joints_(std::move(joints)) {}
  /// Makes one of cubics that follow one another: at a joint of two it has the mean of their directions.
  static SmoothSpline through(std::span<const CubicBezier> segments);

  std::size_t segments() const { return joints_.size() - 1; }
  CubicBezier segment(std::size_t i) const;
  std::vector<CubicBezier> curve() const;
  const std::vector<Joint>& joints() const { return joints_; }

  /// Where the curve goes on beyond its ends: the places of the way that belong to these (place_of_way()),
  /// which then keep their directions. Without one the way ends there too. The places of both ends always
  /// stay.
  struct Beyond {
    std::optional<Vector2> first = {};
    std::optional<Vector2> last = {};
  };

  /// How long bring_near() tries.
  struct Effort {
    int most_rounds;
    int rounds_of_hope;  ///< after which the greatest distance must have come below twice what is enough
  };

  /// Brings the curve nearer to the points, which lie along the way in order: Gauss's and Newton's method on
  /// the distances across the curve, in which great distances weigh more and more. Ends when the greatest is
  /// `enough` or no longer falls. Gives the greatest certified distance of the curve and the line through the
  /// points, both ways (certified_distance()).
  double bring_near(std::span<const Vector2> points, const Beyond& beyond, double enough,
                    const Effort& effort);

  /// Puts `part` in the place of the segments from joint `first` to joint `last`, whose places it begins and
  /// ends with, after it was brought near to their points.
  void replace(std::size_t first, std::size_t last, const SmoothSpline& part);

  /// That distance for each segment, after the last bring_near().
  const std::vector<double>& errors() const { return errors_; }
  /// The number of those points before each joint.
  const std::vector<std::size_t>& points_before() const { return points_before_; }
  /// The place of the line through those points that belongs to a joint between two segments.
  Vector2 place_of_way(std::span<const Vector2> points, std::size_t joint) const;

 private:
  struct Place;
  class Equations;
  struct Approach;
  Approach begin_approach(std::span<const Vector2> points) const;
  bool run_round(BandSystem& system, const Beyond& beyond, Approach& approach);
  void set_up(BandSystem& system, const Beyond& beyond, const Approach& approach) const;
  bool take_step(const BandSystem& system, Approach& approach, double scale);
  double note_errors(std::span<const Vector2> points, const std::vector<Place>& places, const Beyond& beyond,
                     double resolution);
  double find_places(std::span<const Vector2> points, std::vector<Place>& places, int steps) const;
  SmoothSpline moved_by(const std::vector<double>& step) const;

  std::vector<Joint> joints_;
  std::vector<double> errors_;
  std::vector<std::size_t> points_before_;
};

}  // namespace icome::sketch
