#include "devices/openhaptics/hd_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "devices/driver/device_claim.h"
#include "devices/driver/udev_rule.h"
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

constexpr std::int64_t kHangs = 500'000'000;  // ns, longer than any turn takes but one in which a call hangs

base::Result<HdDevice> hanging_library() {
  return base::fail(
      "a call of OpenHaptics does not end; unplug the PHANToM or Touch, and restart the program");
}

}  // namespace

/// A turn in which all open devices rest and no frames are made: opening a device may take seconds, for which
/// a device would else keep the force of its last frame. Frames are left out rather than awaited: the
/// scheduler makes them, and the library may need it meanwhile.
class HdSession::Pause {
 public:
  Pause(HdSession& session, const HdLibrary& hd) : turns_(session.turns_), turn_(turns_.take(kHangs)) {
    if (!turn_) return;
    turns_.pause();
    for (const HdDevice& device : session.open_) rest(hd, device.handle);
    static_cast<void>(hd.first_error());
  }
  ~Pause() {
    if (turn_) turns_.resume();
  }
  Pause(const Pause&) = delete;
  Pause& operator=(const Pause&) = delete;

  /// False where a call of the library hangs.
  explicit operator bool() const { return turn_.owns_lock(); }

 private:
  static void rest(const HdLibrary& hd, unsigned device) {
    constexpr std::array<double, 3> kNone = {};  // N
    hd.make_current_device(device);
    hd.begin_frame(device);
    hd.set_doublev(HdLibrary::kForce, kNone.data());
    hd.end_frame(device);
  }

  HdTurns& turns_;
  HdTurns::Turn turn_;
};

HdSession& HdSession::instance() {
  // Never destroyed, as a call that hangs may go on while the program ends.
  static HdSession& session = *new HdSession();
  return session;
}

base::Result<HdDevice> HdSession::open(const HdLibrary& hd, const std::string& name, double rate) {
  const std::lock_guard lock(guard_);
  shut_those_that_hung(hd);
  for (const HdDevice& other : open_)
    if (other.hangs) return hanging_library();
  if (const HdDevice* const other = find_open(name)) return base::fail(in_use_text(other->address()));
  const Pause pause(*this, hd);
  if (!pause) return hanging_library();
  auto device = start(hd, name, rate);
  if (device) open_.push_back(*device);
  return device;
}

/// Opens a device in a pause, and starts the scheduler for the first one.
base::Result<HdDevice> HdSession::start(const HdLibrary& hd, const std::string& name, double rate) {
  auto device = init(hd, name);
  if (!device) return device;
  hd.enable(HdLibrary::kForceClamping);
  hd.enable(HdLibrary::kForceRamping);
  hd.enable(HdLibrary::kForceOutput);
  unsigned error = hd.first_error();
  if (error == 0 && open_.empty()) {
    hd.set_scheduler_rate(static_cast<unsigned long>(rate));
    // A rate that the device does not know is no reason to go without it.
    static_cast<void>(hd.first_error());
    hd.start_scheduler();
    error = hd.first_error();
  }
  if (error == 0) return device;
  hd.disable_device(device->handle);
  return base::fail(fmt::format("{} was found, but does not start: {}; switch it off and on again",
                                device->info.name, hd.text_of(error)));
}

/// Opens and describes a device in a pause; it is the current one then.
base::Result<HdDevice> HdSession::init(const HdLibrary& hd, const std::string& name) {
  HdDevice device;
  device.name = name;
  device.handle = hd.init_device(name.empty() ? nullptr : name.c_str());
  const unsigned error = hd.first_error();
  if (device.handle == HdLibrary::kInvalidDevice || error == HdLibrary::kCommunication ||
      error == HdLibrary::kDeviceFault) {
    if (device.handle != HdLibrary::kInvalidDevice) hd.disable_device(device.handle);
    return tl::unexpected(no_answer(name, error != 0 ? hd.text_of(error) : "no reason is given"));
  }
  hd.make_current_device(device.handle);
  describe(hd, device);
  static_cast<void>(hd.first_error());
  identities_[name] = device.identity();
  return device;
}

/// A library does not say that a device is open by another name; it only gives none.
base::Error HdSession::no_answer(const std::string& name, const std::string& why) const {
  const std::string by_name = name.empty() ? "" : " by the name of " + name;
  if (open_.empty())
    return {
        fmt::format("no PHANToM or Touch answers{} ({}); plug it in, switch it on, and try the test program "
                    "of its driver; where only root may use a Touch, {}",
                    by_name, why, udev_rule_advice("hd", R"(SUBSYSTEMS=="usb", ATTRS{idVendor}=="2988")"))};
  std::string others;
  for (const HdDevice& other : open_) others += (others.empty() ? "" : " or ") + other.address();
  return {
      fmt::format("no other PHANToM or Touch answers{} ({}); if it is the one that this program uses as {}, "
                  "disconnect it there first, else plug it in and switch it on",
                  by_name, why, others)};
}

/// The open device of that name, or the one that was seen under it before; null without one.
const HdDevice* HdSession::find_open(const std::string& name) const {
  const auto seen = identities_.find(name);
  const auto it = std::find_if(open_.begin(), open_.end(), [&](const HdDevice& device) {
    return device.name == name || (seen != identities_.end() && seen->second == device.identity());
  });
  return it != open_.end() ? &*it : nullptr;
}

void HdSession::close(const HdLibrary& hd, const HdDevice& device) {
  const std::lock_guard lock(guard_);
  if (shut(hd, device.handle)) return;
  for (HdDevice& other : open_) other.hangs = other.hangs || other.handle == device.handle;
}

/// Disables a device; false where a call of the library hangs, for which stopping the scheduler would wait.
bool HdSession::shut(const HdLibrary& hd, unsigned device) {
  if (!turns_.take(kHangs)) return false;
  if (open_.size() == 1) hd.stop_scheduler();
  const Pause pause(*this, hd);
  if (!pause) return false;
  std::erase_if(open_, [&](const HdDevice& other) { return other.handle == device; });
  hd.disable_device(device);
  static_cast<void>(hd.first_error());
  return true;
}

void HdSession::shut_those_that_hung(const HdLibrary& hd) {
  const std::vector<HdDevice> before = open_;
  for (const HdDevice& device : before) {
    if (device.hangs && !shut(hd, device.handle)) return;
  }
}

base::Result<HdDevice> HdSession::look(const HdLibrary& hd, const std::string& name) {
  const std::lock_guard lock(guard_);
  shut_those_that_hung(hd);
  if (const HdDevice* const device = find_open(name); device != nullptr && !device->hangs) return *device;
  const Pause pause(*this, hd);
  if (!pause) return hanging_library();
  auto device = init(hd, name);
  if (device) hd.disable_device(device->handle);
  static_cast<void>(hd.first_error());
  return device;
}

void HdSession::keep(std::shared_ptr<void> used) {
  const std::lock_guard lock(guard_);
  kept_.push_back(std::move(used));
}

}  // namespace icome::devices
