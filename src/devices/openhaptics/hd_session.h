#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/result.h"
#include "devices/openhaptics/hd_library.h"
#include "devices/openhaptics/hd_turns.h"
#include "devices/pointer_device.h"

namespace icome::devices {

/// A device that HdSession opened.
struct HdDevice {
  unsigned handle = HdLibrary::kInvalidDevice;
  std::string name;  // in the settings of the device's driver; empty: the default one
  std::string vendor;
  std::string serial;
  /// Driver::identity(): by the serial number, as one device may have two names.
  std::string identity() const { return serial.empty() ? "hd:" + name : "hd#" + serial; }
  /// The address that opens it.
  std::string address() const { return name.empty() ? "hd" : "hd:" + name; }
  DeviceInfo info;     // named as its model; the profile's limits or its own, whichever are lower
  bool hangs = false;  // it was to be closed while a call of the library hung
};

/// The devices of OpenHaptics that this program has open, each once, by whichever name. Its scheduler runs
/// from the first to the last: it is stopped before the last one is disabled, and never while another is in
/// use. Any thread.
///
/// While a device is opened, looked at or closed, the others give no force, and begin again with a ramp: that
/// changes the library's current device, and may take seconds, so no frames can be made beside it.
class HdSession {
 public:
  static HdSession& instance();

  /// Opens a device, ready for frames: its forces are ramped, limited, and switched on. The error is for
  /// people.
  base::Result<HdDevice> open(const HdLibrary& hd, const std::string& name, double rate);
  /// Disables a device; none of its callbacks may be scheduled any more, but for one that hangs. While a call
  /// of the library hangs, this gives up after 0.5 s, and the device is disabled when it is opened again.
  void close(const HdLibrary& hd, const HdDevice& device);

  /// The device of that name, open or not; one that is not is opened for a moment.
  base::Result<HdDevice> look(const HdLibrary& hd, const std::string& name);

  /// Taken for each frame, and for all that is about the current device or takes errors.
  HdTurns& turns() { return turns_; }

  /// Keeps what a callback that hangs may still use, for as long as the program lives.
  void keep(std::shared_ptr<void> used);

 private:
  class Pause;
  base::Result<HdDevice> init(const HdLibrary& hd, const std::string& name);
  base::Result<HdDevice> start(const HdLibrary& hd, const std::string& name, double rate);
  const HdDevice* find_open(const std::string& name) const;
  base::Error no_answer(const std::string& name, const std::string& why) const;
  bool shut(const HdLibrary& hd, unsigned device);
  void shut_those_that_hung(const HdLibrary& hd);

  std::mutex guard_;
  HdTurns turns_;  // no turn is held while the scheduler is stopped, which waits for frames
  std::vector<HdDevice> open_;
  std::map<std::string, std::string> identities_;  // of the devices that were seen, by their names
  std::vector<std::shared_ptr<void>> kept_;
};

}  // namespace icome::devices
