#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/result.h"
#include "geometry/contour/contour_progress.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// Stands for a triangle of no face.
inline constexpr std::uint32_t kNoFace = ~std::uint32_t{0};

/// May a triangle with these corners, vertices of the face, stand for a part of it?
using FaceFit = std::function<bool(std::uint32_t face, const std::array<Vector3, 3>& corners)>;

/// A closed manifold mesh with as few vertices in its faces as taking one after the other away leaves: those
/// within a face, and those on an edge between two. What remains stays where it was; pieces and holes remain,
/// and no triangle is turned over. `faces` says for each triangle on which plane or bent surface it lies, the
/// same from both of its sides; those with kNoFace stay. Where `fits` allows only what is exact for planes,
/// the surface is the same up to rounding. `pinned` says which vertices stay, such as the tips of bent faces.
/// `thinnest` (m): no triangle is made that is less high. Fails where `go_on`, asked now and then, says no.
base::Result<TriangleMesh> merge_faces(const TriangleMesh& mesh, const std::vector<std::uint32_t>& faces,
                                       const std::vector<bool>& pinned, double thinnest, const FaceFit& fits,
                                       const ContourProgress& go_on);

}  // namespace icome::geometry
