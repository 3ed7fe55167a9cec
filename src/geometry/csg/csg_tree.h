#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/csg/csg_leaf.h"

namespace icome::geometry {

enum class CsgOperator : std::uint8_t { Union, Intersection, Difference };

/// A tree of solids under union, intersection and difference (thesis section 5.5): binary, as there;
/// several operands are grouped from the left. A plain value. Nodes live in one array, children before
/// parents, so that nothing here recurses however deep the tree is.
class CsgTree {
 public:
  using Index = std::uint32_t;
  using Colour = std::array<float, 4>;  // red, green, blue, alpha in [0, 1]

  struct Node {
    bool is_leaf = false;
    CsgOperator op = CsgOperator::Union;  // of an inner node
    Index left = 0, right = 0;            // of an inner node: its operands
    std::optional<CsgShape> shape;        // of a leaf
    Affine3 parent_from_node = Affine3::Identity();
    std::optional<Colour> colour;  // of a leaf
  };

  /// Adds a leaf and makes it the root. The transform is invertible.
  Index add_leaf(CsgShape shape, const Affine3& parent_from_node = Affine3::Identity(),
                 std::optional<Colour> colour = std::nullopt);
  /// Adds an operation on two nodes that have no parent yet and makes it the root.
  Index add(CsgOperator op, Index left, Index right, const Affine3& parent_from_node = Affine3::Identity());

  // Edits of a tree. Edit a copy while the servo touches the solid compiled from the last version.
  void set_transform(Index node, const Affine3& parent_from_node);
  void set_operator(Index node, CsgOperator op);

  void reserve(std::size_t nodes) { nodes_.reserve(nodes); }

  /// A tree without nodes is the empty solid.
  bool empty() const { return nodes_.empty(); }
  Index root() const { return root_; }
  void set_root(Index root) { root_ = root; }
  const Node& node(Index index) const { return nodes_[index]; }
  std::size_t size() const { return nodes_.size(); }

  /// The transform of every node to the tree's frame, by index.
  std::vector<Affine3> tree_from_node() const;

 private:
  std::vector<Node> nodes_;
  Index root_ = 0;
};

/// The size of a tree, counted from its root.
struct CsgCount {
  std::size_t nodes = 0;       // operations and primitives
  std::size_t primitives = 0;  // leaves
  std::size_t depth = 0;       // nodes on the longest way from the root to a leaf; 1 for a primitive
};
CsgCount count(const CsgTree& tree);

/// Bounds of the solid, by the rules of 5.5.5: the box of both for a union, the common part of the boxes for
/// an intersection, the box of the left for a difference. Empty for an empty solid.
Bounds bounds(const CsgTree& tree);
/// The rule for one operation; empty boxes are those of empty solids.
Bounds combined_bounds(CsgOperator op, const Bounds& left, const Bounds& right);

/// Is the point in the solid (or on its surface, up to rounding)? By walking the tree: the reference, not
/// the fast way. Does not recurse.
bool inside(const CsgTree& tree, const Vector3& point);

}  // namespace icome::geometry
