#pragma once
#include <filesystem>

#include "base/vector.h"
#include "world/world.h"

namespace icome::session {

/// Designs of CAD and printing (.csg, .stl) have z up; VRML and glTF, and what says nothing, y.
bool stands_on_z(const std::filesystem::path& design);

/// Where the world of a design lies that has z up, or else y: the stage that it is shown and touched on has y
/// up.
base::Pose stage_from_world(bool z_up);

/// Turns what was read of such a design onto the stage, or what is to be written as one back.
void set_upright(world::World& world);
void lay_down(world::World& world);

}  // namespace icome::session
