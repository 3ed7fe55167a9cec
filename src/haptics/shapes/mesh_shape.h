#pragma once
#include <memory>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"
#include "geometry/tree/triangle_tree.h"
#include "haptics/shapes/mesh_features.h"
#include "haptics/shapes/shape.h"

namespace icome::haptics {

/// Settings of a mesh that is to be touched.
struct MeshShapeSettings {
  bool closed = false;               // it encloses a solid, outward normals out: only then has it an inside
  bool interpolate_normals = false;  // for force shading
  double tip_radius = 0.0;           // m; above 0 a sphere tip of any radius is served much faster
};

/// A triangle mesh that can be touched: its faces, and with a sphere tip its edges and corners too.
/// Shares the mesh, owns the tree over it.
class MeshShape final : public Shape {
 public:
  MeshShape(std::shared_ptr<const geometry::TriangleMesh> mesh, const MeshShapeSettings& settings);

  /// `other` with moved vertices: the mesh has the same triangles. Much faster than making a new shape.
  MeshShape(const MeshShape& other, std::shared_ptr<const geometry::TriangleMesh> mesh);

  Bounds bounds() const override { return tree_.bounds(); }
  void gather(const GatherRequest& request, ElementSink& sink) const override;
  void expand(std::uint32_t piece, double tip, TouchableSides sides, PieceElements& elements) const override;
  std::size_t sweep(const Vector3& start, const Vector3& step, double distance,
                    PieceVisitor& visitor) const override;
  std::optional<geometry::SurfacePoint> way_out(const Vector3& position, double /*time*/) const override;
  std::optional<geometry::SurfacePoint> nearest(const Vector3& position, double limit,
                                                TouchableSides sides) const override;
  std::optional<ShapeHit> cast(const Vector3& start, const Vector3& step, double /*time*/) const override;
  Vector3 shading_normal(std::uint32_t feature, const Vector3& position,
                         const Vector3& face_normal) const override;
  std::size_t bytes() const override;

  const geometry::TriangleMesh& mesh() const { return *mesh_; }
  const geometry::TriangleTree& tree() const { return tree_; }

 private:
  unsigned features(std::uint32_t slot, TouchableSides sides) const;
  void prepare();

  std::shared_ptr<const geometry::TriangleMesh> mesh_;
  geometry::TriangleTree tree_;
  MeshShapeSettings settings_;
  std::vector<MeshFeatures> features_;  // by slot; only for a sphere tip
  std::vector<Vector3> normals_;        // by vertex; empty unless interpolated
};

}  // namespace icome::haptics
