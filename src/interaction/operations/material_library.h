#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "world/world.h"

namespace icome::interaction {

/// Materials for eye and hand that differ to both: wood, rubber, ice, skin, metal, glass, stone.
const std::vector<world::Material>& material_library();

/// The one of that name; null where there is none.
const world::Material* library_material(std::string_view name);

/// The haptic textures that a surface can have.
const std::vector<std::string>& haptic_texture_names();

}  // namespace icome::interaction
