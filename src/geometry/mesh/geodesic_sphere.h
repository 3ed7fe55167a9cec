#pragma once
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// A sphere with smooth bumps, of any number of triangles: for tests and benchmarks.
///
/// An icosahedron with `frequency` segments on each edge (1 to 10,000), so 20 * frequency^2 triangles
/// and 10 * frequency^2 + 2 vertices, pushed out to the distance
///   radius * (1 + bump_height * sin(bumps * x) * sin(bumps * y) * sin(bumps * z))
/// from the origin, where (x, y, z) is the unit vector to the vertex. `radius` is in metres, > 0;
/// `bump_height` is a share of it, in (-1, 1), and 0 gives a plain geodesic sphere. Closed, vertices
/// shared, triangles facing out. The same arguments give the same mesh.
///
/// Frequency 17 gives 5,780 triangles, 82: 134,480, 230: 1,058,000, 707: 9,996,980.
TriangleMesh bumpy_geodesic_sphere(int frequency, double radius, double bump_height, int bumps);

}  // namespace icome::geometry
