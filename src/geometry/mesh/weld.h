#pragma once
#include <cstddef>
#include <functional>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// Makes triangles use the first of all vertices at exactly one position. Non-finite vertices equal
/// nothing. Returns the number of vertices that fell out of use; they are not removed. O(n). `lasts`, where
/// given, is called now and then: when it returns false, nothing is changed.
std::size_t weld_equal(TriangleMesh& mesh, const std::function<bool()>& lasts = {});

/// Closes the cracks that rounding leaves between patches: a boundary vertex becomes one with another
/// boundary vertex nearer than 2^-23 of the box's longest side, which is the resolution of
/// single-precision numbers of that size. Returns the number of vertices that fell out of use. Positions
/// must be finite where used; weld equal ones first.
std::size_t weld_cracks(TriangleMesh& mesh);

}  // namespace icome::geometry
