#include "world/csg_colours.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "geometry/box_tree.h"
#include "geometry/hilbert.h"

namespace icome::world {
namespace {

using geometry::CsgLeaf;
using geometry::CsgTree;

constexpr double kSameRounding = 1e-6;  // of how far is looked: surfaces that coincide are equally far
constexpr double kSameChord = 0.05;     // of how far off them a chord is, which uneven stretches change

/// An operand where it stands in the tree.
struct OwnedLeaf {
  CsgLeaf leaf;
  std::size_t rank;  // from left to right
  Colour colour;
};

Colour colour_or_none(const std::optional<CsgTree::Colour>& own) {
  if (!own) return kMaterialsColour;
  return {(*own)[0], (*own)[1], (*own)[2]};
}

/// The leaves below the root, from left to right. Does not recurse: trees may be deep.
std::vector<OwnedLeaf> leaves_of(const CsgTree& tree) {
  const std::vector<base::Affine3> tree_from_node = tree.tree_from_node();
  std::vector<OwnedLeaf> leaves;
  std::vector<CsgTree::Index> open{tree.root()};
  while (!open.empty()) {
    const CsgTree::Index index = open.back();
    open.pop_back();
    const CsgTree::Node& node = tree.node(index);
    if (node.is_leaf) {
      leaves.push_back(
          {CsgLeaf(*node.shape, tree_from_node[index]), leaves.size(), colour_or_none(node.colour)});
    } else {
      open.push_back(node.right);
      open.push_back(node.left);
    }
  }
  return leaves;
}

/// Finds the operand whose surface a place is on.
class SurfaceOwners {
 public:
  /// `around` holds all places that are asked for.
  SurfaceOwners(std::vector<OwnedLeaf> leaves, const Bounds& around) {
    std::vector<OwnedLeaf> reaching;
    std::vector<Bounds> parts;
    std::vector<Eigen::Vector3f> centres;
    for (OwnedLeaf& it : leaves) {
      const Bounds part = it.leaf.bounds().intersection(around);
      if (part.isEmpty()) continue;
      parts.push_back(part);
      centres.emplace_back(part.center().cast<float>());
      reaching.push_back(std::move(it));
    }
    std::vector<geometry::FloatBox> boxes;
    for (const std::uint32_t i : geometry::hilbert_order(centres)) {
      leaves_.push_back(std::move(reaching[i]));
      boxes.push_back(geometry::float_box(parts[i]));
    }
    boxes_ = geometry::BoxTree(boxes);
  }

  /// Within `reach` of the place; where surfaces coincide, the first leaf has it. On flat faces a place is on
  /// one of them up to rounding, and triangles are large: what lies a little under it is another.
  Colour colour_at(const Vector3& place, double reach) const {
    const OwnedLeaf* nearest = nullptr;
    double distance = reach;
    boxes_.near(geometry::SegmentQuery(place, place, reach), [&](std::uint32_t index) {
      const OwnedLeaf& own = leaves_[index];
      const geometry::SurfacePoint at =
          own.leaf.inside(place) ? own.leaf.scp_from_inside(place) : own.leaf.scp_from_outside(place);
      const double away = (at.point - place).norm();
      const double same = kSameRounding * reach + kSameChord * std::min(away, distance);
      if (away < distance - same || (away < distance + same && nearest && own.rank < nearest->rank)) {
        distance = std::min(distance, away);
        nearest = &own;
      }
      return true;
    });
    return nearest ? nearest->colour : kMaterialsColour;
  }

 private:
  std::vector<OwnedLeaf> leaves_;
  geometry::BoxTree boxes_;
};

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
  std::vector<OwnedLeaf> leaves = leaves_of(tree);
  if (std::all_of(leaves.begin(), leaves.end(),
                  [](const OwnedLeaf& it) { return it.colour == kMaterialsColour; }))
    return surface;
  const geometry::TriangleMesh& mesh = surface->mesh;
  auto coloured = std::make_shared<MeshGeometry>(*surface);
  const SurfaceOwners owners(std::move(leaves), geometry::bounds(mesh));
  coloured->colours.resize(mesh.triangles.size());
  base::parallel_for(mesh.triangles.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Vector3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
      coloured->colours[t].fill(owners.colour_at(middle, longest_side(mesh, t)));
    }
  });
  return coloured;
}

}  // namespace icome::world
