#include "devices/driver/device_claim.h"

#include <mutex>
#include <set>
#include <utility>

namespace icome::devices {
namespace {

/// The identities of the devices that this program uses.
struct DevicesInUse {
  std::mutex guard;
  std::set<std::string> identities;
};

DevicesInUse& devices_in_use() {
  static DevicesInUse devices;
  return devices;
}

}  // namespace

base::Result<DeviceClaim> DeviceClaim::of(const std::string& identity) {
  DevicesInUse& devices = devices_in_use();
  const std::lock_guard lock(devices.guard);
  if (!devices.identities.insert(identity).second) return base::fail(in_use_text(identity));
  DeviceClaim claim;
  claim.identity_ = identity;
  return claim;
}

bool DeviceClaim::is_taken(const std::string& identity) {
  DevicesInUse& devices = devices_in_use();
  const std::lock_guard lock(devices.guard);
  return devices.identities.contains(identity);
}

DeviceClaim::DeviceClaim(DeviceClaim&& other) noexcept : identity_(std::exchange(other.identity_, {})) {}

DeviceClaim& DeviceClaim::operator=(DeviceClaim&& other) noexcept {
  std::swap(identity_, other.identity_);
  return *this;
}

DeviceClaim::~DeviceClaim() {
  if (identity_.empty()) return;
  DevicesInUse& devices = devices_in_use();
  const std::lock_guard lock(devices.guard);
  devices.identities.erase(identity_);
}

std::string in_use_text(const std::string& identity) {
  return identity + " is in use by this program already; disconnect it there first";
}

}  // namespace icome::devices
