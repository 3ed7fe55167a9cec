#pragma once
#include <cstdint>

#include "base/result.h"
#include "base/vector.h"
#include "devices/evdev/input_reader.h"

namespace icome::devices {

struct GamepadSettings {
  double dead = 0.15;       // share of a stick's or trigger's way that counts as rest, usually 0.05 to 0.3
  double speed = 0.1;       // m/s, of the tip at full deflection, usually 0.02 to 0.5
  double radius = 0.1;      // m, the sphere that the tip stays in
  double full_force = 3.0;  // N, the force of the strongest rumble; weaker ones in proportion
};

/// The deflections of a gamepad's sticks and triggers, after their dead zones.
struct GamepadSticks {
  base::Vector2 left = base::Vector2::Zero();  // right and up (away from the user), each -1 to 1; length <= 1
  base::Vector2 right = base::Vector2::Zero();  // the same
  double left_trigger = 0.0;                    // 0 to 1
  double right_trigger = 0.0;
};

/// The meaning of a gamepad's events: sticks, triggers and buttons.
class Gamepad {
 public:
  explicit Gamepad(double dead = GamepadSettings{}.dead) : dead_(dead) {}

  void begin(const InputAbilities& abilities);
  void take(const InputEvent& event) { state_.take(event); }

  GamepadSticks sticks() const;
  /// Bits: 0 south (A, cross), 1 east, 2 west, 3 north, 4 and 5 left and right shoulder, 6 and 7 left and
  /// right trigger, 8 select, 9 start, 10 mode, 11 and 12 left and right stick pressed. A joystick without
  /// these: its buttons in their order.
  std::uint32_t buttons() const;

 private:
  base::Vector2 stick(std::size_t across, std::size_t down) const;
  double deflection(std::size_t axis) const;
  double trigger(std::size_t axis) const;
  double dead_of(std::size_t axis) const;
  bool right_stick_is_r() const;

  double dead_;
  InputAbilities abilities_;
  InputState state_;
};

/// The pointer of a gamepad: sticks set the velocity of the tip, the left one to the right and up, the right
/// one's up away from the user (-z). It begins in the middle, and stays in a sphere. Forces become rumble,
/// which has a strength and no direction: they do not move the tip.
class GamepadPointer final : public InputReader {
 public:
  explicit GamepadPointer(const GamepadSettings& settings = {}) : settings_(settings), pad_(settings.dead) {}

  DeviceInfo begin(const InputAbilities& abilities) override;
  void take(const InputEvent& event) override { pad_.take(event); }
  void frame(std::int64_t /*time*/) override { sticks_ = pad_.sticks(); }
  void pass(DriverLink& link, std::int64_t now) override;

 private:
  GamepadSettings settings_;
  Gamepad pad_;
  GamepadSticks sticks_;
  PointerState pointer_;
  std::int64_t time_ = 0;  // ns, of the last pass(); 0: there was none
};

/// Settings as the environment variable ICOME_GAMEPAD says: "dead=0.15 speed=0.1 radius=0.1 force=3".
base::Result<GamepadSettings> gamepad_settings_from_environment();

}  // namespace icome::devices
