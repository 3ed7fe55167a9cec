#include "geometry/csg/csg_plan.h"

#include <limits>

namespace icome::geometry {
namespace {

Bounds all_space() {
  const Vector3 far = Vector3::Constant(std::numeric_limits<double>::infinity());
  return {-far, far};
}

}  // namespace

bool boxes_meet(const Bounds& a, const Bounds& b) { return !a.intersection(b).isEmpty(); }

CsgPlan::CsgPlan(const CsgTree& tree, bool with_boxes) : tree_(tree), tree_from_node_(tree.tree_from_node()) {
  if (tree.empty()) return;
  root_ = tree.root();
  nodes_.reserve(root_ + 1);
  for (Index i = 0; i <= root_; ++i) {
    const CsgTree::Node& node = tree.node(i);
    nodes_.push_back({node.is_leaf, node.op, node.left, node.right, all_space()});
  }
  if (!with_boxes) return;
  const std::vector<Side> side = sides();
  for (Index i = 0; i <= root_; ++i) {
    Node& node = nodes_[i];
    if (side[i] == Side::Unused) continue;
    node.box = node.is_leaf ? shape_bounds(*tree.node(i).shape, tree_from_node_[i])
                            : combined_bounds(node.op, nodes_[node.left].box, nodes_[node.right].box);
  }
}

std::vector<CsgPlan::Side> CsgPlan::sides() const {
  std::vector<Side> side(nodes_.size(), Side::Unused);
  if (root_ == kNothing) return side;
  side[root_] = Side::Added;
  for (Index i = root_ + 1; i-- > 0;) {
    const Node& node = nodes_[i];
    if (side[i] == Side::Unused || node.is_leaf) continue;
    const Side other = side[i] == Side::Added ? Side::Removed : Side::Added;
    side[node.left] = side[i];
    side[node.right] = node.op == CsgOperator::Difference ? other : side[i];
  }
  return side;
}

void CsgPlan::prune() {
  if (root_ == kNothing) return;
  const std::vector<Side> side = sides();
  std::vector<Index> becomes(nodes_.size(), kNothing);
  for (Index i = 0; i <= root_; ++i) {
    if (side[i] == Side::Unused) continue;
    Node& node = nodes_[i];
    if (node.is_leaf) {
      if (!node.box.isEmpty()) becomes[i] = i;
      continue;
    }
    const Index left = becomes[node.left], right = becomes[node.right];
    const bool meet =
        left != kNothing && right != kNothing && boxes_meet(nodes_[left].box, nodes_[right].box);
    const bool both = node.op == CsgOperator::Union ? left != kNothing && right != kNothing : meet;
    if (both) {
      node = {false, node.op, left, right, combined_bounds(node.op, nodes_[left].box, nodes_[right].box)};
      becomes[i] = i;
    } else if (node.op == CsgOperator::Union) {
      becomes[i] = left == kNothing ? right : left;
    } else if (node.op == CsgOperator::Difference) {
      becomes[i] = left;
    }
  }
  root_ = becomes[root_];
}

void CsgPlan::narrow() {
  if (root_ == kNothing) return;
  const std::vector<Side> side = sides();
  std::vector<Bounds> left_over(nodes_.size());  // by the operations above
  left_over[root_] = nodes_[root_].box;
  for (Index i = root_ + 1; i-- > 0;) {
    if (side[i] == Side::Unused) continue;
    Node& node = nodes_[i];
    if (node.is_leaf) {
      if (!boxes_meet(node.box, left_over[i])) node.box.setEmpty();
      continue;
    }
    left_over[node.left] = left_over[node.right] = left_over[i];
    if (node.op != CsgOperator::Union) {
      left_over[node.right] = left_over[i].intersection(nodes_[node.left].box);
    }
    if (node.op == CsgOperator::Intersection) {
      left_over[node.left] = left_over[i].intersection(nodes_[node.right].box);
    }
  }
  prune();
}

CsgPlan::Index CsgPlan::copy_leaf(Index leaf, CsgTree& into) const {
  const CsgTree::Node& node = tree_.node(leaf);
  return into.add_leaf(*node.shape, tree_from_node_[leaf], node.colour);
}

}  // namespace icome::geometry
