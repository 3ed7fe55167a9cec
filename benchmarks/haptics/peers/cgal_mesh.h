#pragma once
#include <cstddef>
#include <memory>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::benchmarks {

/// A mesh in CGAL's AABB tree (Simple_cartesian<double>, with its accelerator for distances): the packaged
/// peer for nearest queries. Keeps its own copy of the triangles.
class CgalMesh {
 public:
  explicit CgalMesh(const geometry::TriangleMesh& mesh);
  ~CgalMesh();
  CgalMesh(const CgalMesh&) = delete;
  CgalMesh& operator=(const CgalMesh&) = delete;

  /// The point of the mesh nearest to `point`, m.
  base::Vector3 nearest(const base::Vector3& point) const;

  double build_seconds() const { return build_seconds_; }
  /// Memory that building took from the heap, bytes; includes the copy of the triangles.
  std::size_t bytes() const { return bytes_; }

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
  double build_seconds_ = 0.0;
  std::size_t bytes_ = 0;
};

}  // namespace icome::benchmarks
