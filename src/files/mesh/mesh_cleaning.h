#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "world/shape/mesh_geometry.h"

namespace icome::files {

// Checks and repairs that meshes out of files need before they become part of a world.

/// Converts file units to metres. Fails, naming the file, for coordinates too far out to be meant.
base::Result<void> scale(std::vector<geometry::Vector3>& positions, double unit, const std::string& name);

/// Removes triangles that have a number that is not finite. Returns a sentence on them; empty: there
/// were none.
std::string drop_not_finite(world::MeshGeometry& shape);

/// Removes vertices without triangles.
void drop_unused(geometry::TriangleMesh& mesh);

/// "2 faces left out" becomes "2 faces left out."
std::string as_sentence(std::string note);

}  // namespace icome::files
