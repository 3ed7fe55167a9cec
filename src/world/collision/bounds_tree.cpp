// After the dynamic trees of Bullet and Box2D: the sibling of a new box is where the boxes' surfaces grow
// least, and rotations as in an AVL tree keep the tree low.
#include "world/collision/bounds_tree.h"

#include <algorithm>

namespace icome::world {
namespace {

using base::Bounds;
using base::Vector3;

/// Half the surface area of a box: the measure of how likely others are to meet it.
double half_surface(const Bounds& box) {
  const Vector3 s = box.sizes();
  return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

double merged_surface(const Bounds& a, const Bounds& b) { return half_surface(a.merged(b)); }

}  // namespace

std::uint32_t BoundsTree::take_node() {
  if (free_.empty()) {
    nodes_.emplace_back();
    return std::uint32_t(nodes_.size() - 1);
  }
  const std::uint32_t node = free_.back();
  free_.pop_back();
  nodes_[node] = {};
  return node;
}

/// The node that becomes the sibling of a new box.
std::uint32_t BoundsTree::sibling_for(const Bounds& box) const {
  std::uint32_t at = root_;
  while (nodes_[at].children[0] != kNone) {
    const Node& node = nodes_[at];
    const double here = merged_surface(node.box, box);
    const double beside = 2.0 * here;
    // The growth of a node is charged to every place below it.
    const double growth = 2.0 * (here - half_surface(node.box));
    double costs[2];
    for (int i = 0; i < 2; ++i) {
      const Node& child = nodes_[node.children[i]];
      const double merged = merged_surface(child.box, box);
      costs[i] = growth + (child.children[0] == kNone ? merged : merged - half_surface(child.box));
    }
    if (beside < costs[0] && beside < costs[1]) break;
    at = node.children[costs[1] < costs[0] ? 1 : 0];
  }
  return at;
}

void BoundsTree::replace(std::uint32_t parent, std::uint32_t child, std::uint32_t by) {
  if (by != kNone) nodes_[by].parent = parent;
  if (parent == kNone)
    root_ = by;
  else
    nodes_[parent].children[nodes_[parent].children[0] == child ? 0 : 1] = by;
}

BoundsTree::Leaf BoundsTree::insert(std::uint32_t number, const Bounds& box) {
  const std::uint32_t leaf = take_node();
  nodes_[leaf].box = box;
  nodes_[leaf].number = number;
  if (root_ == kNone) {
    root_ = leaf;
    return leaf;
  }
  const std::uint32_t sibling = sibling_for(box);
  const std::uint32_t joint = take_node();
  replace(nodes_[sibling].parent, sibling, joint);
  nodes_[joint].children[0] = sibling;
  nodes_[joint].children[1] = leaf;
  nodes_[sibling].parent = nodes_[leaf].parent = joint;
  mend_upwards(joint);
  return leaf;
}

void BoundsTree::remove(Leaf leaf) {
  const std::uint32_t joint = nodes_[leaf].parent;
  free_.push_back(leaf);
  if (joint == kNone) {
    root_ = kNone;
    return;
  }
  const Node& node = nodes_[joint];
  const std::uint32_t sibling = node.children[node.children[0] == leaf ? 1 : 0];
  const std::uint32_t above = node.parent;
  replace(above, joint, sibling);
  free_.push_back(joint);
  mend_upwards(above);
}

void BoundsTree::mend_upwards(std::uint32_t from) {
  for (std::uint32_t at = from; at != kNone; at = nodes_[at].parent) {
    at = balance(at);
    mend(at);
  }
}

void BoundsTree::mend(std::uint32_t index) {
  Node& node = nodes_[index];
  const Node& one = nodes_[node.children[0]];
  const Node& other = nodes_[node.children[1]];
  node.box = one.box.merged(other.box);
  node.height = 1 + std::max(one.height, other.height);
}

/// Rotates where one child is more than one level higher than the other: the higher child takes the node's
/// place and gives it its own lower child. Returns the node that then stands there.
std::uint32_t BoundsTree::balance(std::uint32_t index) {
  const Node& node = nodes_[index];
  const int lean = nodes_[node.children[1]].height - nodes_[node.children[0]].height;
  if (lean >= -1 && lean <= 1) return index;
  const int high = lean > 1 ? 1 : 0;
  const std::uint32_t riser = node.children[high];
  const int given =
      nodes_[nodes_[riser].children[0]].height < nodes_[nodes_[riser].children[1]].height ? 0 : 1;
  const std::uint32_t grandchild = nodes_[riser].children[given];
  replace(node.parent, index, riser);
  nodes_[riser].children[given] = index;
  nodes_[index].parent = riser;
  nodes_[index].children[high] = grandchild;
  nodes_[grandchild].parent = index;
  mend(index);
  return riser;
}

}  // namespace icome::world
