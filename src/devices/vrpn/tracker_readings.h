#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "devices/vrpn/protocol.h"
#include "devices/vrpn/vrpn_address.h"

namespace icome::devices::vrpn {

/// The velocity of a tracker that tells none: the slope of a straight line through its positions of the last
/// 10 ms (least squares), or through the last two where it is slower. It begins anew at a jump.
class VelocitySlope {
 public:
  /// Adds a position (m) and its time (s).
  void add(const Vector3& position, double time);
  /// The velocity, m/s; zero while there is one position only.
  Vector3 velocity() const;

 private:
  static constexpr double kWindow = 0.01;   // s
  static constexpr double kLongest = 0.25;  // s between two positions; after that it begins anew
  static constexpr double kFastest = 20.0;  // m/s, faster than any hand: what goes farther has jumped
  static constexpr double kSlack = 0.005;   // m, error of a position beside that
  static constexpr std::size_t kMost = 32;
  struct Sample {
    Vector3 position = Vector3::Zero();
    double time = 0.0;
  };
  bool is_path(const Vector3& position, double time) const;
  const Sample& back(std::size_t age) const { return samples_[(next_ + kMost - 1 - age) % kMost]; }

  std::array<Sample, kMost> samples_;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

/// Puts a pointer's state together of the messages of a tracker, its buttons and its analog channels.
/// Real-time safe.
class TrackerReadings {
 public:
  explicit TrackerReadings(const VrpnAddress& address)
      : frame_(address.frame), sensor_(address.sensor), grip_(address.grip) {}

  /// Takes a message in that came at `now`, ns. True when the pose or the buttons are new, and a pose is
  /// known.
  bool take(Kind kind, const Message& message, std::int64_t now);
  const PointerState& state() const { return state_; }

 private:
  bool take_pose(const PosQuat& pose, std::int64_t sent, std::int64_t now);
  bool take_button(const Button& button);

  VrpnFrame frame_;
  int sensor_;
  int grip_;
  PointerState state_;
  VelocitySlope slope_;
  bool posed_ = false;
  std::int64_t told_velocity_ = 0;  // ns, of the last velocity that the tracker told; 0: none
};

}  // namespace icome::devices::vrpn
