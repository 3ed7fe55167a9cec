#include "devices/evdev/stepped_velocity.h"

#include <algorithm>
#include <cmath>

namespace icome::devices {
namespace {

constexpr double kSmoothing = 0.015;      // s
constexpr double kShortestStep = 0.0005;  // s: times that are nearer together are of the system's making
constexpr double kLongestStep = 0.05;     // s: a tip that rested longer moved only at the end
constexpr std::int64_t kRestsAfter = 30'000'000;  // ns, longer than slow tablets take for a report

}  // namespace

void SteppedVelocity::restart(const Vector3& place) {
  place_ = place;
  velocity_.setZero();
  time_ = 0;
  fresh_ = false;
}

void SteppedVelocity::step(const Vector3& place, std::int64_t time) {
  // A difference in floating point, as hostile times may lie farther apart than integers hold.
  const double passed = 1e-9 * (static_cast<double>(time) - static_cast<double>(time_));
  const double seconds = std::clamp(passed, kShortestStep, kLongestStep);
  velocity_ += (1.0 - std::exp(-seconds / kSmoothing)) * ((place - place_) / seconds - velocity_);
  place_ = place;
  time_ = time;
  fresh_ = true;
}

Vector3 SteppedVelocity::at(std::int64_t now) {
  if (fresh_) stepped_ = now;
  fresh_ = false;
  if (now - stepped_ > kRestsAfter) velocity_.setZero();
  return velocity_;
}

}  // namespace icome::devices
