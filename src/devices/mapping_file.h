#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"
#include "devices/mapped_device.h"

namespace icome::devices {

// A device's profile, device.toml, holds its mapping: `centre_m`, `axes` (the device's axes that point right,
// up and to the user, as in axes.h), `scale`, `scale_follows_view`, `workspace_radius_m`, `max_force_n`,
// `clutch_button`. Keys that are left out keep their values of DeviceMapping.

/// Reads a mapping from text; the error names the source, line and column.
base::Result<DeviceMapping> parse_mapping(std::string_view text, const std::string& source);
/// The text of a mapping, with a line that tells how it was made. A turn that exchanges no axes exactly is
/// written as the nearest one that does.
std::string mapping_text(const DeviceMapping& mapping, const std::string& made_by);

/// The file that holds the mapping of a device, by its address: in $XDG_CONFIG_HOME/icome/devices, or
/// ~/.config/icome/devices.
std::filesystem::path mapping_path(std::string_view address);
/// The device's mapping as its file has it; without a file, the DeviceMapping that changes nothing.
base::Result<DeviceMapping> read_mapping(std::string_view address);
/// Writes the device's file whole or not at all.
base::Result<void> write_mapping(std::string_view address, const DeviceMapping& mapping,
                                 const std::string& made_by);

}  // namespace icome::devices
