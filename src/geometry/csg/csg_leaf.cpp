#include "geometry/csg/csg_leaf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/decompositions.h"

namespace icome::geometry {
namespace {

// ---- The extent of a shape along a direction ------------------------------------------------------
// The box around an affine image has along each axis of the tree the extent given by the shape's support
// function for the row of the matrix that belongs to the axis.

struct SupportRange {
  double low, high;
};

SupportRange both_ways(double half) { return {-half, half}; }

/// The least and the largest sum of row * x over a box, which may be infinite along some axes.
SupportRange support_along(const Bounds& box, const Vector3& row) {
  SupportRange sum{0.0, 0.0};
  for (int k = 0; k < 3; ++k) {
    if (row[k] == 0.0) continue;  // not zero times infinity
    const double a = row[k] * box.min()[k];
    const double b = row[k] * box.max()[k];
    sum.low += std::min(a, b);
    sum.high += std::max(a, b);
  }
  return sum;
}

SupportRange support_along(const Plane& plane, const Vector3& row) {
  return support_along(bounds(Primitive(plane)), row);
}

SupportRange support_along(const Box& box, const Vector3& row) {
  return both_ways(row.cwiseAbs().dot(box.half));
}

SupportRange support_along(const Sphere& sphere, const Vector3& row) {
  return both_ways(sphere.radius * row.stableNorm());
}

/// The reach along `row` of discs across the z axis, per metre of their radius.
double disc_reach(const Vector3& row) { return std::hypot(row.x(), row.y()); }

SupportRange support_along(const Cone& cone, const Vector3& row) {
  const double bottom = disc_reach(row) * cone.bottom_radius;
  const double top = disc_reach(row) * cone.top_radius;
  const double rise = row.z() * cone.height / 2;
  return {std::min(-bottom - rise, -top + rise), std::max(bottom - rise, top + rise)};
}

SupportRange support_along(const Cylinder& cylinder, const Vector3& row) {
  return both_ways(disc_reach(row) * cylinder.radius + std::abs(row.z()) * cylinder.height / 2);
}

SupportRange support_along(const Torus& torus, const Vector3& row) {
  return both_ways(disc_reach(row) * torus.major_radius + row.stableNorm() * torus.minor_radius);
}

SupportRange support_along(const Capsule& capsule, const Vector3& row) {
  return both_ways(row.stableNorm() * capsule.radius + std::abs(row.z()) * capsule.height / 2);
}

template <typename Extent>
Bounds placed_bounds(const Extent& extent, const Affine3& placing) {
  Bounds box;
  for (int axis = 0; axis < 3; ++axis) {
    const SupportRange along = support_along(extent, Vector3(placing.linear().row(axis)));
    box.min()[axis] = placing.translation()[axis] + along.low;
    box.max()[axis] = placing.translation()[axis] + along.high;
  }
  return box;
}

// ---- The answers of each kind of shape ------------------------------------------------------------

struct BoundsOfShape {
  const Affine3& placing;

  Bounds operator()(const Primitive& primitive) const {
    return std::visit([this](const auto& shape) { return placed_bounds(shape, placing); }, primitive);
  }
  Bounds operator()(const std::shared_ptr<const MeshSolid>& solid) const {
    Bounds box;
    for (const Vector3& position : solid->mesh.positions) box.extend(placing * position);
    return box;
  }
  Bounds operator()(const std::shared_ptr<const CsgPrimitive>& custom) const {
    const Bounds box = custom->bounds();
    return box.isEmpty() ? Bounds() : placed_bounds(box, placing);
  }
};

/// The rounding error of a point of the mesh: a few units in the last place of the coordinates.
double mesh_rounding(const MeshSolid& solid, const Vector3& point) {
  const Bounds& box = solid.tree.bounds();
  const double size = std::max(
      {box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff(), point.cwiseAbs().maxCoeff()});
  return 8 * std::numeric_limits<double>::epsilon() * size;
}

/// Rays decide for points away from the surface; on it they are unreliable, and points count as inside.
bool inside_mesh(const MeshSolid& solid, const Vector3& point) {
  const double slack = mesh_rounding(solid, point);
  if (!(solid.tree.bounds().squaredExteriorDistance(point) <= slack * slack)) return false;
  return solid.tree.encloses(point) || solid.tree.nearest(point, slack).has_value();
}

/// The normal on a face is the face's, on edges and vertices along the line to the point, as of primitives.
SurfacePoint nearest_of_mesh(const MeshSolid& solid, const Vector3& point) {
  const std::optional<MeshHit> hit = solid.tree.nearest(point);
  if (!hit) return {point, Vector3::UnitZ()};  // a point so far away that its square overflows
  const Vector3& a = solid.mesh.corner(hit->triangle, 0);
  const Vector3 face = (solid.mesh.corner(hit->triangle, 1) - a)
                           .cross(solid.mesh.corner(hit->triangle, 2) - a)
                           .stableNormalized();
  const Vector3 away = point - hit->point;
  const Vector3 sideways = away - away.dot(face) * face;
  const bool on_face = sideways.norm() <= mesh_rounding(solid, point);
  if (on_face && !face.isZero(0.0)) return {hit->point, face};
  if (away.isZero(0.0)) return {hit->point, Vector3::UnitZ()};  // on a triangle without area
  const Vector3 direction = away.stableNormalized();
  return {hit->point, solid.tree.encloses(point) ? Vector3(-direction) : direction};
}

struct FromInside {
  const Vector3& point;

