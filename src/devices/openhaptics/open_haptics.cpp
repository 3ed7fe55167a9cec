#include "devices/openhaptics/open_haptics.h"

#include <fmt/format.h>

#include <array>

#include "devices/device_profiles.h"
#include "devices/driver/driven_device.h"
#include "devices/driver/environment.h"
#include "devices/driver/model_profile.h"
#include "devices/openhaptics/hd_session.h"
#include "devices/openhaptics/open_haptics_driver.h"

namespace icome::devices {
namespace {

// The first that fits counts. The Touch X is the Desktop's successor, with a little more force.
constexpr std::array<ModelProfile, 8> kHdModels = {{{"premium 3", "PHANToM Premium 3.0"},
                                                    {"premium 1.5", "PHANToM Premium 1.5"},
                                                    {"premium", "PHANToM Premium 1"},
                                                    {"desktop", "PHANToM Desktop"},
                                                    {"touch x", "PHANToM Desktop"},
                                                    {"omni", "Omni"},
                                                    {"touch", "Touch"},
                                                    {"", "Omni"}}};

DeviceEntry hd_entry(const HdLibrary& hd, const std::string& name) {
  DeviceEntry entry{name.empty() ? "hd" : "hd:" + name, "pointer", std::string(kOpenHaptics.name), false, {}};
  const auto device = HdSession::instance().look(hd, name);
  entry.present = device.has_value();
  entry.why =
      device ? fmt::format("{} of {}, serial number {}", device->info.name, device->vendor, device->serial)
             : device.error().message;
  if (device) entry.identity = device->identity();
  return entry;
}

/// The default device, and those of ICOME_HD_NAMES.
std::vector<std::string> hd_names() {
  std::vector<std::string> names = {""};
  std::string_view rest = environment_text("ICOME_HD_NAMES");
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    if (comma != 0) names.emplace_back(rest.substr(0, comma));
    rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
  }
  return names;
}

std::vector<DeviceEntry> list_hd() {
  if (const auto settings = open_haptics_settings(); !settings)
    return {{"hd", "pointer", std::string(kOpenHaptics.name), false, settings.error().message}};
  const auto hd = HdLibrary::load();
  if (!hd) return {{"hd", "pointer", std::string(kOpenHaptics.name), false, hd.error().message}};
  std::vector<DeviceEntry> entries;
  for (const std::string& name : hd_names()) entries.push_back(hd_entry(*hd, name));
  return entries;
}

base::Result<std::unique_ptr<PointerDevice>> open_hd(std::string_view name) {
  const auto settings = open_haptics_settings();
  if (!settings) return tl::unexpected(settings.error());
  auto device = DrivenDevice::create(open_haptics_driver(name, *settings));
  if (!device) return tl::unexpected(device.error());
  return std::unique_ptr<PointerDevice>(std::move(*device));
}

}  // namespace

// Made while compiling, so that other tables may hold it.
constinit const BackEnd kOpenHaptics = {"openhaptics", "hd", &list_hd, &open_hd};

base::Result<OpenHapticsSettings> open_haptics_settings() {
  OpenHapticsSettings settings;
  constexpr std::array<std::string_view, 2> kModes = {"drives", "follows"};
  const auto mode = environment_choice("ICOME_HD_MODE", kModes, std::size_t(settings.mode));
  if (!mode) return tl::unexpected(mode.error());
  settings.mode = static_cast<OpenHapticsSettings::Mode>(*mode);
  if (const auto read = environment_number("ICOME_HD_RATE", 500.0, 4000.0, settings.rate); !read)
    return tl::unexpected(read.error());
  return settings;
}

std::unique_ptr<Driver> open_haptics_driver(std::string_view name, const OpenHapticsSettings& settings) {
  return std::make_unique<OpenHapticsDriver>(std::string(name), settings);
}

DeviceInfo open_haptics_profile(std::string_view model) {
  return *find_device_profile(find_model_profile(kHdModels, model)->profile);
}

}  // namespace icome::devices
