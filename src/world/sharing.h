#pragma once
#include <string>
#include <vector>

#include "world/world.h"

namespace icome::world {

// Counts the users of shared things, in words for people: "4 objects use this shape". So nobody changes
// a shape for one object and is surprised by the others (thesis 2.4.1). A missing thing has no users.

std::string sharing(const World& world, GeometryId shape);
std::string sharing(const World& world, MaterialId material);
std::string sharing(const World& world, TextureId texture);

/// The objects that use a shape or have a material, in the order of their ids. Visits all objects.
std::vector<ObjectId> users(const World& world, GeometryId shape);
std::vector<ObjectId> users(const World& world, MaterialId material);

}  // namespace icome::world
