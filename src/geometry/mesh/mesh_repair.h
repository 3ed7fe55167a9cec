#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "geometry/mesh/mesh_topology.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// The changes that repair() made to a mesh, and the resulting surface.
struct RepairReport {
  std::size_t non_finite_vertices = 0;   ///< vertices with a NaN or infinite coordinate, removed
  std::size_t non_finite_faces = 0;      ///< triangles that used them, dropped
  std::size_t welded_vertices = 0;       ///< vertices at exactly another's position, merged into it
  std::size_t crack_vertices = 0;        ///< boundary vertices almost at another's position, merged into it
  std::size_t degenerate_faces = 0;      ///< triangles without area, dropped
  std::size_t flipped_edges = 0;         ///< flat triangles saved by turning the edge they lie on
  std::size_t duplicate_faces = 0;       ///< repeats of a triangle, same front, dropped
  std::size_t unused_vertices = 0;       ///< finite vertices of no triangle, removed
  std::size_t rewound_faces = 0;         ///< triangles turned to agree with their neighbours
  std::size_t turned_parts = 0;          ///< inside-out parts turned whole
  std::size_t unorientable_patches = 0;  ///< one-sided parts, such as a Moebius strip, left as they were
  MeshReport surface;                    ///< of the repaired mesh

  /// Did repair() change anything but the vertex numbering?
  bool changed() const;
  /// The changes and the remaining faults, one sentence each, for people: "12 degenerate faces dropped",
  /// "the surface is open: 96 boundary edges". Empty for an unchanged, sound closed surface.
  std::vector<std::string> sentences() const;
};

/// Makes a mesh fit to be touched, in O(n) for n triangles. In this order: drops triangles with a
/// non-finite vertex; welds vertices at exactly equal positions, and boundary vertices that only
/// rounding to single precision keeps apart; saves or drops triangles without area
/// (height below 1e-12 of the longest edge: a ratio, so metres and millimetres are treated the same);
/// drops repeated triangles (back-to-back pairs are kept: they are the two sides of a sheet); removes
/// unused vertices; makes windings agree over edges of two triangles, the majority keeping its winding;
/// turns parts that are inside-out. Holes and non-manifold edges are kept and reported.
///
/// A part is inside-out when its volume is negative and it does not lie inside another part, where it
/// may be the wall of a cavity; the walls of cavities in a part that is turned are turned with it. Open
/// parts count too when their holes are less than a tenth of them.
///
/// Precondition: indices in range, coordinates below 1e70. The mesh may come out empty.
RepairReport repair(TriangleMesh& mesh);

/// Is there a triangle without area, which repair() would save or drop? Indices must be in range.
bool has_flat_triangle(const TriangleMesh& mesh);

/// Removes vertices that no triangle uses, keeping the order of the others. Indices must be in range.
void drop_unused_vertices(TriangleMesh& mesh);

}  // namespace icome::geometry
