#include "devices/forcedimension/dhd_session.h"

#include <fmt/format.h>

#include <algorithm>

#include "devices/driver/device_claim.h"
#include "devices/driver/udev_rule.h"

namespace icome::devices {
namespace {

std::string text_or_empty(const char* text) { return text != nullptr ? text : ""; }

}  // namespace

std::string dhd_identity(int index) { return fmt::format("dhd:{}", index); }

std::string dhd_permission_advice() {
  return udev_rule_advice("dhd", R"(SUBSYSTEM=="usb", ATTR{idVendor}=="1451")") +
         R"( (a Novint Falcon: ATTR{idVendor}=="0403", ATTR{idProduct}=="cb48"))";
}

DhdSession& DhdSession::instance() {
  static DhdSession session;
  return session;
}

base::Result<DhdDevice> DhdSession::open(const DhdLibrary& dhd, std::optional<int> index,
                                         const std::string& model) {
  const std::lock_guard lock(guard_);
  const int count = dhd.get_device_count();
  if (count <= 0)
    return base::fail("no device of Force Dimension or Novint answers; plug it in and switch it on, or " +
                      dhd_permission_advice());
  if (index && *index >= count)
    return base::fail(fmt::format("there is no dhd:{}; devices that are plugged in: {}", *index, count));
  std::string why;
  for (int i = index.value_or(0); i <= index.value_or(count - 1); ++i) {
    if (find_open(i) != nullptr) {
      if (why.empty()) why = in_use_text(dhd_identity(i));
      continue;
    }
    auto device = open_one(dhd, i);
    if (device && (model.empty() || device->model == model)) {
      open_.push_back(*device);
      return device;
    }
    why =
        fmt::format("{} cannot be opened: {}", dhd_identity(i),
                    device ? fmt::format("it is a {}, no {}", device->model, model) : device.error().message);
    if (device) dhd.close(device->id);
  }
  return base::fail(why);
}

base::Result<DhdDevice> DhdSession::open_one(const DhdLibrary& dhd, int index) const {
  const int id = dhd.open_id(static_cast<char>(index));
  if (id < 0) return base::fail(dhd.last_error());
  // Indices may have changed as devices were plugged in or out.
  if (std::any_of(open_.begin(), open_.end(), [&](const DhdDevice& other) { return other.id == id; }))
    return base::fail(
        "the library takes it for another one that is open; unplug both and plug them in again");
  return DhdDevice{index, static_cast<char>(id), text_or_empty(dhd.get_system_name(static_cast<char>(id)))};
}

void DhdSession::close(const DhdLibrary& dhd, const DhdDevice& device) {
  const std::lock_guard lock(guard_);
  dhd.close(device.id);
  std::erase_if(open_, [&](const DhdDevice& other) { return other.id == device.id; });
}

std::vector<DhdDevice> DhdSession::all(const DhdLibrary& dhd) {
  const std::lock_guard lock(guard_);
  std::vector<DhdDevice> devices;
  const int count = std::min(dhd.get_device_count(), 100);
  for (int i = 0; i < count; ++i) {
    if (const DhdDevice* here = find_open(i)) {
      devices.push_back(*here);
      continue;
    }
    const auto device = open_one(dhd, i);
    if (device) dhd.close(device->id);
    devices.push_back(device ? *device : DhdDevice{i, -1, {}});
  }
  return devices;
}

const DhdDevice* DhdSession::find_open(int index) const {
  const auto it = std::find_if(open_.begin(), open_.end(),
                               [&](const DhdDevice& device) { return device.index == index; });
  return it != open_.end() ? &*it : nullptr;
}

}  // namespace icome::devices
