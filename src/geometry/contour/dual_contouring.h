#pragma once
#include <cstddef>
#include <functional>
#include <optional>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"
#include "geometry/primitive/primitive.h"

namespace icome::geometry {

/// A solid given by a few queries, for meshing. In its own frame, m. All are called from several threads
/// at once.
struct SampledSolid {
  /// Bounds of the solid; empty for an empty one. Parts that reach beyond are cut off.
  Bounds bounds;
  /// Is the point inside?
  std::function<bool(const Vector3&)> inside;
  /// The first crossing of the surface with the segment from `a`, which is inside, to `b`, which is not, and
  /// the outward normal there.
  std::function<SurfacePoint(const Vector3& a, const Vector3& b)> crossing;
  /// May there be surface in the box? If not, one point decides for the whole box. Not set: anywhere.
  std::function<bool(const Bounds& box)> may_cross = {};
};

struct ContourOptions {
  double cell = 0.0;  // m, edge of the grid's cells
  std::size_t max_triangles = 20'000'000;
  bool measures = true;                            // ContourMesh::error, which may take longer than the mesh
  std::function<bool(double part)> progress = {};  // called now and then by the calling thread; false stops
};

struct ContourMesh {
  TriangleMesh mesh;  // closed: every edge has two triangles that run along it in opposite directions
  /// m, measured: the largest distance from the mesh's vertices, edge midpoints and triangle centres to the
  /// surface. Searched along the mesh's normal there, both ways, up to two cells, and where it is not near
  /// in other directions too; so each is an upper bound of the point's true distance. Where nothing is found,
  /// the cell's diagonal counts. 0 where it is not to be measured. Parts of the surface that the mesh lacks
  /// (those thinner than a cell) are not measured.
  double error = 0.0;
  /// A place of the solid's surface that the mesh lacks, m, if one was found; only of CSG trees (csg_mesh.h).
  std::optional<Vector3> lost = std::nullopt;
};

/// A closed, watertight triangle mesh of the solid's surface that keeps its sharp edges and corners: dual
/// contouring (Ju et al., 2002) with one vertex for each sheet of the surface in a cell (Nielson 2004,
/// Schaefer et al., 2007), so that it is a manifold also where sheets touch. No triangle is degenerate.
/// Vertices lie on the surface, at its edges and corners where their cells hold some, curved ones included;
/// only where a ridge or tip pokes through the side of a cell without reaching a corner or edge of the grid
/// may it be cut off, by a fraction of a cell. The same solid gives the same bits, however many threads.
///
/// The grid is sampled a few layers at a time: memory follows the surface, time the volume (of the blocks
/// that may hold surface). Parts thinner than a cell may be lost. An empty solid gives an empty mesh.
/// Fails when it is interrupted, on a cell that is not > 0, on infinite bounds, and when it gets too large.
base::Result<ContourMesh> contour(const SampledSolid& solid, const ContourOptions& options);

}  // namespace icome::geometry
