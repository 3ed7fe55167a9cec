#pragma once
#include <memory>
#include <string_view>

#include "base/result.h"
#include "devices/back_end.h"
#include "devices/driver/driven_device.h"
#include "devices/evdev/input_finder.h"

namespace icome::devices {

// The input devices of Linux: "tablet", "mouse" and "gamepad". Addresses: see find_input. A gamepad is listed
// as a pointer and as a navigation device.
extern const BackEnd kTabletBackEnd;
extern const BackEnd kMouseBackEnd;
extern const BackEnd kGamepadBackEnd;

/// Opens the pointer device of an address among the devices of a system, with the settings of the
/// environment (ICOME_TABLET, ICOME_MOUSE, ICOME_GAMEPAD).
base::Result<std::unique_ptr<DrivenDevice>> open_input_pointer(std::shared_ptr<InputSystem> system,
                                                               InputKind kind, std::string_view address,
                                                               const DrivenSettings& driven = {});

}  // namespace icome::devices
