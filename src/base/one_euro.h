#pragma once
#include <cmath>
#include <numbers>
#include <optional>

#include "base/vector.h"

namespace icome::base {

/// A low-pass filter whose cutoff rises with speed (Casiez, Roussel and Vogel, 1 Euro Filter, 2012): steady
/// at rest, close at speed. At a steady speed it lags 1 / (2 pi speed_gain) at most: 1.6 mm with 0.1 / mm.
struct OneEuroSettings {
  double least_cutoff = 1;   ///< Hz, at rest; 0.3 to 5; lower: steadier, slower to come to rest
  double speed_gain = 0.1;   ///< Hz of cutoff for a unit/s of speed; greater: closer at speed, less steady
  double speed_cutoff = 4;   ///< Hz, of the speed itself; greater: notices sooner that a hand sets off
  double longest_gap = 0.3;  ///< s between two samples, beyond which it starts anew
};

/// The share of a new sample `gap` s after the last one in a low-pass filter, by its cutoff, Hz.
inline double low_pass_share(double cutoff, double gap) {
  const double turn = 2 * std::numbers::pi * cutoff * gap;
  return turn / (turn + 1);
}

/// The turn that a rotation is: its axis (unit) times its angle, rad, at most half a turn.
inline Vector3 turn_of(const Quaternion& rotation) {
  const Eigen::AngleAxisd turn(rotation.w() < 0.0 ? Quaternion(-rotation.coeffs()) : rotation);
  return turn.angle() * turn.axis();
}

/// The rotation of such a turn, of any angle.
inline Quaternion rotation_of_turn(const Vector3& turn) {
  const double angle = turn.norm();
  return angle > 0.0 ? Quaternion(Eigen::AngleAxisd(angle, turn / angle)) : Quaternion::Identity();
}

/// Points as the filter needs them: the way from one to another, and a place on it.
template <int kCoordinates>
struct PointSpace {
  using Value = Eigen::Matrix<double, kCoordinates, 1>;
  using Way = Value;
  static Value origin() { return Value::Zero(); }
  static Way way(const Value& from, const Value& to) { return to - from; }
  static Value between(const Value& from, const Value& to, double share) {
    return from + share * (to - from);
  }
};

/// Rotations of unit length, and the arcs between them, whose ways are turns in rad.
struct RotationSpace {
  using Value = Quaternion;
  using Way = Vector3;
  static Value origin() { return Value::Identity(); }
  static Way way(const Value& from, const Value& to) { return turn_of(to * from.conjugate()); }
  static Value between(const Value& from, const Value& to, double share) {
    return from.slerp(share, to).normalized();
  }
};

/// Steadies a value. The speed of all its coordinates counts together, so that it favours no direction.
template <typename Space>
class Steady {
 public:
  using Value = typename Space::Value;
  explicit Steady(const OneEuroSettings& settings) : settings_(settings) {}

  /// The value at `time`, s. Of a time not after the last one, the last output.
  Value next(const Value& value, double time) {
    const double gap = last_ ? time - last_->time : 0;
    if (!last_ || gap > settings_.longest_gap) {
      speed_ = Space::Way::Zero();
      steady_ = value;
      last_ = Sample{time, value};
      return value;
    }
    if (gap <= 0) return steady_;
    const typename Space::Way speed = Space::way(last_->value, value) / gap;
    speed_ += low_pass_share(settings_.speed_cutoff, gap) * (speed - speed_);
    const double cutoff = settings_.least_cutoff + settings_.speed_gain * speed_.norm();
    steady_ = Space::between(steady_, value, low_pass_share(cutoff, gap));
    last_ = Sample{time, value};
    return steady_;
  }
  void forget() { last_.reset(); }

 private:
  struct Sample {
    double time;
    Value value;  // as it came in
  };

  OneEuroSettings settings_;
  std::optional<Sample> last_;
  typename Space::Way speed_ = Space::Way::Zero();
  Value steady_ = Space::origin();
};

template <int kCoordinates>
using SteadyPoint = Steady<PointSpace<kCoordinates>>;
using SteadyRotation = Steady<RotationSpace>;

}  // namespace icome::base
