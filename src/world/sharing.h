#pragma once
#include <string>
#include <vector>

#include "world/world.h"

namespace icome::world {

// How many share what is shared, in words for people: "4 objects use this shape". Nobody changes a shape
// for one object and is surprised by the others (thesis 2.4.1). What is not there is used by nobody.

std::string sharing(const World& world, GeometryId shape);
std::string sharing(const World& world, MaterialId material);
std::string sharing(const World& world, TextureId texture);

/// The objects of a shape or of a material, in the order of their ids. Looks at all objects.
std::vector<ObjectId> users(const World& world, GeometryId shape);
std::vector<ObjectId> users(const World& world, MaterialId material);

}  // namespace icome::world
