#include "geometry/mesh/mesh_check.h"

#include <fmt/format.h>

#include <algorithm>

namespace icome::geometry {

base::Result<void> check_mesh(const TriangleMesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  for (std::size_t v = 0; v < vertices; ++v) {
    if (mesh.positions[v].allFinite()) continue;
    return base::fail(fmt::format("vertex {} of the mesh is not finite: repair the mesh first", v));
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const std::uint32_t highest = std::max({a, b, c});
    if (highest < vertices) continue;
    return base::fail(
        fmt::format("triangle {} names vertex {}, but the mesh has only {}: repair the mesh first", t,
                    highest, vertices));
  }
  return {};
}

base::Result<void> check_chosen(std::span<const std::uint32_t> chosen, std::size_t count,
                                std::string_view what) {
  for (const std::uint32_t index : chosen) {
    if (index < count) continue;
    return base::fail(
        fmt::format("{} {} is not there: the mesh has only {}, counted from 0", what, index, count));
  }
  return {};
}

}  // namespace icome::geometry
