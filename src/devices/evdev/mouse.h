#pragma once
#include <cstdint>

#include "base/result.h"
#include "devices/evdev/input_reader.h"
#include "devices/evdev/stepped_velocity.h"

namespace icome::devices {

struct MouseSettings {
  double metres_per_count =
      5e-5;  // m, usually 1e-5 to 2e-4; 2.54e-5: as far as the hand, at 1000 counts/inch
  double metres_per_notch = 0.002;  // m, of depth, usually 0.001 to 0.01
  double radius = 0.1;              // m, the sphere that the tip stays in
};

/// The pointer of a mouse, read beside the desktop's own cursor: its right is right, away from the user is
/// up, and turning the wheel away pushes the tip away (-z). It begins in the middle, and stays in a sphere.
/// Buttons: 0 left, 1 right, 2 middle, 3 and 4 at its side.
class Mouse final : public InputReader {
 public:
  explicit Mouse(const MouseSettings& settings = {}) : settings_(settings) {}

  DeviceInfo begin(const InputAbilities& abilities) override;
  void take(const InputEvent& event) override;
  void frame(std::int64_t time) override;
  void pass(DriverLink& link, std::int64_t now) override;

  /// The state of the newest frame; its velocity is that of the last pass().
  const PointerState& pointer() const { return pointer_; }

 private:
  MouseSettings settings_;
  bool fine_wheel_ = false;  // the wheel tells parts of a notch
  InputState state_;
  Vector3 counts_ = Vector3::Zero();  // since the last frame: right, away, and notches away
  PointerState pointer_;
  SteppedVelocity velocity_;
};

/// Settings as the environment variable ICOME_MOUSE says: "count=0.00005 notch=0.002 radius=0.1", in m.
base::Result<MouseSettings> mouse_settings_from_environment();

}  // namespace icome::devices
