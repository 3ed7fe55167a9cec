#include "geometry/csg/csg_tree.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace icome::geometry {
namespace {

/// By index: does the node belong to the tree below its root?
std::vector<bool> below_root(const CsgTree& tree) {
  std::vector<bool> below(tree.size(), false);
  if (tree.empty()) return below;
  below[tree.root()] = true;
  for (CsgTree::Index i = tree.root() + 1; i-- > 0;) {
    const CsgTree::Node& node = tree.node(i);
    if (below[i] && !node.is_leaf) below[node.left] = below[node.right] = true;
  }
  return below;
}

/// An operation whose left operand is being evaluated, then its right one if that did not decide.
struct Waiting {
  CsgOperator op;
  bool left_done;
  CsgTree::Index right;
  std::uint32_t frame;  // of the operands
};

/// The frames above the place where a walk is: tree_from_node, new ones only where something moves.
class FrameStack {
 public:
  void enter(const CsgTree::Node& node) {
    if (node.parent_from_node.matrix() == Affine3::Identity().matrix()) return;
    frames_.push_back(frames_.back() * node.parent_from_node);
  }
  void return_to(std::uint32_t frame) { frames_.resize(frame + 1); }
  std::uint32_t top() const { return static_cast<std::uint32_t>(frames_.size() - 1); }
  const Affine3& tree_from_top() const { return frames_.back(); }

 private:
  std::vector<Affine3> frames_{Affine3::Identity()};
};

}  // namespace

CsgTree::Index CsgTree::add_leaf(CsgShape shape, const Affine3& parent_from_node,
                                 std::optional<Colour> colour) {
  nodes_.push_back(
      {.is_leaf = true, .shape = std::move(shape), .parent_from_node = parent_from_node, .colour = colour});
  return root_ = static_cast<Index>(nodes_.size() - 1);
}

CsgTree::Index CsgTree::add(CsgOperator op, Index left, Index right, const Affine3& parent_from_node) {
  assert(left < size() && right < size() && left != right);
  nodes_.push_back({.op = op,
                    .left = left,
                    .right = right,
                    .shape = std::nullopt,
                    .parent_from_node = parent_from_node,
                    .colour = std::nullopt});
  return root_ = static_cast<Index>(nodes_.size() - 1);
}

void CsgTree::set_transform(Index node, const Affine3& parent_from_node) {
  assert(node < size());
  nodes_[node].parent_from_node = parent_from_node;
}

void CsgTree::set_operator(Index node, CsgOperator op) {
  assert(node < size() && !nodes_[node].is_leaf);
  nodes_[node].op = op;
}

std::vector<Affine3> CsgTree::tree_from_node() const {
  std::vector<Affine3> result(nodes_.size());
  for (Index i = 0; i < nodes_.size(); ++i) result[i] = nodes_[i].parent_from_node;
  for (Index i = static_cast<Index>(nodes_.size()); i-- > 0;) {
    const Node& node = nodes_[i];
    if (i == root_) result[i] = node.parent_from_node;  // also when it is an operand of a larger tree
    if (node.is_leaf) continue;
    for (const Index operand : {node.left, node.right}) {
      result[operand] = result[i] * nodes_[operand].parent_from_node;
    }
  }
  return result;
}

CsgCount count(const CsgTree& tree) {
  CsgCount total;
  if (tree.empty()) return total;
  std::vector<std::size_t> depth(tree.size(), 0);  // from the root, 0 for what is not below it
  depth[tree.root()] = 1;
  for (CsgTree::Index i = tree.root() + 1; i-- > 0;) {
    if (depth[i] == 0) continue;
    const CsgTree::Node& node = tree.node(i);
    ++total.nodes;
    total.depth = std::max(total.depth, depth[i]);
    if (node.is_leaf) {
      ++total.primitives;
    } else {
      depth[node.left] = depth[node.right] = depth[i] + 1;
    }
  }
  return total;
}

Bounds combined_bounds(CsgOperator op, const Bounds& left, const Bounds& right) {
  if (op == CsgOperator::Difference) return left;
  if (op == CsgOperator::Union) {
    if (left.isEmpty() || right.isEmpty()) return left.isEmpty() ? right : left;
    return left.merged(right);
  }
  const Bounds shared = left.intersection(right);
  return shared.isEmpty() ? Bounds() : shared;  // not a box turned inside-out
}

Bounds bounds(const CsgTree& tree) {
  if (tree.empty()) return {};
  const std::vector<bool> below = below_root(tree);
  const std::vector<Affine3> tree_from_node = tree.tree_from_node();
  std::vector<Bounds> boxes(tree.root() + 1);
  for (CsgTree::Index i = 0; i <= tree.root(); ++i) {
    if (!below[i]) continue;
    const CsgTree::Node& node = tree.node(i);
    boxes[i] = node.is_leaf ? shape_bounds(*node.shape, tree_from_node[i])
                            : combined_bounds(node.op, boxes[node.left], boxes[node.right]);
  }
  return boxes[tree.root()];
}

bool inside(const CsgTree& tree, const Vector3& point) {
  if (tree.empty()) return false;
  std::vector<Waiting> waiting;
  FrameStack frames;
  CsgTree::Index next = tree.root();
  while (true) {
    const CsgTree::Node* node = &tree.node(next);
    for (frames.enter(*node); !node->is_leaf; frames.enter(*node)) {
      waiting.push_back({node->op, false, node->right, frames.top()});
      node = &tree.node(node->left);
    }
    bool answer = shape_encloses(*node->shape, unplacing(frames.tree_from_top()) * point);
    // Upwards, past every operation that this answer decides.
    while (true) {
      if (waiting.empty()) return answer;
      const Waiting& operation = waiting.back();
      const bool decides = operation.op == CsgOperator::Union ? answer : !answer;
      if (!operation.left_done && !decides) break;
      if (operation.left_done && operation.op == CsgOperator::Difference) answer = !answer;
      waiting.pop_back();
    }
    waiting.back().left_done = true;
    next = waiting.back().right;
    frames.return_to(waiting.back().frame);
  }
}

}  // namespace icome::geometry
