#pragma once
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "geometry/csg/csg_normal_form.h"

namespace icome::geometry {

/// A CSG tree on its way to another form: its nodes by their index in the tree, with their boxes. Pruning
/// takes nodes out by linking past them. Refers to the tree, which must outlive it.
class CsgPlan {
 public:
  using Index = CsgTree::Index;
  static constexpr Index kNothing = ~Index{0};  // the empty solid

  struct Node {
    bool is_leaf;
    CsgOperator op;
    Index left, right;
    Bounds box;  // tree's frame; infinite in a plan that does not prune
  };

  /// A node adds to the solid, or removes from it: below an odd number of right sides of differences.
  enum class Side : std::uint8_t { Unused, Added, Removed };

  CsgPlan(const CsgTree& tree, bool with_boxes);

  Index root() const { return root_; }
  const Node& node(Index index) const { return nodes_[index]; }
  std::size_t size() const { return nodes_.size(); }

  /// Drops the nodes that 5.5.5 drops: intersections whose boxes do not meet, and right sides of
  /// differences whose boxes do not meet the left ones'.
  void prune();
  /// Drops leaves whose boxes do not meet the space that all operations above leave to them: only those that
  /// a product of the normal form would lose as well, but before it is multiplied out.
  void narrow();

  std::vector<Side> sides() const;

  /// Adds the leaf to a tree, placed by all transforms above it.
  Index copy_leaf(Index leaf, CsgTree& into) const;

 private:
  const CsgTree& tree_;
  std::vector<Affine3> tree_from_node_;
  std::vector<Node> nodes_;
  Index root_ = kNothing;
};

/// Do solids in these boxes share a point, as far as the boxes tell? Touching boxes do.
bool boxes_meet(const Bounds& a, const Bounds& b);

/// The number of nodes that the whole normal or subnormal form of the plan has: infinite beyond 1e308.
double normal_size(const CsgPlan& plan);
double subnormal_size(const CsgPlan& plan);

// Multiply a plan out, all nine rules or rules 1, 3 and 5 only.
base::Result<CsgTree> normal_tree(const CsgPlan& plan, const NormaliseOptions& options);
base::Result<CsgTree> subnormal_tree(const CsgPlan& plan, const NormaliseOptions& options);

}  // namespace icome::geometry
