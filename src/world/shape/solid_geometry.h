#pragma once
#include <memory>
#include <optional>
#include <string>

#include "base/result.h"
#include "geometry/csg/csg_tree.h"
#include "geometry/implicit/implicit_surface.h"
#include "world/shape/geometry.h"

namespace icome::world {

/// The axis that a primitive stands along; its positive end is the top.
enum class Axis : std::uint8_t { Z, Y };

/// A box, sphere, cylinder, cone, torus, capsule or half-space by its sizes. Along z it is as defined
/// by geometry::Primitive, along y that turned about x so that its z becomes y, as VRML 2.0 stands
/// cylinders and cones.
struct PrimitiveGeometry final : public Geometry {
  explicit PrimitiveGeometry(const geometry::Primitive& shape, Axis stands_along = Axis::Z)
      : primitive(shape), axis(stands_along) {}

  geometry::Primitive primitive;
  Axis axis;

  /// The turn from the primitive's own frame to the shape's.
  base::Matrix3 shape_from_primitive() const;

  /// Is it the same solid, to the last bit?
  bool same(const PrimitiveGeometry& other) const {
    return primitive == other.primitive && axis == other.axis;
  }

  std::string_view kind() const override { return "primitive"; }
  Kind which() const override { return Kind::Primitive; }
  Bounds bounds() const override;
  std::uint64_t hash() const override;
  std::size_t bytes() const override { return sizeof(*this); }
  base::Result<std::shared_ptr<const MeshGeometry>> triangles(double tolerance) const override;
  base::Result<std::string> write() const override;
};

/// The triangles of a solid as far as they could be made, and a place that is missing there (m), if any.
struct SolidTriangles {
  std::shared_ptr<const MeshGeometry> mesh;  // never null
  std::optional<Vector3> lost;
};

/// A solid under union, intersection and difference.
struct CsgGeometry final : public Geometry {
  explicit CsgGeometry(geometry::CsgTree solid) : tree(std::move(solid)) {}

  geometry::CsgTree tree;

  std::string_view kind() const override { return "csg"; }
  Kind which() const override { return Kind::Csg; }
  Bounds bounds() const override { return geometry::bounds(tree); }
  /// Custom primitives are hashed by name and box, operands that are meshes by their vertices.
  std::uint64_t hash() const override;
  std::size_t bytes() const override;
  base::Result<SolidTriangles> surface(double tolerance) const;
  /// Fails also where a part of the solid would be lost.
  base::Result<std::shared_ptr<const MeshGeometry>> triangles(double tolerance) const override;
  base::Result<std::string> write() const override;
};

/// The solid where a formula in x, y, z and t is negative, within a box.
class ImplicitGeometry final : public Geometry {
 public:
  /// Fails as geometry::ImplicitSurface::create does.
  static base::Result<std::shared_ptr<const ImplicitGeometry>> create(const std::string& formula,
                                                                      const Bounds& box);

  const std::string& formula() const { return formula_; }
  const std::shared_ptr<const geometry::ImplicitSurface>& surface() const { return surface_; }
  /// The triangles at rest, for views: with smaller cells where parts are lost, as far as that goes.
  base::Result<SolidTriangles> triangles_so_far(double tolerance) const;
  /// The triangles at a time (s), for a surface that changes; see Geometry::triangles.
  base::Result<std::shared_ptr<const MeshGeometry>> triangles_at(double time, double tolerance) const;

  std::string_view kind() const override { return "implicit"; }
  Kind which() const override { return Kind::Implicit; }
  Bounds bounds() const override { return surface_->bounds(); }
  std::uint64_t hash() const override;
  std::size_t bytes() const override { return sizeof(*this) + formula_.capacity() + surface_->bytes(); }
  /// Fails also where a part of the solid would be lost.
  base::Result<std::shared_ptr<const MeshGeometry>> triangles(double tolerance) const override;
  base::Result<std::string> write() const override;

 private:
  ImplicitGeometry(std::string formula, std::shared_ptr<const geometry::ImplicitSurface> surface)
      : formula_(std::move(formula)), surface_(std::move(surface)) {}

  std::string formula_;
  std::shared_ptr<const geometry::ImplicitSurface> surface_;
};

}  // namespace icome::world
