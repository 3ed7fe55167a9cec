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

/// Steadies a point. The speed of all coordinates counts together, so that it favours no direction.
template <int kCoordinates>
class SteadyPoint {
 public:
  using Point = Eigen::Matrix<double, kCoordinates, 1>;
  explicit SteadyPoint(const OneEuroSettings& settings) : settings_(settings) {}

  /// The point at `time`, s. Of a time not after the last one, the last output.
  Point next(const Point& point, double time) {
    const double gap = last_ ? time - last_->time : 0;
    if (!last_ || gap > settings_.longest_gap) {
      speed_ = Point::Zero();
      steady_ = point;
      last_ = Sample{time, point};
      return point;
    }
    if (gap <= 0) return steady_;
    const Point speed = (point - last_->point) / gap;
    speed_ += low_pass_share(settings_.speed_cutoff, gap) * (speed - speed_);
    const double cutoff = settings_.least_cutoff + settings_.speed_gain * speed_.norm();
    steady_ += low_pass_share(cutoff, gap) * (point - steady_);
    last_ = Sample{time, point};
    return steady_;
  }
  void forget() { last_.reset(); }

 private:
  struct Sample {
    double time;
    Point point;  // as it came in
  };

  OneEuroSettings settings_;
  std::optional<Sample> last_;
  Point speed_ = Point::Zero();
  Point steady_ = Point::Zero();
};

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

/// Steadies a rotation, as SteadyPoint does a point, on the arcs between rotations; speeds are rad/s.
class SteadyRotation {
 public:
  explicit SteadyRotation(const OneEuroSettings& settings) : settings_(settings) {}

  /// The rotation (unit length) at `time`, s. Of a time not after the last one, the last output.
  Quaternion next(const Quaternion& rotation, double time) {
    const double gap = last_ ? time - last_->time : 0;
    if (!last_ || gap > settings_.longest_gap) {
      speed_ = Vector3::Zero();
      steady_ = rotation;
      last_ = Sample{time, rotation};
      return rotation;
    }
    if (gap <= 0) return steady_;
    const Vector3 speed = turn_of(rotation * last_->rotation.conjugate()) / gap;
    speed_ += low_pass_share(settings_.speed_cutoff, gap) * (speed - speed_);
    const double cutoff = settings_.least_cutoff + settings_.speed_gain * speed_.norm();
    steady_ = steady_.slerp(low_pass_share(cutoff, gap), rotation).normalized();
    last_ = Sample{time, rotation};
    return steady_;
  }
  void forget() { last_.reset(); }

 private:
  struct Sample {
    double time;
    Quaternion rotation;  // as it came in
  };

  OneEuroSettings settings_;
  std::optional<Sample> last_;
  Vector3 speed_ = Vector3::Zero();
  Quaternion steady_ = Quaternion::Identity();
};

}  // namespace icome::base
