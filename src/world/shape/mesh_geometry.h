#pragma once
#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "geometry/loop/loop_surface.h"
#include "world/shape/fixture.h"
#include "world/shape/geometry.h"
#include "world/shape/kept_bounds.h"

namespace icome::world {

using base::Vector2;

/// The longest recipe of a shape that can be written, bytes.
inline constexpr std::size_t kMostRecipeBytes = std::size_t{1} << 20;

/// A triangle mesh. Texture coordinates belong to corners of triangles, as one vertex may lie in several
/// textures (2.4.1); so do normals, which say where edges look sharp, and colours.
struct MeshGeometry final : public Geometry, public std::enable_shared_from_this<MeshGeometry> {
  explicit MeshGeometry(geometry::TriangleMesh triangles) : mesh(std::move(triangles)) {}

  geometry::TriangleMesh mesh;
  std::vector<std::array<Vector2, 3>> texture_coordinates;  // of every triangle, or none
  std::vector<std::array<Vector3, 3>> normals;              // unit, of every triangle, or none: smooth
  std::vector<std::array<Colour, 3>> colours;  // of every triangle, or none: the material's diffuse one
  std::string recipe;  // how it was made, as JSON text of named parameters; empty: by hand

  std::string_view kind() const override { return "mesh"; }
  Kind which() const override { return Kind::Mesh; }
  Bounds bounds() const override { return bounds_.of(mesh); }
  std::uint64_t hash() const override;
  std::size_t bytes() const override;
  base::Result<std::shared_ptr<const MeshGeometry>> triangles(double tolerance) const override;
  base::Result<std::string> write() const override;
  /// To be called after the positions have been changed in place.
  void forget_bounds() { bounds_.forget(); }

 private:
  KeptBounds bounds_;
};

/// The control mesh of a Loop subdivision surface.
struct LoopGeometry final : public Geometry {
  explicit LoopGeometry(geometry::ControlMesh control_mesh) : control(std::move(control_mesh)) {}

  geometry::ControlMesh control;

  std::string_view kind() const override { return "loop"; }
  Kind which() const override { return Kind::Loop; }
  /// Bounds of the control mesh, within whose convex hull the surface lies.
  Bounds bounds() const override { return bounds_.of(control.mesh); }
  std::uint64_t hash() const override;
  std::size_t bytes() const override;
  base::Result<std::shared_ptr<const MeshGeometry>> triangles(double tolerance) const override;
  base::Result<std::string> write() const override;
  /// To be called after the positions have been changed in place.
  void forget_bounds() { bounds_.forget(); }

 private:
  KeptBounds bounds_;
};

/// The recipe of a mesh; empty for shapes of other kinds. Valid until the shape is deleted or changed.
std::string_view recipe_of(const Geometry& shape);

/// The shape with some vertices moved, and their former positions. Fails for shapes without vertices, for
/// vertices that do not exist or are named twice, and for positions that are not finite. Corner normals
/// stay: bending a shape should replace them with it. A recipe is dropped, as it would make another shape.
struct MovedVertices {
  GeometryPointer shape;
  std::vector<Vector3> before;  // m, in the order asked for
};
base::Result<MovedVertices> move_vertices(const Geometry& shape, std::span<const std::uint32_t> vertices,
                                          std::span<const Vector3> positions);

/// Moves the vertices in place, while nobody else reads the shape: returns their former positions.
base::Result<std::vector<Vector3>> move_vertices_of(Geometry& shape, std::span<const std::uint32_t> vertices,
                                                    std::span<const Vector3> positions);

}  // namespace icome::world
