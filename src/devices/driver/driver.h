#pragma once
#include <atomic>
#include <string>

#include "base/result.h"
#include "devices/driver/driver_link.h"

namespace icome::devices {

/// A way to talk to one device: over its maker's library, a socket or a file of the system. A DrivenDevice
/// owns one and calls it from one thread at a time.
class Driver {
 public:
  virtual ~Driver() = default;
  /// Finds the device and opens it, which may take seconds; called again after it was lost. The error is a
  /// sentence or two for people: what is missing, and what to do.
  virtual base::Result<DeviceInfo> open() = 0;
  /// Passes readings and forces through the link, at the device's own rate, until it fails or `stop` is set,
  /// which it looks at every 10 ms at least. Returns why it failed, or nothing when it was stopped. When it
  /// returns the device gives no force.
  virtual std::string run(DriverLink& link, const std::atomic<bool>& stop) = 0;
  /// Lets the device go; after run(), or after open() alone.
  virtual void close() = 0;
  /// The one name of the open device, however it was addressed: devices of a program with the same one are
  /// the same. Empty: it is not known. After open().
  virtual std::string identity() const { return {}; }
};

}  // namespace icome::devices
