#pragma once
#include <optional>

#include "geometry/csg/csg_program.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// A place (m, tree's frame) at which the mesh is not the solid's surface, if random trials, the same each
/// time, find one: a place of the surface that is farther than a cell from the mesh, or the middle of a wall
/// or a gap of less than two cells that the mesh has on its wrong side, as where two bodies that nearly touch
/// are joined. Gaps and walls are looked for where two primitives come nearest to each other, and straight
/// from places of the surface. For a primitive with little share in the surface, many places are discarded
/// before one counts, as for two large spheres whose intersection is a thin lens. `shift` (m): both sides of
/// a wall or gap may be off by as much together, as where they have the same chords.
std::optional<Vector3> place_that_mesh_lacks(const CsgProgram& program, const TriangleMesh& mesh, double cell,
                                             double shift);

}  // namespace icome::geometry
