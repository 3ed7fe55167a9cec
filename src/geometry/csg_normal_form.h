#pragma once
#include <cstddef>

#include "base/result.h"
#include "geometry/csg_tree.h"

namespace icome::geometry {

/// The forms of thesis section 5.5.5.
enum class CsgForm {
  Tree,       // as it was made
  Normal,     // all nine rules: a union of products, each an intersection or difference chain of primitives
  Subnormal,  // rules 1, 3 and 5 only: the right operand of every difference is a primitive
};

struct NormaliseOptions {
  bool prune = true;                   // drop what the bounding boxes show to contribute nothing
  std::size_t max_nodes = 10'000'000;  // a normal form can grow exponentially: give up beyond this many
};

struct NormalisedTree {
  CsgTree tree;            // the same solid; transforms have moved to the leaves
  std::size_t pruned = 0;  // nodes that pruning dropped (from the tree and from what the rules made)
};

/// The same solid in another form. Idempotent: a tree in the form comes back as it is. Fails, naming the
/// size reached, when the result would have more than `max_nodes` nodes. Does not recurse.
base::Result<NormalisedTree> normalise(const CsgTree& tree, CsgForm form,
                                       const NormaliseOptions& options = {});

}  // namespace icome::geometry
