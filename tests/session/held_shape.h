#pragma once
#include <atomic>
#include <memory>

#include "geometry/mesh/geodesic_sphere.h"
#include "world/shape/mesh_geometry.h"

namespace icome::session {

/// A shape that whoever wants to feel or see it works on until the test lets them: stands for one that takes
/// long, and then is the mesh that it was made of.
class HeldShape final : public world::Geometry {
 public:
  explicit HeldShape(geometry::TriangleMesh mesh)
      : mesh_(std::make_shared<const world::MeshGeometry>(std::move(mesh))) {}

  /// How many are at work.
  int at_work() const { return at_work_.load(); }
  void let_go() {
    held_.store(false);
    held_.notify_all();
  }

  std::string_view kind() const override { return "held"; }
  base::Bounds bounds() const override { return mesh_->bounds(); }
  std::uint64_t hash() const override { return mesh_->hash(); }
  std::size_t bytes() const override { return mesh_->bytes(); }
  base::Result<std::shared_ptr<const world::MeshGeometry>> triangles(double) const override {
    ++at_work_;
    held_.wait(true);
    return mesh_;
  }
  base::Result<std::string> write() const override { return base::fail("a shape of a test"); }

 private:
  std::shared_ptr<const world::MeshGeometry> mesh_;
  mutable std::atomic<int> at_work_ = 0;
  std::atomic<bool> held_ = true;
};

}  // namespace icome::session
