#include "world/shape/csg_colours.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "geometry/csg/csg_leaf_surfaces.h"

namespace icome::world {
namespace {

using geometry::CsgLeafSurfaces;
using geometry::CsgTree;

constexpr double kSameRounding = 1e-6;  // of the search reach: surfaces that coincide are equally far
constexpr double kSameChord = 0.05;     // of a chord's distance from them, which uneven stretches change

Colour colour_or_none(const std::optional<CsgTree::Colour>& own) {
  if (!own) return kMaterialsColour;
  return {(*own)[0], (*own)[1], (*own)[2]};
}

/// Colour of the operand whose surface is nearest to the place, within `reach` (m); where surfaces
/// coincide, that of the first leaf. On flat faces a place lies on a surface up to rounding, and triangles
/// are large: a surface a little below it is another one.
Colour colour_at(const CsgTree& tree, const CsgLeafSurfaces& surfaces, const Vector3& place, double reach) {
  const CsgLeafSurfaces::Leaf* nearest = nullptr;
  double distance = reach;
  surfaces.near(place, reach, [&](const CsgLeafSurfaces::Leaf& own) {
    const double away = distance_to_surface(own.leaf, place);
    const double same = kSameRounding * reach + kSameChord * std::min(away, distance);
    if (away < distance - same || (away < distance + same && nearest && own.rank < nearest->rank)) {
      distance = std::min(distance, away);
      nearest = &own;
    }
    return true;
  });
  return nearest ? colour_or_none(tree.node(nearest->node).colour) : kMaterialsColour;
}

double longest_side(const geometry::TriangleMesh& mesh, std::size_t triangle) {
  double longest = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, (mesh.corner(triangle, (k + 1) % 3) - mesh.corner(triangle, k)).norm());
  return longest;
}

}  // namespace

std::shared_ptr<const MeshGeometry> coloured_by_operands(const CsgTree& tree,
                                                         std::shared_ptr<const MeshGeometry> surface) {
  if (tree.empty() || surface->mesh.triangles.empty()) return surface;
  const CsgLeafSurfaces surfaces(tree, geometry::bounds(surface->mesh));
  const auto has_none = [&](const CsgLeafSurfaces::Leaf& it) {
    return colour_or_none(tree.node(it.node).colour) == kMaterialsColour;
  };
  if (std::ranges::all_of(surfaces.leaves(), has_none)) return surface;
  const geometry::TriangleMesh& mesh = surface->mesh;
  auto coloured = std::make_shared<MeshGeometry>(*surface);
  coloured->colours.resize(mesh.triangles.size());
  base::parallel_for(mesh.triangles.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Vector3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
      coloured->colours[t].fill(colour_at(tree, surfaces, middle, longest_side(mesh, t)));
    }
  });
  return coloured;
}

}  // namespace icome::world
