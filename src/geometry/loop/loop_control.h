#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "geometry/loop/loop_surface.h"

namespace icome::geometry {

/// More triangles than this are refused.
inline constexpr std::size_t kMostRefined = 20'000'000;

/// The control mesh of the same limit surface after some steps of Loop's scheme, four triangles for each in
/// every step: at corner 0, 1 and 2 of the triangle, then the middle one. Creases and corners are kept;
/// vertices where several fans of triangles meet become one for each fan. Fails with a sentence on meshes
/// that are not a surface, and when the result would be too large or not finite.
base::Result<ControlMesh> refine_control(const ControlMesh& control, int steps);

/// The edges at which two triangles meet whose normals are more than `angle` apart (rad), by their vertices:
/// those that look sharp. Indices must be in range; triangles without area have no normal and no such edges.
std::vector<std::array<std::uint32_t, 2>> bent_edges(const TriangleMesh& mesh, double angle);

}  // namespace icome::geometry
