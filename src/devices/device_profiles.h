#pragma once
#include <span>
#include <string_view>

#include "base/result.h"
#include "devices/pointer_device.h"

namespace icome::devices {

/// Profiles of force-feedback devices that people own: one DeviceInfo each, in the order of the
/// table in device_profiles.cpp, which names the source of every number. Lives as long as the program.
std::span<const DeviceInfo> device_profiles();

/// The profile of that name, upper or lower case alike ("touch", "Novint Falcon"); the error lists the
/// names there are.
base::Result<DeviceInfo> find_device_profile(std::string_view name);

}  // namespace icome::devices
