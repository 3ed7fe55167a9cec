#pragma once
#include <cstddef>
#include <memory>
#include <optional>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::benchmarks {

using base::Vector3;
using geometry::TriangleMesh;

/// A mesh in Embree 3, with the watertight (robust) traversal: the packaged peer for nearest and segment
/// queries, and the independent basis of the judge. Single precision inside. Keeps a reference to the mesh.
class EmbreeMesh {
 public:
  explicit EmbreeMesh(const TriangleMesh& mesh);
  ~EmbreeMesh();
  EmbreeMesh(const EmbreeMesh&) = delete;
  EmbreeMesh& operator=(const EmbreeMesh&) = delete;

  /// The point of the mesh nearest to `point`, m.
  Vector3 nearest(const Vector3& point) const;

  /// The first hit of the segment from `a` to `b`: 0 at `a`, 1 at `b`; nothing: it misses the mesh.
  std::optional<double> first_hit(const Vector3& a, const Vector3& b) const;

  double build_seconds() const;
  /// Memory that Embree says it holds, bytes; includes its copy of the mesh in single precision.
  std::size_t bytes() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace icome::benchmarks
