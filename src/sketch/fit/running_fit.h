#pragma once
#include <optional>
#include <vector>

#include "sketch/fit/cubic_fit.h"

namespace icome::sketch {

/// A stroke that is fitted while it is drawn (thesis 4.5.2): each point costs the same, however long the
/// stroke is. The segment that is being drawn always ends at the last point; when no cubic comes within the
/// distance, all but its last part is kept and the next segment goes on from there in the same direction,
/// with the points of that last part, which both share. Lengths are in units of the distance allowed.
class RunningFit {
 public:
  /// A finished segment, and the part of the way that it stands for.
  struct Finished {
    CubicBezier curve;
    double from;  ///< length of the way from its start
    double to;
  };

  /// Begins a stroke.
  explicit RunningFit(const Vector2& start);
  /// The pen has moved on.
  void add(const Vector2& point);

  const std::vector<Finished>& finished() const { return finished_; }
  /// The segment from the last finished one to the last point.
  Finished current() const { return {current_, start_along_, along_}; }
  /// Joints at which the curve breaks, as the way turns sharply there.
  std::size_t corners() const { return corners_; }

 private:
  /// A point of the way that is kept, until the segment after it is finished.
  struct Knot {
    Vector2 point;
    double along;  ///< from the segment's start
  };

  /// The way of a segment: its knots and what follows from them.
  struct Way {
    std::vector<Knot> knots;  // the first is the start
    CurveMoments moments;     // along the knots

    void add(const Vector2& point);
    double length_to(const Vector2& end) const;
  };

  bool try_to_reach(const Vector2& point);
  bool is_near(const CubicBezier& cubic, const Vector2& end, double length) const;
  void begin_segment(const Vector2& start, const std::optional<Vector2>& direction);
  void finish_segment(const Vector2& next);
  bool finish_at_corner();
  void finish_at_last(const Vector2& next);
  void keep(const CubicBezier& curve, double length);

  std::vector<Finished> finished_;
  CubicBezier current_;
  Vector2 start_;
  std::optional<Vector2> direction_;  // none: it may leave the start in any
  Way way_;
  ConeSimplifier cone_;
  Vector2 last_;              // the last point
  double along_ = 0.0;        // of the whole way, at the last point
  double start_along_ = 0.0;  // at the start of the segment
  std::size_t corners_ = 0;
};

}  // namespace icome::sketch
