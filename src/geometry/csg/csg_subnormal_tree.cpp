#include <fmt/format.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/csg/csg_plan.h"

// Rules 1, 3 and 5 of 5.5.5. They copy the left side of a difference, but never look into it: so the result
// is first built with copies shared, which takes as many steps as the plan has nodes. Its size is then
// counted before it is written out.

namespace icome::geometry {
namespace {

using Index = CsgPlan::Index;

class SharedTree {
 public:
  struct Node {
    CsgOperator op;
    Index left, right;  // of a leaf: CsgPlan::kNothing and its index in the plan
    Bounds box;
    double size;  // nodes, once written out
    bool is_leaf() const { return left == CsgPlan::kNothing; }
  };

  explicit SharedTree(const CsgPlan& plan) : plan_(plan) {
    if (plan.root() == CsgPlan::kNothing) return;
    const std::vector<CsgPlan::Side> sides = plan.sides();
    std::vector<Index> made(plan.size(), CsgPlan::kNothing);
    for (Index i = 0; i <= plan.root(); ++i) {
      if (sides[i] != CsgPlan::Side::Added) continue;
      const CsgPlan::Node& node = plan.node(i);
      if (node.is_leaf) {
        made[i] = add_leaf(i);
      } else if (node.op == CsgOperator::Difference) {
        made[i] = subtract(made[node.left], node.right, made);
      } else {
        made[i] = add(node.op, made[node.left], made[node.right]);
      }
    }
    root_ = made[plan.root()];
  }

  Index root() const { return root_; }
  const Node& node(Index index) const { return nodes_[index]; }
  double size() const { return root_ == CsgPlan::kNothing ? 0.0 : nodes_[root_].size; }

  CsgTree written_out() const;

 private:
  /// A right side of a difference that is being rewritten.
  struct Rewriting {
    Index from;       // the solid that it is subtracted from
    Index right;      // in the plan: the subtracted node
    bool left_done;   // of the right side's own operands
    Index with_left;  // the result for its left operand
  };

  Index add_leaf(Index leaf) {
    nodes_.push_back({CsgOperator::Union, CsgPlan::kNothing, leaf, plan_.node(leaf).box, 1.0});
    return static_cast<Index>(nodes_.size() - 1);
  }

  /// Adds an operation. Unions with nothing, and empty intersections (by their boxes), are not made.
  Index add(CsgOperator op, Index left, Index right) {
    if (op == CsgOperator::Union && (left == CsgPlan::kNothing || right == CsgPlan::kNothing))
      return left == CsgPlan::kNothing ? right : left;
    if (left == CsgPlan::kNothing || right == CsgPlan::kNothing) return CsgPlan::kNothing;
    const Node& a = nodes_[left];
    const Node& b = nodes_[right];
    if (op == CsgOperator::Intersection && !boxes_meet(a.box, b.box)) return CsgPlan::kNothing;
    nodes_.push_back({op, left, right, combined_bounds(op, a.box, b.box), 1.0 + a.size + b.size});
    return static_cast<Index>(nodes_.size() - 1);
  }

  /// `from` minus a node of the plan; `made` are the results of those that are added, not removed.
  Index subtract(Index from, Index right, const std::vector<Index>& made);

  const CsgPlan& plan_;
  std::vector<Node> nodes_;
  Index root_ = CsgPlan::kNothing;
};

Index SharedTree::subtract(Index from, Index right, const std::vector<Index>& made) {
  if (from == CsgPlan::kNothing) return CsgPlan::kNothing;
  std::vector<Rewriting> waiting;
  while (true) {
    const CsgPlan::Node* node = &plan_.node(right);
    bool meets = boxes_meet(nodes_[from].box, node->box);
    while (meets && !node->is_leaf) {
      waiting.push_back({from, right, false, CsgPlan::kNothing});
      right = node->left;
      node = &plan_.node(right);
      meets = boxes_meet(nodes_[from].box, node->box);
    }
    Index result = meets ? add(CsgOperator::Difference, from, add_leaf(right)) : from;
    while (true) {
      if (waiting.empty()) return result;
      Rewriting& outer = waiting.back();
      const CsgPlan::Node& subtracted = plan_.node(outer.right);
      if (subtracted.op == CsgOperator::Difference) {  // rule 5
        const Index kept = add(CsgOperator::Intersection, outer.from, made[subtracted.right]);
        result = add(CsgOperator::Union, result, kept);
      } else if (!outer.left_done) {
        outer.left_done = true;
        outer.with_left = result;
        from = subtracted.op == CsgOperator::Union ? result : outer.from;
        right = subtracted.right;
        break;
      } else if (subtracted.op == CsgOperator::Intersection) {  // rule 3
        result = add(CsgOperator::Union, outer.with_left, result);
      }  // rule 1 has already subtracted the right side from the rest
      waiting.pop_back();
    }
  }
}

/// The growth of X - Y when Y is rewritten by the three rules: the copies of X, and the nodes added.
struct Growth {
  double copies, more;
  double of(double size) const { return copies * size + more; }
};

CsgTree SharedTree::written_out() const {
  CsgTree tree;
  if (root_ == CsgPlan::kNothing) return tree;
  tree.reserve(static_cast<std::size_t>(size()));
  struct Open {
    Index node;
    bool left_done;
    Index left;  // in the tree
  };
  std::vector<Open> open;
  Index next = root_;
  while (true) {
    for (; !nodes_[next].is_leaf(); next = nodes_[next].left)
      open.push_back({next, false, CsgPlan::kNothing});
    Index made = plan_.copy_leaf(nodes_[next].right, tree);
    for (; !open.empty() && open.back().left_done; open.pop_back()) {
      made = tree.add(nodes_[open.back().node].op, open.back().left, made);
    }
    if (open.empty()) return tree;
    open.back().left_done = true;
    open.back().left = made;
    next = nodes_[open.back().node].right;
  }
}

}  // namespace

double subnormal_size(const CsgPlan& plan) {
  if (plan.root() == CsgPlan::kNothing) return 0.0;
  const std::vector<CsgPlan::Side> sides = plan.sides();
  std::vector<Growth> growth(plan.size(), {1.0, 2.0});  // a primitive: the operation and itself
  std::vector<double> sizes(plan.size(), 1.0);
  for (Index i = 0; i <= plan.root(); ++i) {
    const CsgPlan::Node& node = plan.node(i);
    if (sides[i] == CsgPlan::Side::Unused || node.is_leaf) continue;
    const Growth &left = growth[node.left], &right = growth[node.right];
    if (sides[i] == CsgPlan::Side::Added) {
      sizes[i] = node.op == CsgOperator::Difference ? right.of(sizes[node.left])
                                                    : 1.0 + sizes[node.left] + sizes[node.right];
    } else if (node.op == CsgOperator::Union) {
      growth[i] = {right.copies * left.copies, right.of(left.more)};
    } else if (node.op == CsgOperator::Intersection) {
      growth[i] = {left.copies + right.copies, left.more + right.more + 1.0};
    } else {
      growth[i] = {left.copies + 1.0, left.more + sizes[node.right] + 2.0};
    }
  }
  return sizes[plan.root()];
}

base::Result<CsgTree> subnormal_tree(const CsgPlan& plan, const NormaliseOptions& options) {
  const SharedTree shared(plan);
  if (!(shared.size() <= static_cast<double>(options.max_nodes))) {
    return base::fail(fmt::format(
        "the subnormal form of this tree has {:.4g} nodes, more than the limit of {}; use the tree as it is, "
        "or raise the limit",
        shared.size(), options.max_nodes));
  }
  return shared.written_out();
}

}  // namespace icome::geometry
