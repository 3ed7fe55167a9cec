#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "world/shape/mesh_geometry.h"

namespace icome::files {

// What meshes out of files need before they may be part of a world.

/// Makes file units metres. Fails, naming the file, for coordinates that are too far out to mean anything.
base::Result<void> scale(std::vector<geometry::Vector3>& positions, double unit, const std::string& name);

/// Takes triangles away that have a number that is not finite. Says so in a sentence; empty: there were
/// none.
std::string drop_not_finite(world::MeshGeometry& shape);

/// Takes vertices of no triangle away.
void drop_unused(geometry::TriangleMesh& mesh);

/// "2 faces left out" becomes "2 faces left out."
std::string as_sentence(std::string note);

}  // namespace icome::files
