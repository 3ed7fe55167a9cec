#pragma once
#include "geometry/loop/loop_surface.h"

namespace icome::haptics {

/// The limit of Loop's subdivision as a mesh, for the judge: subdivided by the rules of the literature (Loop
/// 1987, Hoppe et al. 1994) as they stand there, with no code that evaluates or refines a LoopSurface.
struct PlainLoop {
  geometry::TriangleMesh mesh;  // vertices on the limit, but for the ends of creases within the surface
  double error;                 // m, distance from the limit: half of the last subdivision's change
};

/// Subdivides until the mesh is within a millionth of its size, or has some hundred thousand triangles. Fails
/// with a clause on edges at which more than two triangles meet, and on control meshes that are too large.
base::Result<PlainLoop> plain_loop(const geometry::ControlMesh& control);

}  // namespace icome::haptics
