#include "world/shape/primitive_normals.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace icome::world {
namespace {

/// The normal at a place of a triangle, both in the primitive's own frame. Where a place has no normal of its
/// own, that of the triangle's middle is used.
struct NormalAt {
  const Vector3& place;
  const Vector3& middle;
  const Vector3& facing;  // of the triangle

  Vector3 operator()(const geometry::Plane&) const { return facing; }
  Vector3 operator()(const geometry::Box&) const { return facing; }
  Vector3 operator()(const geometry::Sphere&) const { return place; }
  Vector3 operator()(const geometry::Cylinder&) const { return side(0.0); }
  Vector3 operator()(const geometry::Cone& it) const {
    return side((it.bottom_radius - it.top_radius) / it.height);
  }
  Vector3 operator()(const geometry::Torus& it) const {
    return place - it.major_radius * off_axis(place).stableNormalized();
  }
  Vector3 operator()(const geometry::Capsule& it) const {
    const double half = 0.5 * it.height;
    return place - Vector3(0.0, 0.0, std::clamp(place.z(), -half, half));
  }

 private:
  static Vector3 off_axis(const Vector3& at) { return {at.x(), at.y(), 0.0}; }

  /// For a body round an axis, flat at top and bottom; `slope`: its narrowing per height.
  Vector3 side(double slope) const {
    const bool is_cap = off_axis(facing).norm() < 1e-9;
    if (is_cap) return facing;
    const bool is_tip = off_axis(place).norm() < 1e-9 * off_axis(middle).norm();
    return off_axis(is_tip ? middle : place).stableNormalized() + slope * Vector3::UnitZ();
  }
};

}  // namespace

std::vector<std::array<Vector3, 3>> primitive_normals(const PrimitiveGeometry& shape,
                                                      const geometry::TriangleMesh& mesh) {
  const base::Matrix3 shape_from_own = shape.shape_from_primitive();
  std::vector<std::array<Vector3, 3>> normals;
  normals.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Vector3, 3> corners;
    for (int k = 0; k < 3; ++k) corners[std::size_t(k)] = shape_from_own.transpose() * mesh.corner(t, k);
    const Vector3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const Vector3 facing = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
    auto& row = normals.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 normal = std::visit(NormalAt{corners[k], middle, facing}, shape.primitive);
      row[k] = shape_from_own * normal.stableNormalized();
    }
  }
  return normals;
}

}  // namespace icome::world
