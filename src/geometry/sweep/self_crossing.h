#pragma once
#include <cstdint>
#include <optional>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// The result of a search for a place at which a surface goes through itself.
struct SelfCrossing {
  bool sought = true;                 // false: the tests were used up before the end
  std::optional<Vector3> place = {};  // m, the mesh's frame: near the crossing; nothing: there is none
};

/// Does the surface go through itself, or lie on itself front on front (of a sheet, which has no inside, on
/// either side)? Decided by exact signs: parts that only touch, in a point, along an edge or a front on a
/// front of the other side, do not cross, however near they come, and the smallest crossing is found. One
/// that lies all along edges of both parts is not found, and triangles without area are left out. O(n log n)
/// for n triangles that lie in some order along a surface; `most_tests` bounds the number of tested pairs of
/// triangles that come near each other.
///
/// After Guigue and Devillers (2003), "Fast and robust triangle-triangle overlap test using orientation
/// predicates". Precondition: indices in range, positions finite and as exact_sign.h requires them.
SelfCrossing find_self_crossing(const TriangleMesh& mesh, std::uint64_t most_tests);

}  // namespace icome::geometry
