#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "world/world.h"

namespace icome::interaction {

/// Materials for eye and hand that differ to both: wood, rubber, ice, skin, metal, glass, stone.
const std::vector<world::Material>& material_library();

/// The library's material of that name; null where there is none.
const world::Material* library_material(std::string_view name);

/// The haptic textures that a surface can have, as haptics::make_texture takes them without numbers.
const std::vector<std::string>& haptic_texture_names();
/// "bumps, 0.3 mm deep every 3 mm": a material's texture in words, for people; empty where no texture has
/// that text.
std::string texture_words(const std::string& text);

}  // namespace icome::interaction
