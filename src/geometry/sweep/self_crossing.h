#pragma once
#include <cstdint>
#include <optional>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// Whether a surface goes through itself.
struct SelfCrossing {
  bool sought = true;                 // else the tests were used up before it was told
  std::optional<Vector3> place = {};  // m, the mesh's frame: near where it does; nothing: nowhere
};

/// Does the surface go through itself, or lie on itself front on front (of a sheet, which has no inside, on
/// either side)? By exact signs: what only touches, in a point, along an edge or a front on a front of the
/// other side, is no crossing, however near it comes, and of what goes through the smallest bit is found. One
/// that lies all along edges of both parts is passed over, and so are triangles without area. O(n log n) for
/// n triangles that lie in some order along a surface; `most_tests` bounds how many pairs of triangles that
/// come near each other are looked at.
///
/// After Guigue and Devillers (2003), "Fast and robust triangle-triangle overlap test using orientation
/// predicates". Precondition: indices in range, positions finite and as exact_sign.h wants them.
SelfCrossing find_self_crossing(const TriangleMesh& mesh, std::uint64_t most_tests);

}  // namespace icome::geometry
