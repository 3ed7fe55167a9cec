#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "geometry/csg/csg_tree.h"

namespace icome::files {

// A CSG tree as text, for designs in VRML. A line for each node, operands before operations, which name
// them by their index, from 0:
//
//   box:0.1x0.2x0.3 move 0 0 0.05 colour 1 0.5 0 1
//   cylinder:0.02x0.4 matrix 1 0 0 0  0 0 -1 0  0 1 0 0
//   difference 0 1
//
// Primitives are written as geometry::name gives them; `matrix` is parent_from_node, row after row. A mesh
// comes before its first leaf, once for all leaves `mesh N` that share it, as a line `define mesh N` and
// lines `vertex X Y Z` and `triangle I J K`. A line `root N` follows where the root is not the last node.
// Text after a # is a comment. Lengths in metres.

/// The text of a tree, exact to the last bit. Fails for trees that could not be read back, such as those
/// with custom primitives, and says why.
base::Result<std::string> csg_text(const geometry::CsgTree& tree);

/// The tree of a text, which may come from a stranger: the error names the line.
base::Result<geometry::CsgTree> csg_from_text(std::string_view text);

}  // namespace icome::files
