#include "geometry/csg/csg_normal_form.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "geometry/csg/csg_plan.h"

namespace icome::geometry {
namespace {

std::size_t saturated(double size) {
  constexpr double kMost = 0x1p63;
  return size < kMost ? static_cast<std::size_t>(size) : std::numeric_limits<std::size_t>::max();
}

/// The chain of intersections and differences that ends in a node, its first operand first.
CsgProduct product_ending_at(const CsgTree& tree, CsgTree::Index end,
                             const std::vector<Affine3>& tree_from_node) {
  std::vector<std::pair<CsgTree::Index, bool>> chain;  // from its end: operands, and whether subtracted
  for (; !tree.node(end).is_leaf; end = tree.node(end).left) {
    chain.emplace_back(tree.node(end).right, tree.node(end).op == CsgOperator::Difference);
  }
  chain.emplace_back(end, false);
  CsgProduct product;
  product.reserve(chain.size());
  for (auto link = chain.rbegin(); link != chain.rend(); ++link) {
    const CsgTree::Node& leaf = tree.node(link->first);
    assert(leaf.is_leaf);
    product.push_back({CsgLeaf(*leaf.shape, tree_from_node[link->first]), link->second, leaf.colour});
  }
  return product;
}

}  // namespace

base::Result<NormalisedTree> normalise(const CsgTree& tree, CsgForm form, const NormaliseOptions& options) {
  if (form == CsgForm::Tree) return NormalisedTree{tree, 0};
  const bool normal = form == CsgForm::Normal;
  NormaliseOptions limited = options;
  limited.max_nodes = std::min<std::size_t>(options.max_nodes, CsgPlan::kNothing - 1);
  CsgPlan plan(tree, options.prune);
  const double whole = normal ? normal_size(plan) : subnormal_size(plan);
  if (options.prune) plan.prune();
  if (options.prune && normal) plan.narrow();
  auto result = normal ? normal_tree(plan, limited) : subnormal_tree(plan, limited);
  if (!result) return base::fail(std::move(result.error().message));
  const std::size_t pruned = saturated(whole) - std::min(saturated(whole), result->size());
  return NormalisedTree{std::move(*result), pruned};
}

std::vector<CsgProduct> products(const CsgTree& normal_form) {
  std::vector<CsgProduct> result;
  if (normal_form.empty()) return result;
  const std::vector<Affine3> tree_from_node = normal_form.tree_from_node();
  std::vector<CsgTree::Index> waiting{normal_form.root()};
  while (!waiting.empty()) {
    const CsgTree::Index index = waiting.back();
    waiting.pop_back();
    const CsgTree::Node& node = normal_form.node(index);
    if (!node.is_leaf && node.op == CsgOperator::Union) {
      waiting.push_back(node.right);
      waiting.push_back(node.left);
    } else {
      result.push_back(product_ending_at(normal_form, index, tree_from_node));
    }
  }
  return result;
}

}  // namespace icome::geometry
