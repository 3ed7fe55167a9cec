#pragma once
#include "geometry/mesh/triangle_mesh.h"

namespace icome::files {

// The solids into which OpenSCAD turns round shapes with few facets: closed meshes of planar faces facing
// out, centred on the origin, axis along z. Corners stand at the angles 360 i / `sides`, 3 or more. m.

/// A prism, frustum or pyramid, z in [-height/2, height/2]. One radius may be 0.
geometry::TriangleMesh faceted_cylinder(double bottom_radius, double top_radius, double height, int sides);

/// A ball: rings at the polar angles (i + 0.5) 180 / rings, rings = (sides + 1) / 2, flat at the poles.
geometry::TriangleMesh faceted_ball(double radius, int sides);

}  // namespace icome::files
