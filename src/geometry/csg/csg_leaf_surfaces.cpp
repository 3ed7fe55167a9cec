#include "geometry/csg/csg_leaf_surfaces.h"

#include "geometry/tree/hilbert.h"

namespace icome::geometry {
namespace {

/// A transform stretches evenly when its squared stretches differ by less than this part.
constexpr double kEven = 1e-9;

bool stretches_evenly(const Affine3& transform) {
  const Matrix3 squared = transform.linear().transpose() * transform.linear();
  const double mean = squared.trace() / 3;
  return (squared - mean * Matrix3::Identity()).cwiseAbs().maxCoeff() <= kEven * mean;
}

/// The leaves below the root, from left to right. Does not recurse: trees may be deep.
std::vector<CsgTree::Index> leaves_below_root(const CsgTree& tree) {
  std::vector<CsgTree::Index> leaves, todo{tree.root()};
  while (!todo.empty()) {
    const CsgTree::Index index = todo.back();
    todo.pop_back();
    const CsgTree::Node& node = tree.node(index);
    if (node.is_leaf) {
      leaves.push_back(index);
    } else {
      todo.push_back(node.right);
      todo.push_back(node.left);
    }
  }
  return leaves;
}

}  // namespace

CsgLeafSurfaces::CsgLeafSurfaces(const CsgTree& tree, const Bounds& box) {
  std::vector<Leaf> unsorted;
  std::vector<Bounds> parts;
  std::vector<Eigen::Vector3f> centres;
  const std::vector<Affine3> tree_from_node = tree.tree_from_node();
  const std::vector<CsgTree::Index> nodes = leaves_below_root(tree);
  for (std::size_t rank = 0; rank < nodes.size(); ++rank) {
    const CsgTree::Index node = nodes[rank];
    const CsgLeaf leaf(*tree.node(node).shape, tree_from_node[node]);
    const Bounds part = leaf.bounds().intersection(box);
    if (part.isEmpty()) continue;
    unsorted.push_back({leaf, node, rank, stretches_evenly(tree_from_node[node])});
    parts.push_back(part);
    centres.emplace_back(part.center().cast<float>());
  }
  std::vector<FloatBox> boxes;
  for (const std::uint32_t i : hilbert_order(centres)) {
    leaves_.push_back(unsorted[i]);
    boxes.push_back(float_box(parts[i]));
  }
  boxes_ = BoxTree(boxes);
}

double distance_to_surface(const CsgLeaf& leaf, const Vector3& place) {
  const SurfacePoint nearest =
      leaf.inside(place) ? leaf.scp_from_inside(place) : leaf.scp_from_outside(place);
  return (nearest.point - place).norm();
}

}  // namespace icome::geometry
