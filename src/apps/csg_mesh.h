#pragma once
#include <functional>

#include "base/result.h"
#include "geometry/csg_tree.h"
#include "geometry/dual_contouring.h"

namespace icome::apps {

/// The closed mesh of the tree's surface; see geometry::contour.
base::Result<geometry::ContourMesh> mesh_of(const geometry::CsgTree& tree,
                                            const geometry::ContourOptions& options);

}  // namespace icome::apps
