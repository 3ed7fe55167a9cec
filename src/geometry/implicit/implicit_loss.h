#pragma once
#include <optional>

#include "geometry/implicit/implicit_surface.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// A place within the solid at that time that a closed mesh of it does not enclose, and whose surroundings
/// of `reach` (m) have no part of the mesh, if one is found: on a plate, for example, that slipped between
/// the points of a grid, or a small body beside a large one. Boxes that may hold surface, as the formula's
/// ranges tell, are divided where the mesh is not near, down to an eighth of `reach`, as far as there are not
/// too many.
std::optional<Vector3> place_that_mesh_lacks(const ImplicitSurface& surface, double time,
                                             const TriangleMesh& mesh, double reach);

}  // namespace icome::geometry
