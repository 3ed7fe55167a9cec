#pragma once
#include <cstddef>

#include "base/result.h"
#include "geometry/contour/contour_progress.h"
#include "geometry/csg/csg_program.h"

namespace icome::geometry {

/// A closed mesh of a limited solid, also of walls, plates and rods that are thinner than a cell: tetrahedra
/// are cut along the surfaces of the tree's primitives and along the faces of its meshes, one after the
/// other, and the tree tells which pieces are solid. Flat faces and the edges between them are exact, and of
/// as few triangles as face_merge.h says. Bent faces become as few chords as stay within some chord_height()
/// (csg_tets.h, with `cell` in m) of them; the chords' ends lie on the surface. Where that height is no
/// small part of a wall or a gap, both of its sides have the same chords. Only for trees that csg_can_cut
/// accepts. Fails as make_csg_tets does, on too many triangles, and where so many surfaces pass one
/// place that cutting would take minutes or gigabytes.
base::Result<TriangleMesh> cut_csg(const CsgTree& tree, double cell, std::size_t max_triangles,
                                   const ContourProgress& go_on);

/// Are all of its primitives in closed form, and its meshes not too large?
bool csg_can_cut(const CsgProgram& program);

/// Has it flat faces, and not too many, so that it is better cut than sampled?
bool has_flat_faces(const CsgProgram& program);

/// Is there a primitive half of whose share in the surface, or more, has less than `thickness` m of solid
/// behind it, or of free space in front of it, as in a slit? Judged at random places, the same each time.
bool is_thin(const CsgProgram& program, double thickness);

}  // namespace icome::geometry
