#include "devices/forcedimension/force_dimension.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "base/parse_number.h"
#include "devices/axes.h"
#include "devices/device_profiles.h"
#include "devices/driver/driven_device.h"
#include "devices/driver/environment.h"
#include "devices/driver/model_profile.h"
#include "devices/forcedimension/dhd_session.h"
#include "devices/forcedimension/force_dimension_driver.h"

namespace icome::devices {
namespace {

constexpr int kMostIndex = 99;

constexpr std::array<ModelProfile, 5> kDhdModels = {{{"omega", "omega.x"},
                                                     {"delta", "delta.3"},
                                                     {"sigma", "sigma.7"},
                                                     {"lambda", "lambda.7"},
                                                     {"falcon", "Novint Falcon"}}};

DeviceInfo lowest_limits() {
  DeviceInfo lowest = *find_device_profile(kDhdModels.front().profile);
  for (const ModelProfile& model : kDhdModels) {
    const DeviceInfo other = *find_device_profile(model.profile);
    lowest.workspace_radius = std::min(lowest.workspace_radius, other.workspace_radius);
    lowest.max_force = std::min(lowest.max_force, other.max_force);
    lowest.continuous_force = std::min(lowest.continuous_force, other.continuous_force);
    lowest.nominal_stiffness = std::min(lowest.nominal_stiffness, other.nominal_stiffness);
  }
  return lowest;
}

/// The number of "dhd:0"; nothing for the first one that is not open yet.
base::Result<std::optional<int>> index_of(std::string_view address) {
  if (address.empty()) return std::nullopt;
  const auto index = base::parse_number<int>(address);
  if (!index || *index < 0 || *index > kMostIndex)
    return base::fail(
        fmt::format("dhd:{} names no device; write dhd, or dhd:0 for the first one, dhd:1 for "
                    "the second",
                    address));
  return index;
}

DeviceEntry dhd_entry(std::string name, bool present, std::string why) {
  std::string identity = present ? name : "";
  return {std::move(name), "pointer",      std::string(kForceDimension.name),
          present,         std::move(why), std::move(identity)};
}

std::vector<DeviceEntry> list_dhd() {
  if (const auto settings = force_dimension_settings(); !settings)
    return {dhd_entry("dhd", false, settings.error().message)};
  const auto dhd = DhdLibrary::load();
  if (!dhd) return {dhd_entry("dhd", false, dhd.error().message)};
  std::vector<DeviceEntry> entries;
  for (const DhdDevice& device : DhdSession::instance().all(*dhd)) {
    const bool present = !device.model.empty();
    entries.push_back(dhd_entry(fmt::format("dhd:{}", device.index), present,
                                present ? device.model
                                        : "it is plugged in, but cannot be opened; close other programs that "
                                          "use it, or " +
                                              dhd_permission_advice()));
  }
  if (entries.empty())
    entries.push_back(dhd_entry("dhd", false,
                                "the library is there, but no device answers; plug it in and switch it on, "
                                "or " +
                                    dhd_permission_advice()));
  return entries;
}

base::Result<std::unique_ptr<PointerDevice>> open_dhd(std::string_view address) {
  const auto settings = force_dimension_settings();
  if (!settings) return tl::unexpected(settings.error());
  auto driver = force_dimension_driver(address, *settings);
  if (!driver) return tl::unexpected(driver.error());
  auto device = DrivenDevice::create(std::move(*driver));
  if (!device) return tl::unexpected(device.error());
  return std::unique_ptr<PointerDevice>(std::move(*device));
}

}  // namespace

// Made while compiling, so that other tables may hold it.
constinit const BackEnd kForceDimension = {"forcedimension", "dhd", &list_dhd, &open_dhd};

base::Result<ForceDimensionSettings> force_dimension_settings() {
  ForceDimensionSettings settings;
  if (const auto read = environment_number("ICOME_DHD_RATE", 1000.0, 4000.0, settings.rate); !read)
    return tl::unexpected(read.error());
  if (const auto read = environment_number("ICOME_DHD_GRIP_DEGREES", 5.0, 90.0, settings.grip_open); !read)
    return tl::unexpected(read.error());
  constexpr std::array<std::string_view, 2> kOffOn = {"off", "on"};
  auto gravity = environment_choice("ICOME_DHD_GRAVITY", kOffOn, settings.gravity_compensation ? 1 : 0);
  if (!gravity) return tl::unexpected(gravity.error());
  settings.gravity_compensation = *gravity == 1;
  if (const std::string_view axes = environment_text("ICOME_DHD_AXES"); !axes.empty()) settings.axes = axes;
  if (const auto rotation = rotation_from_axes(settings.axes); !rotation)
    return base::fail("ICOME_DHD_AXES: " + rotation.error().message);
  return settings;
}

base::Result<std::unique_ptr<Driver>> force_dimension_driver(std::string_view address,
                                                             const ForceDimensionSettings& settings) {
  const auto index = index_of(address);
  if (!index) return tl::unexpected(index.error());
  const auto rotation = rotation_from_axes(settings.axes);
  if (!rotation) return tl::unexpected(rotation.error());
  return std::make_unique<ForceDimensionDriver>(*index, *rotation, settings);
}

DeviceInfo force_dimension_profile(std::string_view model) {
  const ModelProfile* known = find_model_profile(kDhdModels, model);
  return known != nullptr ? *find_device_profile(known->profile) : lowest_limits();
}

}  // namespace icome::devices
