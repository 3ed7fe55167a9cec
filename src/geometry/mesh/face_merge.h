#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/result.h"
#include "geometry/contour/contour_progress.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// The number of a triangle's face where it belongs to none.
inline constexpr std::uint32_t kNoFace = ~std::uint32_t{0};

/// May a triangle with these corners, vertices of the face, represent a part of it?
using FaceFit = std::function<bool(std::uint32_t face, const std::array<Vector3, 3>& corners)>;

/// A closed manifold mesh from which vertices have been removed one after the other while possible: those
/// within a face, and those on an edge between two. The others stay where they were; pieces and holes remain,
/// and no triangle is turned over. `faces` has for each triangle the plane or bent surface on which it lies,
/// the same from both of its sides; those with kNoFace stay. Where `fits` allows only exact triangles for
/// planes, the surface is the same up to rounding. `pinned` tells which vertices stay, such as tips of bent
/// faces. `thinnest` (m): no triangle is made that is less high. Fails if `go_on`, asked at times, is false.
base::Result<TriangleMesh> merge_faces(const TriangleMesh& mesh, const std::vector<std::uint32_t>& faces,
                                       const std::vector<bool>& pinned, double thinnest, const FaceFit& fits,
                                       const ContourProgress& go_on);

}  // namespace icome::geometry
