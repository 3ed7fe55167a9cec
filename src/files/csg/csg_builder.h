#pragma once
// From the statements of a .csg file to a tree: first the parts that each makes, then their tree.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "files/csg/csg_document.h"
#include "files/csg/csg_keywords.h"
#include "geometry/csg/csg_tree.h"

namespace icome::files {

/// The result of a statement with all in it.
enum class CsgVolume : std::uint8_t {
  LeftOut,  // disabled, background or outside the root: as if it were absent
  None,     // the empty solid
  Some
};

struct CsgParts {
  struct Part {
    CsgKeyword keyword = CsgKeyword::Unknown;
    CsgVolume volume = CsgVolume::LeftOut;
  };
  struct Leaf {
    CsgDocument::Index statement = 0;
    geometry::CsgShape shape;
    geometry::Affine3 tree_from_shape;
    std::optional<geometry::CsgTree::Colour> colour;
  };
  CsgDocument::Index begin = 0, end = 0;  // the statements that count
  std::vector<Part> parts;                // one for each statement of the document
  std::vector<Leaf> leaves;               // in the order of their statements
};

/// Interprets every statement that counts. Adds to `notes` what was left out or repaired. Fails also when
/// the time budget ends.
base::Result<CsgParts> gather_parts(const CsgDocument& document, std::size_t max_primitives,
                                    std::vector<std::string>& notes, io::TimeBudget& time_budget);

/// The tree of the parts; empty when they have no volume. It is incomplete when the time budget ends.
geometry::CsgTree assemble(const CsgDocument& document, const CsgParts& parts, io::TimeBudget& time_budget);

}  // namespace icome::files
