#pragma once
#include <array>

#include "world/world.h"

namespace icome::world {

/// The specular colour of a surface that is partly metal, linear: the surface's own colour for metal, a
/// twenty-fifth of the light for all else, mixed by `metallic`, 0 ... 1 (glTF 2.0, B.2.1).
std::array<double, 3> metal_specular(const std::array<double, 3>& base, double metallic);

/// Share of the specular light in the surface's own colour, 0 ... 1: the material's metal, as long as
/// its specular colour is what follows from that and its diffuse colour; else 0.
float metal_of(const Material& material);

}  // namespace icome::world
