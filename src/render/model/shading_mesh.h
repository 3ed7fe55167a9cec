#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vector.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::render {

/// A mesh as a graphics card takes it. Owns its arrays. Positions are single precision in a frame of
/// their own, within about -1 ... 1, so that a model far from its origin or of any size keeps its digits.
struct ShadingMesh {
  struct Vertex {
    Eigen::Vector3f position;  ///< (mesh position - centre) / radius
    Eigen::Vector3f normal;    ///< unit
  };
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;   ///< three a triangle
  base::Vector3 centre{0.0, 0.0, 0.0};  ///< mesh frame, metres
  double radius = 1.0;                  ///< metres, > 0

  std::size_t triangle_count() const { return indices.size() / 3; }
};

/// Splits vertices where the surface creases: a corner's normal averages the triangles round its vertex
/// that bend less than `crease_angle` (rad; 0 is flat, pi is smooth) from its own, weighted by their
/// angle there (Thuermer and Wuethrich 1998). Triangles without area or with non-finite corners or
/// indices out of range are left out.
ShadingMesh make_shading_mesh(const geometry::TriangleMesh& mesh, double crease_angle);

/// Gives the vertices in another frame, such as one that several meshes share.
void change_frame(ShadingMesh& mesh, const base::Vector3& centre, double radius);

/// The normals that make_shading_mesh would give to each corner of each triangle; zero for those that it
/// leaves out.
std::vector<std::array<Eigen::Vector3f, 3>> crease_normals(const geometry::TriangleMesh& mesh,
                                                           double crease_angle);

/// A coarser mesh for shadows and far views: vertices that share a cell of a grid with that edge (in the
/// buffers' frame, where the mesh spans about -1 ... 1; >= 1/512) become one at their mean, and triangles
/// that collapse vanish (Rossignac and Borrel 1993).
ShadingMesh clustered(const ShadingMesh& mesh, double cell);

}  // namespace icome::render
