#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "base/result.h"
#include "geometry/csg/csg_tree.h"

namespace icome::geometry {

/// The forms of thesis section 5.5.5.
enum class CsgForm {
  Tree,       // as it was made, also when pruning
  Normal,     // all nine rules: a union of products, each an intersection or difference chain of primitives
  Subnormal,  // rules 1, 3 and 5 only: the right operand of every difference is a primitive
};

struct NormaliseOptions {
  bool prune = true;                   // drop what the bounding boxes show to contribute nothing
  std::size_t max_nodes = 10'000'000;  // a normal form can grow exponentially: give up beyond this many
};

struct NormalisedTree {
  CsgTree tree;            // the same solid; transforms have moved to the leaves; empty if it is empty
  std::size_t pruned = 0;  // nodes that the form would have more without pruning
};

/// Brings the solid into another form. Idempotent: a tree in the form comes back as it is. In Normal form the
/// operands of a product keep the tree's order, those that are subtracted after the others. Fails, naming the
/// size, when the result would have more than `max_nodes` nodes. Does not recurse.
base::Result<NormalisedTree> normalise(const CsgTree& tree, CsgForm form,
                                       const NormaliseOptions& options = {});

/// One operand of a product, in the tree's frame.
struct CsgFactor {
  CsgLeaf leaf;
  bool subtracted;  // or else intersected
  std::optional<CsgTree::Colour> colour;
};
/// The space in all of the intersected operands, the first of them included, and in no subtracted one.
using CsgProduct = std::vector<CsgFactor>;

/// The products whose union a tree in Normal form is, from left to right.
std::vector<CsgProduct> products(const CsgTree& normal_form);

}  // namespace icome::geometry
