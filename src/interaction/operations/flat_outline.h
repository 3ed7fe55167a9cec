#pragma once
#include "base/result.h"
#include "geometry/profile.h"
#include "geometry/triangle_mesh.h"

namespace icome::interaction {

/// The rim of a flat mesh as a drawing, and where the drawing lies.
struct FlatOutline {
  geometry::Profile profile;        // counter-clockwise
  base::Affine3 mesh_from_profile;  // rigid; its z points where the fronts of the mesh do
};

/// Fails, saying what to do, for a mesh that is closed or not flat, or whose rim is not one loop. The
/// drawing's axes are those of the mesh, turned the shortest way so that z points where the fronts do.
base::Result<FlatOutline> flat_outline(const geometry::TriangleMesh& mesh);

}  // namespace icome::interaction
