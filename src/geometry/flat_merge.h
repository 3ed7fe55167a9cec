#pragma once
#include <cstdint>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace icome::geometry {

/// Stands for a triangle that lies in no plane shared with others.
inline constexpr std::uint32_t kNoPlane = ~std::uint32_t{0};

/// A closed manifold mesh with as few vertices in its flat faces as taking one after the other away leaves:
/// those within a face, and those on a straight edge between two. What remains stays where it was, so that
/// the surface is the same up to rounding; so are its pieces and holes, and no triangle is turned over.
/// `planes` says for each triangle in which plane it lies; those with kNoPlane stay. Triangles of one number
/// are parallel, but may face both ways. `thinnest` (m): no triangle is made that is less high.
TriangleMesh merge_flat_faces(const TriangleMesh& mesh, const std::vector<std::uint32_t>& planes,
                              double thinnest);

}  // namespace icome::geometry
