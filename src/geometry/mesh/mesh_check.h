#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// Fails with a sentence when a vertex is not finite or a triangle names a vertex that does not exist. For
/// tools that are given meshes and choices from outside.
base::Result<void> check_mesh(const TriangleMesh& mesh);

/// Fails with a sentence when one of the chosen vertices or triangles (`what` says which) is not one of the
/// mesh's `count`.
base::Result<void> check_chosen(std::span<const std::uint32_t> chosen, std::size_t count,
                                std::string_view what);

}  // namespace icome::geometry
