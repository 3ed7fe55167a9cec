#pragma once
#include <optional>

#include "base/result.h"
#include "files/csg/csg_document.h"
#include "geometry/csg/csg_tree.h"

namespace icome::files {

/// The matrix of a multmatrix statement, its translation in metres.
base::Result<geometry::Affine3> read_matrix(const CsgDocument& document, CsgDocument::Index statement);

/// Does the transform leave no volume?
bool flattens(const geometry::Affine3& transform);

/// The colour that a color statement gives.
struct CsgColour {
  std::optional<geometry::CsgTree::Colour> colour;  // nothing: it has no effect
  bool unknown_name = false;
  bool clamped = false;  // a channel was above 1
};
base::Result<CsgColour> read_colour(const CsgDocument& document, CsgDocument::Index statement);

}  // namespace icome::files
