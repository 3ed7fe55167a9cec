#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"
#include "devices/mapped_device.h"

namespace icome::devices {

// A device's profile, device.toml, holds its mapping: `centre_m`, `axes` (which axes of the readings as the
// back-end gives them point right, up and to the user, as in axes.h: "x,y,z" where it is right already),
// `scale`, `scale_follows_view`, `workspace_radius_m`, `max_force_n`, `clutch_button`. Keys that are left out
// keep their values of DeviceMapping.

/// Reads a mapping from text; the error names the source, line and column.
base::Result<DeviceMapping> parse_mapping(std::string_view text, const std::string& source);
/// The text of a mapping, with a line that tells how it was made. A scale that follows the view is left out.
/// A turn that exchanges no axes exactly is written as the nearest one that does.
std::string mapping_text(const DeviceMapping& mapping, const std::string& made_by);

/// The file that the mapping of a device is written to, by its address: in $XDG_CONFIG_HOME/icome/devices, or
/// ~/.config/icome/devices; empty where neither is known.
std::filesystem::path mapping_path(std::string_view address);
/// The device's mapping as its file has it, or that of its back-end ("dhd" for "dhd:0"), or, for a back-end's
/// first device, the only file that one of its devices has; without any, the DeviceMapping that changes
/// nothing. Fails where several files could be meant.
base::Result<DeviceMapping> read_mapping(std::string_view address);
/// Can the device's file be written, as far as can be told without writing? The error says what to do.
base::Result<void> check_mapping_place(std::string_view address);
/// Writes the device's file whole or not at all.
base::Result<void> write_mapping(std::string_view address, const DeviceMapping& mapping,
                                 const std::string& made_by);

}  // namespace icome::devices
