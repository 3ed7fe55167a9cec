#pragma once
#include <memory>
#include <string>

#include "base/result.h"
#include "devices/driver/driven_device.h"
#include "devices/evdev/gamepad.h"
#include "devices/navigation_device.h"

namespace icome::devices {

/// A gamepad that moves the user, in the frame of a 3D mouse. The left stick pushes to the right and,
/// upwards, away from the user (-z); the triggers push up (right) and down (left). The right stick turns: to
/// the right about the downward axis, as one turns the head right, and upwards about -x, as one bows. Lost
/// while it is unplugged; goes on by itself when it is back.
class GamepadNavigation final : public NavigationDevice {
 public:
  /// Opens the gamepad of an address (see find_input), which may take some tenths of a second.
  static base::Result<std::unique_ptr<GamepadNavigation>> create(std::shared_ptr<InputSystem> system,
                                                                 const std::string& address = {},
                                                                 const GamepadSettings& settings = {},
                                                                 const DrivenSettings& driven = {});
  ~GamepadNavigation() override;

  const std::string& name() const override { return device_->info().name; }
  DeviceStatus read(NavigationState& state) override;

 private:
  struct Box;
  GamepadNavigation(std::shared_ptr<Box> box, std::unique_ptr<DrivenDevice> device);

  std::shared_ptr<Box> box_;              // never null
  std::unique_ptr<DrivenDevice> device_;  // never null; its thread fills the box
};

}  // namespace icome::devices
