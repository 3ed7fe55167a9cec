#include "devices/openhaptics/hd_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "devices/openhaptics/open_haptics.h"

namespace icome::devices {
namespace {

std::string text_of_device(const HdLibrary& hd, unsigned what) {
  const char* text = hd.get_string != nullptr ? hd.get_string(what) : nullptr;
  return text != nullptr ? text : "";
}

/// Lowers a limit to the device's own, which is given in units so many times ours; one that makes no sense is
/// ignored.
void lower_limit(double& limit, double own, double unit) {
  if (std::isfinite(own) && own > 0.0) limit = std::min(limit, own * unit);
}

double number_of_device(const HdLibrary& hd, unsigned what) {
  double number = 0.0;
  hd.get_doublev(what, &number);
  return number;
}

/// Half of the longest side of the box in which the device is best used, mm.
double usable_reach(const HdLibrary& hd) {
  std::array<double, 6> box = {};
  hd.get_doublev(HdLibrary::kUsableWorkspace, box.data());
  return 0.5 * std::max({box[3] - box[0], box[4] - box[1], box[5] - box[2]});
}

/// Tells vendor, serial number and limits of the current device.
void describe(const HdLibrary& hd, HdDevice& device) {
  const std::string model = text_of_device(hd, HdLibrary::kModel);
  device.vendor = text_of_device(hd, HdLibrary::kVendor);
  device.serial = text_of_device(hd, HdLibrary::kSerial);
  device.info = open_haptics_profile(model);
  device.info.name = model.empty() ? "PHANToM" : model;
  lower_limit(device.info.max_force, number_of_device(hd, HdLibrary::kMaxForce), 1.0);
  lower_limit(device.info.continuous_force, number_of_device(hd, HdLibrary::kContinuousForce), 1.0);
  lower_limit(device.info.nominal_stiffness, number_of_device(hd, HdLibrary::kMaxStiffness), 1000.0);
  lower_limit(device.info.workspace_radius, usable_reach(hd), 0.001);
}

}  // namespace

HdSession& HdSession::instance() {
  static HdSession session;
  return session;
}

base::Result<HdDevice> HdSession::open(const HdLibrary& hd, const std::string& name, double rate) {
  const std::lock_guard lock(guard_);
  if (std::any_of(open_.begin(), open_.end(), [&](const HdDevice& other) { return other.name == name; }))
    return base::fail("another part of the program has this PHANToM or Touch; close that first");
  auto device = init(hd, name);
  if (!device) return device;
  unsigned error = 0;
  {
    const std::lock_guard frame(frames_);
    hd.make_current_device(device->handle);
    hd.enable(HdLibrary::kForceClamping);
    hd.enable(HdLibrary::kForceRamping);
    hd.enable(HdLibrary::kForceOutput);
    error = hd.first_error();
  }
  if (error == 0 && open_.empty()) {
    hd.set_scheduler_rate(static_cast<unsigned long>(rate));
    // A rate that the device does not know is no reason to go without it.
    static_cast<void>(hd.first_error());
    hd.start_scheduler();
    error = hd.first_error();
  }
  if (error != 0) {
    hd.disable_device(device->handle);
    return base::fail(fmt::format("{} was found, but does not start: {}; switch it off and on again",
                                  device->info.name, hd.text_of(error)));
  }
  open_.push_back(*device);
  return device;
}

base::Result<HdDevice> HdSession::init(const HdLibrary& hd, const std::string& name) {
  HdDevice device;
  device.name = name;
  static_cast<void>(hd.first_error());
  device.handle = hd.init_device(name.empty() ? nullptr : name.c_str());
  const unsigned error = hd.first_error();
  if (device.handle == HdLibrary::kInvalidDevice || error == HdLibrary::kCommunication ||
      error == HdLibrary::kDeviceFault) {
    if (device.handle != HdLibrary::kInvalidDevice) hd.disable_device(device.handle);
    return base::fail(
        fmt::format("no PHANToM or Touch answers{} ({}); plug it in, switch it on, and try the test program "
                    "of its driver",
                    name.empty() ? "" : " by the name of " + name,
                    error != 0 ? hd.text_of(error) : "no reason is given"));
  }
  const std::lock_guard frame(frames_);
  hd.make_current_device(device.handle);
  describe(hd, device);
  static_cast<void>(hd.first_error());
  return device;
}

void HdSession::close(const HdLibrary& hd, const HdDevice& device) {
  const std::lock_guard lock(guard_);
  std::erase_if(open_, [&](const HdDevice& other) { return other.handle == device.handle; });
  if (open_.empty()) hd.stop_scheduler();
  hd.disable_device(device.handle);
}

base::Result<HdDevice> HdSession::look(const HdLibrary& hd, const std::string& name) {
  const std::lock_guard lock(guard_);
  for (const HdDevice& device : open_) {
    if (device.name == name) return device;
  }
  auto device = init(hd, name);
  if (device) hd.disable_device(device->handle);
  return device;
}

}  // namespace icome::devices
