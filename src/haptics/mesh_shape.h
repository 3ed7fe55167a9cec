#pragma once
#include <memory>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "geometry/triangle_tree.h"
#include "haptics/shape.h"

namespace icome::haptics {

/// A triangle mesh that can be touched: its faces, and with a sphere tip its edges and corners too.
/// Shares the mesh, owns the tree over it.
class MeshShape final : public Shape {
 public:
  enum class Shading : std::uint8_t { Flat, Interpolated };

  /// `closed` says that the mesh encloses a solid, outward normals out: only then has it an inside.
  MeshShape(std::shared_ptr<const geometry::TriangleMesh> mesh, bool closed, Shading shading = Shading::Flat);

  Bounds bounds() const override { return tree_.bounds(); }
  void gather(const GatherRequest& request, ElementSink& sink) const override;
  void expand(std::uint32_t piece, double tip, TouchableSides sides, PieceElements& elements) const override;
  std::optional<geometry::SurfacePoint> way_out(const Vector3& position) const override;
  Vector3 shading_normal(std::uint32_t feature, const Vector3& position,
                         const Vector3& face_normal) const override;
  std::size_t bytes() const override;

  const geometry::TriangleMesh& mesh() const { return *mesh_; }
  const geometry::TriangleTree& tree() const { return tree_; }

 private:
  void measure_spread();
  Bounds tip_bounds(std::uint32_t slot, const GatherRequest& request) const;

  std::shared_ptr<const geometry::TriangleMesh> mesh_;
  geometry::TriangleTree tree_;
  bool closed_;
  std::vector<std::uint8_t> spread_;  // by slot: how far neighbours' normals differ; empty when open
  std::vector<Vector3> normals_;  // by vertex; empty when flat
};

}  // namespace icome::haptics
