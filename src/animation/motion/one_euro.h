#pragma once
#include <optional>

#include "base/vector.h"

namespace icome::animation {

using base::Vector2;

/// A low-pass filter whose cutoff rises with speed (Casiez, Roussel and Vogel, 1 Euro Filter, 2012): steady
/// at rest, close at speed. At a steady speed it lags 1 / (2 pi speed_gain) at most: 1.6 mm with 0.1 / mm.
struct OneEuroSettings {
  double least_cutoff = 1;   ///< Hz, at rest; 0.3 to 5; lower: steadier, slower to come to rest
  double speed_gain = 0.1;   ///< Hz of cutoff for a unit/s of speed; greater: closer at speed, less steady
  double speed_cutoff = 4;   ///< Hz, of the speed itself; greater: notices sooner that a hand sets off
  double longest_gap = 0.3;  ///< s between two samples, beyond which it starts anew
};

/// For places of triangles in mm: noise of 0.2 mm at rest becomes a third of it, at 300 mm/s it is 2 mm
/// behind. In px of a stage they do as well, where a mm is a few px.
inline constexpr OneEuroSettings kSteadyPlace = {};
/// For angles in rad: at 3 rad/s it is 1 degree behind.
inline constexpr OneEuroSettings kSteadyAngle = {1, 10, 4, 0.3};

/// Steadies a place. The speed of both coordinates counts together, so that it favours no direction.
class SteadyPlace {
 public:
  explicit SteadyPlace(const OneEuroSettings& settings = kSteadyPlace) : settings_(settings) {}

  /// The place at `time`, s. Of a time not after the last one, the last output.
  Vector2 next(const Vector2& place, double time);
  void forget() { last_.reset(); }

 private:
  struct Sample {
    double time;
    Vector2 place;  // as it came in
  };

  OneEuroSettings settings_;
  std::optional<Sample> last_;
  Vector2 speed_ = Vector2::Zero();
  Vector2 steady_ = Vector2::Zero();
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
