#include "world/shape/picture_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace icome::world {
namespace {

using Places = std::array<Vector2, 3>;
using Corners = std::array<Vector3, 3>;

/// Upright on each side as seen from outside; on top its upper edge is at the back, below at the front.
Vector2 place_on_box(const Vector3& p, const Vector3& half, const Vector3& normal) {
  const Vector3 q = 0.5 * p.cwiseQuotient(half) + Vector3::Constant(0.5);  // 0 ... 1
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const bool positive = normal[axis] > 0.0;
  if (axis == 0) return {positive ? 1.0 - q.z() : q.z(), q.y()};
  if (axis == 1) return {q.x(), positive ? 1.0 - q.z() : q.z()};
  return {positive ? q.x() : 1.0 - q.x(), q.y()};
}

/// Angle round the axis in turns, 0 ... 1, counter-clockwise as seen from above, from the back.
double round_the_axis(const Vector3& p) {
  const double share = std::atan2(-p.x(), -p.z()) / (2.0 * std::numbers::pi);
  return share < 0.0 ? share + 1.0 : share;
}

/// A triangle across the back goes on beyond 1; a corner at a pole lies between its neighbours.
Places wrapped_round(const Corners& corners, const std::array<double, 3>& heights) {
  Places places;
  const double size = corners[0].norm() + corners[1].norm() + corners[2].norm();
  std::array<bool, 3> polar = {};
  double least = 1.0, most = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    places[k] = {round_the_axis(corners[k]), heights[k]};
    polar[k] = std::hypot(corners[k].x(), corners[k].z()) < 1e-9 * size;
    if (polar[k]) continue;
    least = std::min(least, places[k].x());
    most = std::max(most, places[k].x());
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (!polar[k] && most - least > 0.5 && places[k].x() < 0.5) places[k].x() += 1.0;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (polar[k]) places[k].x() = 0.5 * (places[(k + 1) % 3].x() + places[(k + 2) % 3].x());
  }
  return places;
}

/// Upright where the top is tilted to the front, or the bottom to the back.
Places on_cap(const Corners& corners, double radius, bool top) {
  Places places;
  for (std::size_t k = 0; k < 3; ++k) {
    const double up = top ? -corners[k].z() : corners[k].z();
    places[k] = {0.5 + 0.5 * corners[k].x() / radius, 0.5 + 0.5 * up / radius};
  }
  return places;
}

Places round_bar(const Corners& corners, const Vector3& normal, double height, double bottom, double top) {
  const bool flat = std::abs(normal.y()) > 1.0 - 1e-9;
  if (flat && normal.y() > 0.0 && top > 0.0) return on_cap(corners, top, true);
  if (flat && normal.y() < 0.0 && bottom > 0.0) return on_cap(corners, bottom, false);
  std::array<double, 3> heights = {};
  for (std::size_t k = 0; k < 3; ++k) heights[k] = 0.5 + corners[k].y() / height;
  return wrapped_round(corners, heights);
}

/// Lays the picture on a triangle of each kind of primitive, y up.
struct PlaceTriangle {
  const Corners& corners;
  Vector3 normal;

  Places operator()(const geometry::Cylinder& it) const {
    return round_bar(corners, normal, it.height, it.radius, it.radius);
  }
  Places operator()(const geometry::Cone& it) const {
    return round_bar(corners, normal, it.height, it.bottom_radius, it.top_radius);
  }
  Places operator()(const geometry::Sphere& it) const {
    std::array<double, 3> heights = {};
    for (std::size_t k = 0; k < 3; ++k)
      heights[k] = 0.5 + std::asin(std::clamp(corners[k].y() / it.radius, -1.0, 1.0)) / std::numbers::pi;
    return wrapped_round(corners, heights);
  }
  template <typename Other>
  Places operator()(const Other&) const {
    return {};
  }
};

}  // namespace

std::vector<std::array<Vector2, 3>> picture_places(const PrimitiveGeometry& shape,
                                                   const geometry::TriangleMesh& mesh) {
  const auto* box = std::get_if<geometry::Box>(&shape.primitive);
  const bool known = box || std::holds_alternative<geometry::Sphere>(shape.primitive) ||
                     std::holds_alternative<geometry::Cylinder>(shape.primitive) ||
                     std::holds_alternative<geometry::Cone>(shape.primitive);
  std::vector<Places> places;
  if (!known) return places;
  // VRML stands primitives along y, geometry along z. A sphere has no axis: its poles are along y.
  base::Matrix3 upright_from_primitive;
  upright_from_primitive << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  base::Matrix3 turn = upright_from_primitive * shape.shape_from_primitive().transpose();
  if (std::holds_alternative<geometry::Sphere>(shape.primitive)) turn.setIdentity();
  places.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Corners corners;
    for (int k = 0; k < 3; ++k) corners[std::size_t(k)] = box ? mesh.corner(t, k) : turn * mesh.corner(t, k);
    const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
    if (box) {
      const Vector3 half = (shape.shape_from_primitive() * box->half).cwiseAbs();
      places.push_back({place_on_box(corners[0], half, normal), place_on_box(corners[1], half, normal),
                        place_on_box(corners[2], half, normal)});
    } else {
      places.push_back(std::visit(PlaceTriangle{corners, normal}, shape.primitive));
    }
  }
  return places;
}

}  // namespace icome::world
