#include "devices/evdev/input_node.h"

#include <linux/input-event-codes.h>

namespace icome::devices {

void InputState::take(const InputEvent& event) {
  if (event.type == EV_KEY && event.code < kInputKeys) keys[event.code] = event.value != 0;
  if (event.type == EV_ABS && event.code < kInputAxes) axes[event.code] = event.value;
}

}  // namespace icome::devices
