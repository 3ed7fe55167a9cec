#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// The neighbour of a triangle over an edge where there is none.
inline constexpr std::uint32_t kNoTriangle = 0xffffffff;

/// For each triangle the triangles over its edges; edge i runs from corner i to corner i + 1.
using EdgeNeighbours = std::vector<std::array<std::uint32_t, 3>>;

/// The properties of a mesh as a surface, by its edges. Edges are distinguished by their vertex indices,
/// so weld first; a triangle that names a vertex twice has no edges.
struct MeshReport {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t boundary_edges = 0;      ///< edges of one triangle: rims and holes
  std::size_t non_manifold_edges = 0;  ///< edges of three triangles or more
  std::size_t inconsistent_edges = 0;  ///< edges whose two triangles run along them in the same direction
  std::size_t components = 0;          ///< parts connected over edges, however many triangles share one
  /// True when every edge has an even number of triangles, so that the surface divides inside from
  /// outside. False for a mesh without triangles.
  bool closed = false;
  /// True when windings exist that agree over every edge of two triangles (a Moebius strip has none).
  bool orientable = false;
};

/// Neighbours and report in one pass over the edges.
struct MeshTopology {
  EdgeNeighbours neighbours;
  MeshReport report;
};

/// The neighbours over every edge that exactly two triangles share; kNoTriangle elsewhere.
/// Indices must be in range. O(n) for meshes without extremely crowded vertices.
EdgeNeighbours edge_neighbours(const TriangleMesh& mesh);

/// The neighbours and the report. Indices must be in range.
MeshTopology analyse_topology(const TriangleMesh& mesh);

/// The connected part to which each triangle belongs, and the number of parts. Two triangles are
/// connected when a chain of `neighbours` leads from one to the other, so parts end at boundary and
/// non-manifold edges.
struct Patches {
  std::vector<std::uint32_t> patch_of_triangle;
  /// True for triangles whose winding must be turned so that their patch agrees with itself. Turning
  /// means as few triangles as possible: the majority keeps its winding.
  std::vector<bool> turn;
  std::vector<bool> orientable;  ///< one per patch; `turn` is false throughout a patch that is not
  std::size_t count() const { return orientable.size(); }
};

/// The patches of the mesh. `neighbours` must be those of `mesh`.
Patches find_patches(const TriangleMesh& mesh, const EdgeNeighbours& neighbours);

}  // namespace icome::geometry
