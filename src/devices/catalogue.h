#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "devices/back_end.h"
#include "devices/head_device.h"
#include "devices/mapped_device.h"
#include "devices/navigation_device.h"

namespace icome::devices {

/// All ways to devices, in the order in which `icome devices` lists them.
std::span<const BackEnd> back_ends();

/// The devices that are there, and for each back-end without one why not. May take some seconds.
std::vector<DeviceEntry> list_devices();

/// Does the name stand for a device that a back-end opens, such as "haply:049D", rather than for a simulated
/// one with a profile's abilities?
bool is_device_address(std::string_view name);

/// Opens a pointer device, with the mapping of its profile file: "simulated", the name of a profile such as
/// "Touch" (a simulated hand with that device's abilities), or an address, "BACKEND" for its first device or
/// "BACKEND:WHICH". May take seconds. Fails with what is missing and what to do.
base::Result<std::unique_ptr<PointerDevice>> open_device(std::string_view name);
/// Opens a pointer device likewise, with this mapping in place of its file's.
base::Result<std::unique_ptr<PointerDevice>> open_device(std::string_view name, const DeviceMapping& mapping);

/// The one name of an open device, however it was addressed: DeviceEntry::identity of its entry. Empty: it is
/// not known, as that of simulated ones.
std::string identity_of(const PointerDevice& device);

/// Opens a tracker for the user's head: "vrpn:NAME@HOST:PORT", or "trace:FILE" for a recorded motion. May
/// take seconds.
base::Result<std::unique_ptr<HeadDevice>> open_head(std::string_view name);
/// Opens a device that moves the view: "gamepad" or "gamepad:WHICH". May take seconds.
base::Result<std::unique_ptr<NavigationDevice>> open_navigation(std::string_view name);

}  // namespace icome::devices
