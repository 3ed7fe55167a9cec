#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "base/vector.h"

namespace icome::devices {

// A device's axes beside ours are written as the three of its axes that point right, up and to the user:
// "y,z,x", or "y,-x,z" where up is against its x. The commas may be left out: "yzx", "y-xz".

/// The rotation to our frame (x right, y up, z to the user) from the frame of a device with these axes. Fails
/// on a text that names no three axes, or that would mirror left and right.
base::Result<base::Matrix3> rotation_from_axes(std::string_view axes);
/// The text of a rotation, or of the nearest one that only exchanges axes: "y,z,x".
std::string axes_text(const base::Matrix3& ours_from_device);

}  // namespace icome::devices
