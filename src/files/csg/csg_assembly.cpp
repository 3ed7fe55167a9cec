#include <utility>

#include "files/csg/csg_builder.h"

namespace icome::files {
namespace {

using geometry::CsgOperator;
using geometry::CsgTree;
using Index = CsgDocument::Index;

/// An operation whose operands are being collected.
struct Chain {
  Index end;  // statement past its operands
  CsgOperator op;
  std::optional<CsgTree::Index> node;  // of the operands so far
};

CsgOperator operator_of(CsgKeyword keyword) {
  if (keyword == CsgKeyword::Intersection) return CsgOperator::Intersection;
  if (keyword == CsgKeyword::Difference) return CsgOperator::Difference;
  return CsgOperator::Union;
}

void add_operand(CsgTree& tree, Chain& chain, CsgTree::Index operand) {
  chain.node = chain.node ? tree.add(chain.op, *chain.node, operand) : operand;
}

}  // namespace

CsgTree assemble(const CsgDocument& document, const CsgParts& parts, io::TimeBudget& time_budget) {
  CsgTree tree;
  std::vector<Chain> open{{parts.end, CsgOperator::Union, std::nullopt}};
  const auto close_until = [&](Index statement) {
    while (open.size() > 1 && open.back().end <= statement) {
      const Chain closed = open.back();
      open.pop_back();
      if (closed.node) add_operand(tree, open.back(), *closed.node);
    }
  };
  auto leaf = parts.leaves.begin();
  for (Index i = parts.begin; i < parts.end;) {
    if (i % 1024 == 0 && !time_budget.lasts(double(i) / double(parts.end))) break;
    close_until(i);
    const auto& [keyword, volume] = parts.parts[i];
    if (volume != CsgVolume::Some) {
      i = document.statements()[i].end;
      continue;
    }
    if (is_primitive(keyword)) {
      while (leaf->statement < i) ++leaf;  // past leaves of solids that other operands made empty
      add_operand(tree, open.back(), tree.add_leaf(leaf->shape, leaf->tree_from_shape, leaf->colour));
    } else {
      open.push_back({document.statements()[i].end, operator_of(keyword), std::nullopt});
    }
    ++i;
  }
  close_until(parts.end);
  return tree;
}

}  // namespace icome::files
