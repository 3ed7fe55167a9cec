#pragma once
#include "base/result.h"
#include "geometry/contour/dual_contouring.h"
#include "geometry/csg/csg_tree.h"

namespace icome::geometry {

/// A closed mesh of the solid that the tree stands for, for export and far views. A solid with flat faces, of
/// primitives or of meshes, or with walls, plates, rods or slits that are thin against a cell, is cut out
/// (csg_cut.h): flat faces are exact and of few triangles, bent ones have as many as they need to keep within
/// a twentieth of a cell, and nothing is lost. Others are contoured (dual_contouring.h says what that keeps),
/// with edges and corners sampled from the primitives' exact faces; blocks of the grid that none of these
/// passes are skipped.
///
/// In either case random places of each primitive's share in the exact surface, the same each time, are
/// searched for in the mesh. If one is farther from it than two cells, the solid is cut out, or meshed again
/// with smaller cells, a few times; ContourMesh::lost is a place that was missing even then. That happens
/// where thin parts are made by primitives of your own or by large meshes, or where cutting would take too
/// much, as for a block with many narrow holes.
///
/// A tree whose solid is unlimited, for a half-space in it, fails; an empty one gives an empty mesh.
base::Result<ContourMesh> contour(const CsgTree& tree, const ContourOptions& options);

}  // namespace icome::geometry
