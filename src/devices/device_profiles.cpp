#include "devices/device_profiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace icome::devices {
namespace {

// Half of the peak force is taken where a data sheet gives no continuous rating: the motors of the
// devices that do give one (PHANToM) hold 14 to 27 % for minutes, parallel devices more.
constexpr double kContinuousShare = 0.5;

// Apparent mass at the tip where no data sheet gives it. Low on purpose: a lighter device has the
// narrower range of stable walls (surface_force.h).
constexpr double kUnknownMass = 0.1;  // kg

// Stiffness of a device whose maker gives none; the common softest device renders less, most render more.
constexpr double kUnknownStiffness = 1000.0;  // N/m

DeviceInfo profile_of(std::string_view name, double workspace_radius, double max_force,
                      double continuous_force, double nominal_stiffness, double effective_mass) {
  return {std::string(name), workspace_radius,  max_force,
          continuous_force,  nominal_stiffness, effective_mass};
}

// Peak force, stiffness and workspace: makers' data sheets and the limits that drivers apply. Continuous
// force and mass of the PHANToMs: thesis table 4.1 (its inertia is an upper bound); of the Touch and Omni:
// data sheet (0.88 N, 45 g). Their nominal stiffness is the one used in practice, not the catalogue's.
const std::array<DeviceInfo, 12>& profile_table() {
  static const std::array<DeviceInfo, 12> kDevices = {
      profile_of("omega.x", 0.075, 12.0, 12.0 * kContinuousShare, 5000.0, kUnknownMass),
      profile_of("delta.3", 0.15, 20.0, 20.0 * kContinuousShare, 5000.0, kUnknownMass),
      profile_of("sigma.7", 0.075, 12.0, 12.0 * kContinuousShare, 4000.0, kUnknownMass),
      profile_of("lambda.7", 0.1125, 12.0, 12.0 * kContinuousShare, 8000.0, kUnknownMass),
      profile_of("Novint Falcon", 0.04, 8.0, 8.0 * kContinuousShare, 3000.0, kUnknownMass),
      profile_of("Touch", 0.10, 3.3, 0.88, 550.0, 0.045),
      profile_of("Omni", 0.075, 3.3, 0.88, 550.0, 0.045),
      profile_of("PHANToM Desktop", 0.10, 6.4, 1.7, 1000.0, 0.075),
      profile_of("PHANToM Premium 1", 0.09, 8.5, 1.4, 800.0, 0.075),
      profile_of("PHANToM Premium 1.5", 0.12, 8.5, 1.4, 800.0, 0.075),
      profile_of("PHANToM Premium 3.0", 0.25, 22.0, 3.0, 1000.0, 0.15),
      profile_of("Haply Inverse3", 0.10, 5.0, 5.0 * kContinuousShare, kUnknownStiffness, kUnknownMass),
  };
  return kDevices;
}

bool same_ignoring_case(std::string_view a, std::string_view b) {
  const auto lower = [](char letter) { return std::tolower(static_cast<unsigned char>(letter)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char left, char right) { return lower(left) == lower(right); });
}

}  // namespace

std::span<const DeviceInfo> device_profiles() { return profile_table(); }

base::Result<DeviceInfo> find_device_profile(std::string_view name) {
  for (const DeviceInfo& device : profile_table()) {
    if (same_ignoring_case(device.name, name)) return device;
  }
  std::string known;
  for (const DeviceInfo& device : profile_table()) known += (known.empty() ? "" : ", ") + device.name;
  return base::fail(fmt::format("no device profile is called \"{}\"; choose one of: {}", name, known));
}

}  // namespace icome::devices
