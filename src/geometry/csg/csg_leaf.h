#pragma once
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "geometry/mesh/triangle_mesh.h"
#include "geometry/primitive/primitive.h"
#include "geometry/tree/triangle_tree.h"

namespace icome::geometry {

using base::Affine3;

/// A closed mesh as an operand of a CSG tree, with a triangle tree for its queries. Immutable, shared.
struct MeshSolid {
  explicit MeshSolid(TriangleMesh closed_mesh) : mesh(std::move(closed_mesh)), tree(mesh) {}

  TriangleMesh mesh;  // closed, triangles facing out
  TriangleTree tree;
};

/// A primitive of your own: anything that answers the three queries of thesis section 5.5 can be an operand
/// of a CSG tree. Immutable, in its own frame (m).
class CsgPrimitive {
 public:
  virtual ~CsgPrimitive() = default;

  // As the functions of the same names in primitive.h. All real-time safe.
  virtual bool inside(const Vector3& point) const = 0;
  virtual SurfacePoint scp_from_inside(const Vector3& point) const = 0;
  virtual SurfacePoint scp_from_outside(const Vector3& point) const = 0;

  virtual Bounds bounds() const = 0;
  /// A closed mesh for pictures that deviates at most `tolerance` metres.
  virtual TriangleMesh tessellate(double tolerance) const = 0;
  virtual std::string name() const = 0;
};

/// The shape of a leaf. Pointers are never null.
using CsgShape =
    std::variant<Primitive, std::shared_ptr<const MeshSolid>, std::shared_ptr<const CsgPrimitive>>;

/// Is the point, in the shape's frame, in the shape or on its surface? Points of a mesh's surface count as
/// inside within a few units in the last place. Real-time safe.
bool shape_encloses(const CsgShape& shape, const Vector3& point);
/// The box around the shape when placed, as tight as CsgLeaf::bounds.
Bounds shape_bounds(const CsgShape& shape, const Affine3& placing);
/// The inverse, also of scales so small that their determinant underflows.
Affine3 unplacing(const Affine3& placing);
/// A readable name: "box:0.1x0.2x0.3", "mesh of 12 triangles", or that of a primitive of your own.
std::string shape_name(const CsgShape& shape);

/// A shape placed in a tree by an invertible affine transform, which may stretch, shear and mirror it.
class CsgLeaf {
 public:
  CsgLeaf(CsgShape shape, const Affine3& tree_from_shape);

  const CsgShape& shape() const { return shape_; }
  const Affine3& tree_from_shape() const { return tree_from_shape_; }
  const Affine3& shape_from_tree() const { return shape_from_tree_; }
  /// Bounds in the tree's frame, as tight as the shape allows (exact for every built-in primitive and a mesh,
  /// stretched, sheared or mirrored; for a primitive of your own, around the corners of its box).
  const Bounds& bounds() const { return bounds_; }

  // The three queries of thesis section 5.5 in the tree's frame (m). Exact under rotation, translation and
  // uniform scale; under other transforms the points are the images of the shape's own answers, on the
  // surface but not quite the nearest, and the normals are the surface's there. Real-time safe.
  bool inside(const Vector3& point) const;
  SurfacePoint scp_from_inside(const Vector3& point) const;
  SurfacePoint scp_from_outside(const Vector3& point) const;

  /// A closed mesh, facing out also when mirrored, at most `tolerance` metres off.
  TriangleMesh tessellate(double tolerance) const;
  std::string name() const;

 private:
  CsgShape shape_;
  Affine3 tree_from_shape_;
  Affine3 shape_from_tree_;
  Bounds bounds_;
};

}  // namespace icome::geometry
