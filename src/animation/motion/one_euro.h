#pragma once
#include <optional>

#include "base/one_euro.h"

namespace icome::animation {

using base::OneEuroSettings;
using base::Vector2;

/// For places of triangles in mm: noise of 0.2 mm at rest becomes a third of it, at 300 mm/s it is 2 mm
/// behind. In px of a stage they do as well, where a mm is a few px.
inline constexpr OneEuroSettings kSteadyPlace = {};
/// For angles in rad: at 3 rad/s it is 1 degree behind.
inline constexpr OneEuroSettings kSteadyAngle = {1, 10, 4, 0.3};

/// Steadies a place.
class SteadyPlace : public base::SteadyPoint<2> {
 public:
  explicit SteadyPlace(const OneEuroSettings& settings = kSteadyPlace) : base::SteadyPoint<2>(settings) {}
};

/// Steadies an angle, rad: full turns do not matter to it, and what it gives counts them: it changes by less
/// than half a turn from sample to sample.
class SteadyAngle {
 public:
  explicit SteadyAngle(const OneEuroSettings& settings = kSteadyAngle) : filter_(settings) {}

  double next(double angle, double time);
  void forget();

 private:
  SteadyPlace filter_;
  std::optional<double> last_;  // as it came in, full turns counted
};

}  // namespace icome::animation
