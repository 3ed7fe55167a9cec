#pragma once
#include <memory>

#include "devices/evdev/input_node.h"

namespace icome::devices {

/// The input devices of this system, by libevdev: the nodes event0, event1, ... in /dev/input, or in the
/// folder that the environment variable ICOME_INPUT_FOLDER names. Any thread.
std::shared_ptr<InputSystem> linux_inputs();

}  // namespace icome::devices
