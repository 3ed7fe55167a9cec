#pragma once
#include <memory>

#include "geometry/csg/csg_tree.h"
#include "world/shape/mesh_geometry.h"

namespace icome::world {

/// Marks a corner of a mesh that shows the material's own colour.
constexpr Colour kMaterialsColour = {-1.0F, -1.0F, -1.0F};

/// The solid's triangles with the colours of the operands whose surface they are, if any has one; of
/// several that coincide, the first counts. Otherwise the triangles unchanged.
std::shared_ptr<const MeshGeometry> coloured_by_operands(const geometry::CsgTree& tree,
                                                         std::shared_ptr<const MeshGeometry> surface);

}  // namespace icome::world
