#pragma once
#include "base/result.h"
#include "geometry/csg_tree.h"
#include "geometry/dual_contouring.h"

namespace icome::geometry {

/// A closed mesh of the solid that the tree stands for, for export and far views (dual_contouring.h says
/// what it keeps and when it fails). Its edges and corners are sampled from the primitives' exact faces, and
/// blocks of the grid that none of these passes are not looked at. A solid with walls, plates or rods that
/// are thin against a cell is cut out instead (csg_cut.h), so that none is lost; only where operands are
/// meshes or primitives of your own may thin parts be, or where cutting would take too much, as for a block
/// with many narrow holes, and nobody limits the triangles. A tree whose solid is unlimited, for a
/// half-space in it, fails; an empty one gives an empty mesh.
base::Result<ContourMesh> contour(const CsgTree& tree, const ContourOptions& options);

}  // namespace icome::geometry
