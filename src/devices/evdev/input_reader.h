#pragma once
#include <cstdint>

#include "devices/driver/driver_link.h"
#include "devices/evdev/input_node.h"

namespace icome::devices {

/// Makes what a servo or a person wants to know of the events of one input device. An InputDriver owns one.
class InputReader {
 public:
  virtual ~InputReader() = default;
  /// A device was opened: forgets the last one. Returns what it can do as a pointer.
  virtual DeviceInfo begin(const InputAbilities& abilities) = 0;
  /// Any event but EV_SYN.
  virtual void take(const InputEvent& event) = 0;
  /// The events since the last frame happened together, at that time, ns.
  virtual void frame(std::int64_t time) = 0;
  /// Events were lost before this frame; where the device came by meanwhile is not known.
  virtual void missed() {}
  /// Passes the state at that time (ns, steady clock) on, where it is a pointer's through the link.
  virtual void pass(DriverLink& link, std::int64_t now) = 0;
};

}  // namespace icome::devices
