#pragma once
#include <optional>

#include "base/vector.h"
#include "geometry/csg/csg_tree.h"
#include "geometry/loop/loop_surface.h"
#include "geometry/mesh/triangle_mesh.h"
#include "geometry/primitive/primitive.h"

namespace icome::session {

// Shapes under a linear map that may stretch, shear and mirror, in the frame that it leads to.

/// Maps the mesh. Fronts stay fronts: mirrored triangles are turned.
void stretch(geometry::TriangleMesh& mesh, const base::Matrix3& map);

/// The primitive that the image is; nothing where it is none (an ellipsoid, an oblique cone).
std::optional<geometry::Primitive> stretched(const geometry::Primitive& primitive, const base::Matrix3& map);

geometry::ControlMesh stretched(geometry::ControlMesh control, const base::Matrix3& map);

geometry::CsgTree stretched(geometry::CsgTree tree, const base::Matrix3& map);

}  // namespace icome::session
