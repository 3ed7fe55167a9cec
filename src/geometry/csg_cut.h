#pragma once
#include <cstddef>

#include "base/result.h"
#include "geometry/contour_progress.h"
#include "geometry/csg_program.h"

namespace icome::geometry {

/// A closed mesh of a limited solid, also of walls, plates and rods that are thinner than a cell: tetrahedra
/// are cut along the surfaces of the tree's primitives, one after the other, and what lies on both sides of a
/// cut is told apart by the tree. Flat faces and the edges between them are exact, and of few triangles
/// (flat_merge.h); bent ones are chords,
/// about `cell` m long and at most 0.4 of the bend's radius, whose ends lie on the surface but where another
/// face cuts them off. Only for primitives in closed form (csg_can_cut). Fails as make_csg_tets does, on
/// too many triangles, and where so many surfaces pass one place that cutting would take minutes or
/// gigabytes.
base::Result<TriangleMesh> cut_csg(const CsgTree& tree, double cell, std::size_t max_triangles,
                                   const ContourProgress& go_on);

/// Are all of its primitives in closed form?
bool csg_can_cut(const CsgProgram& program);

/// Has the solid flat faces only?
bool is_flat(const CsgProgram& program);

/// Is there a primitive half of whose share in the surface, or more, has less than `thickness` m of solid
/// behind it, or of free space in front of it, as in a slit? Told from random places, the same each time.
bool is_thin(const CsgProgram& program, double thickness);

}  // namespace icome::geometry
