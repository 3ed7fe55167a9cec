#pragma once
#include <mutex>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::world {

/// The bounds of a mesh, computed when first asked for, as displaying or moving large shapes asks many
/// times. Any thread may ask. A copy, which is made to be changed, starts without.
class KeptBounds {
 public:
  KeptBounds() = default;
  KeptBounds(const KeptBounds& /*other*/) {}
  KeptBounds& operator=(const KeptBounds&) = delete;

  const base::Bounds& of(const geometry::TriangleMesh& mesh) const {
    const std::lock_guard hold(lock_);
    if (!known_) bounds_ = geometry::bounds(mesh);
    known_ = true;
    return bounds_;
  }
  /// To be called after the mesh has changed. Nobody else may be reading it.
  void forget() { known_ = false; }

 private:
  mutable std::mutex lock_;
  mutable bool known_ = false;
  mutable base::Bounds bounds_;
};

}  // namespace icome::world
