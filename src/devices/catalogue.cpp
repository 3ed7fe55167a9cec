#include "devices/catalogue.h"

#include <fmt/format.h>

#include <vector>

#include "base/clock.h"
#include "devices/device_profiles.h"
#include "devices/driver/driven_device.h"
#include "devices/evdev/back_ends.h"
#include "devices/evdev/gamepad_navigation.h"
#include "devices/evdev/linux_inputs.h"
#include "devices/forcedimension/force_dimension.h"
#include "devices/haply/haply_back_end.h"
#include "devices/mapping_file.h"
#include "devices/openhaptics/open_haptics.h"
#include "devices/simulated/simulated_device.h"
#include "devices/spacemouse/spnav_link.h"
#include "devices/trace_head.h"
#include "devices/vrpn/vrpn_back_end.h"
#include "devices/vrpn/vrpn_head.h"

namespace icome::devices {
namespace {

constexpr std::string_view kSimulated = "simulated";

std::vector<DeviceEntry> list_simulated() {
  return {{std::string(kSimulated), "pointer", std::string(kSimulated), true,
           "a hand and a device in software, always there"}};
}

base::Result<std::unique_ptr<PointerDevice>> open_simulated(std::string_view profile) {
  SimulatedSettings settings;
  if (!profile.empty()) {
    auto info = find_device_profile(profile);
    if (!info) return tl::unexpected(info.error());
    settings.info = std::move(*info);
  }
  return std::make_unique<SimulatedDevice>(std::move(settings));
}

std::vector<DeviceEntry> list_space_mouse() {
  DeviceEntry entry{"spacemouse", "navigation", "spacemouse", SpnavLink::somebody_listens(), {}};
  entry.why = entry.present ? "a 3D mouse, through spacenavd"
                            : "spacenavd is not running: install the package spacenavd, or start it";
  return {entry};
}

const std::vector<BackEnd>& table() {
  static const std::vector<BackEnd> kBackEnds = {
      {kSimulated, kSimulated, list_simulated, open_simulated},
      kOpenHaptics,
      kForceDimension,
      haply_back_end(),
      vrpn_back_end(),
      kTabletBackEnd,
      kMouseBackEnd,
      kGamepadBackEnd,
      {"spacemouse", "spacemouse", list_space_mouse, nullptr},
  };
  return kBackEnds;
}

const BackEnd* back_end_of(std::string_view name) {
  const std::string_view prefix = name.substr(0, name.find(':'));
  for (const BackEnd& back_end : table())
    if (back_end.prefix == prefix) return &back_end;
  return nullptr;
}

std::string_view address_of(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? std::string_view{} : name.substr(colon + 1);
}

base::Result<std::unique_ptr<PointerDevice>> open_raw(std::string_view name) {
  if (name.empty()) return base::fail("no device is named; icome devices lists what is there");
  const BackEnd* const back_end = back_end_of(name);
  if (back_end == nullptr) {
    auto simulated = open_simulated(name);
    if (simulated) return simulated;
    std::string known;
    for (const BackEnd& it : table())
      if (it.open != nullptr) known += fmt::format("{}{}", known.empty() ? "" : ", ", it.prefix);
    return base::fail(
        fmt::format("{}; or an address that begins with one of: {} (icome devices lists what is there)",
                    simulated.error().message, known));
  }
  if (back_end->open == nullptr)
    return base::fail(fmt::format("{}: this moves the view, and is no pointer", name));
  return back_end->open(address_of(name));
}

bool changes_nothing(const DeviceMapping& mapping) {
  return mapping.centre.isZero(0.0) && mapping.ours_from_device.coeffs() == Quaternion::Identity().coeffs() &&
         mapping.scale.value_or(1.0) == 1.0 && mapping.workspace_radius == 0.0 && mapping.max_force == 0.0 &&
         mapping.clutch_button < 0;
}

/// The entry, absent where the profile of a device that is there would keep it from being opened.
DeviceEntry openable(DeviceEntry entry) {
  if (!entry.present || entry.family != "pointer") return entry;
  if (const auto mapping = read_mapping(entry.name); !mapping) {
    entry.present = false;
    entry.why = mapping.error().message + "; correct that, or remove the file";
  }
  return entry;
}

}  // namespace

std::span<const BackEnd> back_ends() { return table(); }

std::vector<DeviceEntry> list_devices() {
  std::vector<DeviceEntry> all;
  for (const BackEnd& back_end : table())
    for (DeviceEntry& entry : back_end.list()) all.push_back(openable(std::move(entry)));
  return all;
}

base::Result<std::unique_ptr<HeadDevice>> open_head(std::string_view name) {
  if (name.starts_with("trace:")) {
    auto head = TraceHead::create(std::string(address_of(name)), base::steady_nanoseconds);
    if (!head) return tl::unexpected(head.error());
    return std::make_unique<TraceHead>(std::move(*head));
  }
  if (!name.starts_with("vrpn:"))
    return base::fail(
        fmt::format("{}: a tracker for the head is named vrpn:NAME@HOST:PORT, camera, "
                    "camera-marker or trace:FILE",
                    name));
  auto head = VrpnHead::create(address_of(name));
  if (!head) return tl::unexpected(head.error());
  return std::move(*head);
}

base::Result<std::unique_ptr<NavigationDevice>> open_navigation(std::string_view name) {
  if (name.substr(0, name.find(':')) != kGamepadBackEnd.prefix)
    return base::fail(
        fmt::format("{}: a device that moves the view is gamepad, gamepad:WHICH or spacemouse", name));
  const auto settings = gamepad_settings_from_environment();
  if (!settings) return tl::unexpected(settings.error());
  auto gamepad = GamepadNavigation::create(linux_inputs(), std::string(address_of(name)), *settings);
  if (!gamepad) return tl::unexpected(gamepad.error());
  return std::move(*gamepad);
}

bool is_device_address(std::string_view name) {
  const BackEnd* const back_end = back_end_of(name);
  return back_end != nullptr && back_end->prefix != kSimulated;
}

std::string identity_of(const PointerDevice& device) {
  if (const auto* mapped = dynamic_cast<const MappedDevice*>(&device)) return identity_of(mapped->own());
  const auto* driven = dynamic_cast<const DrivenDevice*>(&device);
  return driven != nullptr ? driven->identity() : std::string();
}

base::Result<std::unique_ptr<PointerDevice>> open_device(std::string_view name) {
  const auto mapping = read_mapping(name);
  if (!mapping) return tl::unexpected(mapping.error());
  return open_device(name, *mapping);
}

base::Result<std::unique_ptr<PointerDevice>> open_device(std::string_view name,
                                                         const DeviceMapping& mapping) {
  auto device = open_raw(name);
  if (!device || changes_nothing(mapping)) return device;
  return std::make_unique<MappedDevice>(std::move(*device), mapping);
}

}  // namespace icome::devices