  SurfacePoint operator()(const Primitive& shape) const { return scp_from_inside(shape, point); }
  SurfacePoint operator()(const std::shared_ptr<const MeshSolid>& solid) const {
    return nearest_of_mesh(*solid, point);
  }
  SurfacePoint operator()(const std::shared_ptr<const CsgPrimitive>& custom) const {
    return custom->scp_from_inside(point);
  }
};

struct FromOutside {
  const Vector3& point;

  SurfacePoint operator()(const Primitive& shape) const { return scp_from_outside(shape, point); }
  SurfacePoint operator()(const std::shared_ptr<const MeshSolid>& solid) const {
    return nearest_of_mesh(*solid, point);
  }
  SurfacePoint operator()(const std::shared_ptr<const CsgPrimitive>& custom) const {
    return custom->scp_from_outside(point);
  }
};

struct MeshOfShape {
  double tolerance;

  TriangleMesh operator()(const Primitive& shape) const { return geometry::tessellate(shape, tolerance); }
  TriangleMesh operator()(const std::shared_ptr<const MeshSolid>& solid) const { return solid->mesh; }
  TriangleMesh operator()(const std::shared_ptr<const CsgPrimitive>& custom) const {
    return custom->tessellate(tolerance);
  }
};

struct NameOfShape {
  std::string operator()(const Primitive& shape) const { return geometry::name(shape); }
  std::string operator()(const std::shared_ptr<const MeshSolid>& solid) const {
    return fmt::format("mesh of {} triangles", solid->mesh.triangles.size());
  }
  std::string operator()(const std::shared_ptr<const CsgPrimitive>& custom) const { return custom->name(); }
};

/// Normals transform by the inverse transpose, which keeps them pointing out under a mirror too.
SurfacePoint placed_surface(const SurfacePoint& in_shape, const Affine3& placing, const Affine3& inverse) {
  return {placing * in_shape.point, (inverse.linear().transpose() * in_shape.normal).stableNormalized()};
}

}  // namespace

bool shape_encloses(const CsgShape& shape, const Vector3& point) {
  if (const auto* primitive = std::get_if<Primitive>(&shape)) return geometry::inside(*primitive, point);
  if (const auto* solid = std::get_if<std::shared_ptr<const MeshSolid>>(&shape)) {
    return inside_mesh(**solid, point);
  }
  return std::get<std::shared_ptr<const CsgPrimitive>>(shape)->inside(point);
}

Bounds shape_bounds(const CsgShape& shape, const Affine3& placing) {
  return std::visit(BoundsOfShape{placing}, shape);
}

std::string shape_name(const CsgShape& shape) { return std::visit(NameOfShape{}, shape); }

Affine3 unplacing(const Affine3& placing) {
  // Brought near size 1 by a power of two, which rounds nothing: determinants of tiny scales underflow.
  const double largest = placing.linear().cwiseAbs().maxCoeff();
  const double scale = std::ldexp(1.0, -std::ilogb(largest));
  Affine3 result;
  result.linear() = (scale * placing.linear()).inverse() * scale;
  result.translation() = -(result.linear() * placing.translation());
  result.makeAffine();
  return result;
}

CsgLeaf::CsgLeaf(CsgShape shape, const Affine3& tree_from_shape)
    : shape_(std::move(shape)),
      tree_from_shape_(tree_from_shape),
      shape_from_tree_(unplacing(tree_from_shape)),
      bounds_(shape_bounds(shape_, tree_from_shape)) {
  assert(shape_from_tree_.matrix().allFinite());
}

bool CsgLeaf::inside(const Vector3& point) const { return shape_encloses(shape_, shape_from_tree_ * point); }

SurfacePoint CsgLeaf::scp_from_inside(const Vector3& point) const {
  const Vector3 in_shape = shape_from_tree_ * point;
  return placed_surface(std::visit(FromInside{in_shape}, shape_), tree_from_shape_, shape_from_tree_);
}

SurfacePoint CsgLeaf::scp_from_outside(const Vector3& point) const {
  const Vector3 in_shape = shape_from_tree_ * point;
  return placed_surface(std::visit(FromOutside{in_shape}, shape_), tree_from_shape_, shape_from_tree_);
}

TriangleMesh CsgLeaf::tessellate(double tolerance) const {
  assert(tolerance > 0.0);
  const double stretch = base::singular_values(tree_from_shape_.linear()).values[0];
  TriangleMesh mesh = std::visit(MeshOfShape{tolerance / stretch}, shape_);
  for (Vector3& position : mesh.positions) position = tree_from_shape_ * position;
  // The matrix is first brought to size one: the determinant of a scale by 1e-120 underflows.
  if ((tree_from_shape_.linear() / stretch).determinant() < 0.0) {
    for (TriangleMesh::Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

std::string CsgLeaf::name() const { return shape_name(shape_); }

}  // namespace icome::geometry
