#pragma once
#include <cstdint>

#include "devices/driver/driver_link.h"
#include "devices/evdev/input_node.h"

namespace icome::devices {

/// Turns the events of one input device into a pointer's or a traveller's state. An InputDriver owns one.
class InputReader {
 public:
  virtual ~InputReader() = default;
  /// Begins with a device that was opened, and forgets the last one. Returns its abilities as a pointer.
  virtual DeviceInfo begin(const InputAbilities& abilities) = 0;
  /// Takes an event, any but EV_SYN.
  virtual void take(const InputEvent& event) = 0;
  /// Ends a frame: the events since the last one happened together, at that time, ns.
  virtual void frame(std::int64_t time) = 0;
  /// Notes that events were lost before this frame, and with them the device's path meanwhile.
  virtual void missed() {}
  /// Passes the state at that time (ns, steady clock) on; that of a pointer goes through the link.
  virtual void pass(DriverLink& link, std::int64_t now) = 0;
};

}  // namespace icome::devices
