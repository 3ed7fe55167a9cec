#pragma once
#include <mutex>
#include <string>
#include <vector>

#include "base/result.h"
#include "devices/openhaptics/hd_library.h"
#include "devices/pointer_device.h"

namespace icome::devices {

/// A device that HdSession opened.
struct HdDevice {
  unsigned handle = HdLibrary::kInvalidDevice;
  std::string name;  // in the settings of the device's driver; empty: the default one
  std::string vendor;
  std::string serial;
  DeviceInfo info;  // named as its model; the profile's limits or its own, whichever are lower
};

/// The devices of OpenHaptics that this program has open, each once. Its scheduler runs from the first to the
/// last: it is stopped before the last one is disabled, and never while another is in use. Any thread.
class HdSession {
 public:
  static HdSession& instance();

  /// Opens a device, ready for frames: its forces are ramped, limited, and switched on. The error is for
  /// people.
  base::Result<HdDevice> open(const HdLibrary& hd, const std::string& name, double rate);
  /// Disables a device; none of its callbacks may be scheduled any more.
  void close(const HdLibrary& hd, const HdDevice& device);

  /// The device of that name, open or not; one that is not is opened for a moment.
  base::Result<HdDevice> look(const HdLibrary& hd, const std::string& name);

  /// Held for the length of a frame: the library has one current device for all threads.
  std::mutex& frames() { return frames_; }

 private:
  base::Result<HdDevice> init(const HdLibrary& hd, const std::string& name);

  std::mutex guard_;
  std::mutex frames_;  // never held while the scheduler is stopped, which waits for frames
  std::vector<HdDevice> open_;
};

}  // namespace icome::devices
