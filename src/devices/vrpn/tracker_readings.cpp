#include "devices/vrpn/tracker_readings.h"

#include <algorithm>
#include <cmath>

namespace icome::devices::vrpn {
namespace {

constexpr std::int64_t kVelocityLasts = 100'000'000;  // ns that a velocity told by the tracker counts
constexpr int kButtons = 32;

}  // namespace

/// Could a hand have come here from the last position?
bool VelocitySlope::is_path(const Vector3& position, double time) const {
  const double passed = time - back(0).time;
  if (passed < 0.0 || passed > kLongest) return false;
  return (position - back(0).position).norm() <= kFastest * passed + kSlack;
}

void VelocitySlope::add(const Vector3& position, double time) {
  if (!position.allFinite() || !std::isfinite(time)) return;
  if (count_ > 0 && !is_path(position, time)) count_ = 0;
  // Two at one time say nothing of the velocity: the later one counts.
  if (count_ > 0 && time == back(0).time) {
    samples_[(next_ + kMost - 1) % kMost].position = position;
    return;
  }
  samples_[next_] = {position, time};
  next_ = (next_ + 1) % kMost;
  count_ = std::min(count_ + 1, kMost);
}

Vector3 VelocitySlope::velocity() const {
  if (count_ < 2) return Vector3::Zero();
  const Sample& newest = back(0);
  std::size_t used = 2;
  while (used < count_ && newest.time - back(used).time <= kWindow) ++used;
  double mean_time = 0.0;
  Vector3 mean = Vector3::Zero();
  for (std::size_t age = 0; age < used; ++age) {
    mean_time += (back(age).time - newest.time) / static_cast<double>(used);
    mean += back(age).position / static_cast<double>(used);
  }
  double spread = 0.0;
  Vector3 common = Vector3::Zero();
  for (std::size_t age = 0; age < used; ++age) {
    const double time = back(age).time - newest.time - mean_time;
    spread += time * time;
    common += time * (back(age).position - mean);
  }
  return spread > 0.0 ? Vector3(common / spread) : Vector3::Zero();
}

bool TrackerReadings::take(Kind kind, const Message& message, std::int64_t now) {
  switch (kind) {
    case Kind::PosQuat: {
      const auto pose = read_pos_quat(message.payload);
      return pose && pose->sensor == sensor_ && take_pose(*pose, message.time, now);
    }
    case Kind::Velocity: {
      const auto told = read_velocity(message.payload);
      if (!told || told->sensor != sensor_ || !told->velocity.allFinite()) return false;
      state_.velocity = frame_.position(told->velocity);
      told_velocity_ = now;
      // A velocity is no reading of its own: it comes behind its pose, mostly in the same piece of bytes.
      return false;
    }
    case Kind::ButtonChange: {
      const auto button = read_button(message.payload);
      return button && take_button(*button) && posed_;
    }
    case Kind::ButtonStates: {
      const auto buttons = read_buttons(message.payload);
      if (!buttons) return false;
      state_.buttons = *buttons;
      return posed_;
    }
    case Kind::AnalogChannel: {
      const auto value = grip_ < 0 ? std::nullopt : read_channel(message.payload, grip_);
      if (!value || !std::isfinite(*value)) return false;
      state_.grip = std::clamp(*value, 0.0, 1.0);
      return posed_;
    }
    default:
      return false;
  }
}

bool TrackerReadings::take_pose(const PosQuat& pose, std::int64_t sent, std::int64_t now) {
  state_.position = frame_.position(pose.position);
  state_.orientation = frame_.orientation(pose.orientation);
  // Time by the server's clock, as messages bunch up on the way; by ours where it has none.
  slope_.add(state_.position, sent != 0 ? 1e-6 * static_cast<double>(sent) : 1e-9 * static_cast<double>(now));
  if (told_velocity_ == 0 || now - told_velocity_ > kVelocityLasts) state_.velocity = slope_.velocity();
  posed_ = true;
  return true;
}

bool TrackerReadings::take_button(const Button& button) {
  if (button.button < 0 || button.button >= kButtons) return false;
  const std::uint32_t bit = 1U << button.button;
  state_.buttons = button.down ? state_.buttons | bit : state_.buttons & ~bit;
  return true;
}

}  // namespace icome::devices::vrpn
