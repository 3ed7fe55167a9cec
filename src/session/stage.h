#pragma once
#include <filesystem>

#include "base/vector.h"

namespace icome::session {

/// Designs of CAD and printing (.csg, .stl) have z up; VRML and glTF, and what says nothing, y.
bool stands_on_z(const std::filesystem::path& design);

/// Where the world of a design lies that has z up, or else y: worlds stay as they are in files, the stage
/// that they are shown and touched on has y up.
base::Pose stage_from_world(bool z_up);

}  // namespace icome::session
