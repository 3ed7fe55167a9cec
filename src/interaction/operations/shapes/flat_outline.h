#pragma once
#include "base/result.h"
#include "geometry/sweep/profile.h"
#include "world/shape/mesh_geometry.h"

namespace icome::interaction {

/// The rim of a flat mesh as a drawing, and the drawing's place.
struct FlatOutline {
  geometry::Profile profile;        // counter-clockwise
  base::Affine3 mesh_from_profile;  // rigid; its z points where the fronts of the mesh do
};

/// The outline of a mesh. Fails, saying what to do, where that is closed or not flat, or its rim not one
/// loop. The drawing's axes are those of the mesh, turned the shortest way so that z points where the fronts
/// do. Where the mesh has texture coordinates, the drawing has places.
base::Result<FlatOutline> flat_outline(const world::MeshGeometry& shape);

}  // namespace icome::interaction
