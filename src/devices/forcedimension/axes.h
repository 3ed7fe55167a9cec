#pragma once
#include <string_view>

#include "base/result.h"
#include "base/vector.h"

namespace icome::devices {

/// The rotation to our frame (x right, y up, z to the user) from a device's own, of a text that says which of
/// its axes point right, up and to the user: "yzx", or "y-xz" where right is its y, up against its x, and to
/// the user its z. Fails on a text that names no three axes, or that would mirror left and right.
base::Result<base::Matrix3> rotation_from_axes(std::string_view axes);

}  // namespace icome::devices
