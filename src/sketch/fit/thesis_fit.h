#pragma once
#include <array>
#include <vector>

#include "geometry/curve/cubic_bezier.h"

namespace icome::sketch {

using base::Vector2;
using geometry::CubicBezier;

/// The fit of thesis 4.2 to 4.7, with the erratum to 4.5: a segment runs from the sample P_s to P_(n-s), and
/// the s samples before and behind take part in the sums, so that neighbours that share them turn alike. t is
/// the length of the way. Sums of powers of the length are kept, so that a sample costs the same however many
/// there are. A segment ends when the root of the mean square distance (at equal t) is above the bound.
class ThesisFit {
 public:
  struct Finished {
    CubicBezier curve;
    double from;  ///< length of the way
    double to;
  };

  /// `error` in the unit of the points; `shared` is s.
  ThesisFit(double error, unsigned shared) : error_(error), shared_(shared) {}

  void add(const Vector2& point);
  const std::vector<Finished>& finished() const { return finished_; }
  /// The last segment as it is if the pen is lifted now: up to the last sample. Precondition: two samples.
  Finished current() const;
  std::size_t samples() const { return points_.size(); }

 private:
  static constexpr int kPowers = 7;
  /// Sums over the samples of a segment of powers of the length u from P_s, and of those with P.
  struct Sums {
    std::array<double, kPowers> u{};
    std::array<Vector2, 4> up = {Vector2::Zero(), Vector2::Zero(), Vector2::Zero(), Vector2::Zero()};
    double pp = 0.0;

    void add(double length, const Vector2& point);
  };
  struct Fit {
    CubicBezier curve;
    double mean_square;
  };

  Fit fit_to(std::size_t end) const;

  double error_;
  unsigned shared_;
  std::vector<Finished> finished_;
  std::vector<Vector2> points_;
  std::vector<double> along_;
  std::size_t first_ = 0;  // sample of the segment, where its sums begin
  std::size_t start_ = 0;  // P_s
  Sums sums_;
};

}  // namespace icome::sketch
