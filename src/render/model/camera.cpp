#include "render/model/camera.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace icome::render {
namespace {

using base::Matrix3;
using base::Pose;
using base::Vector3;

/// Rows are the camera's axes in the world: x right, y up, z toward the eye.
Matrix3 camera_axes(const Vector3& toward_eye, const Vector3& up) {
  const Vector3 z = toward_eye.normalized();
  Vector3 x = up.cross(z);
  // Looking along `up` leaves the sideways direction free: any will do.
  if (x.squaredNorm() < 1e-12 * up.squaredNorm()) x = z.unitOrthogonal();
  x.normalize();
  Matrix3 axes;
  axes << x.transpose(), z.cross(x).transpose(), z.transpose();
  return axes;
}

/// The eye coordinate of the two planes with slopes +-tangent that just hold all points.
struct Wedge {
  double centre;    ///< across
  double distance;  ///< along +z
};

/// The wedge around points that reach so far across (`high`: max of x + t z; `low`: min of x - t z).
Wedge apex(double high, double low, double tangent) {
  return {0.5 * (high + low), 0.5 * (high - low) / tangent};
}

struct Reach {
  double right = -INFINITY, left = INFINITY, top = -INFINITY, bottom = INFINITY;
  double nearest = -INFINITY, farthest = INFINITY;  ///< z

  void add(const Vector3& p, double tangent_x, double tangent_y) {
    right = std::max(right, p.x() + tangent_x * p.z());
    left = std::min(left, p.x() - tangent_x * p.z());
    top = std::max(top, p.y() + tangent_y * p.z());
    bottom = std::min(bottom, p.y() - tangent_y * p.z());
    nearest = std::max(nearest, p.z());
    farthest = std::min(farthest, p.z());
  }
};

Reach reach_of(std::span<const Vector3> points, const Matrix3& axes, double tangent_x, double tangent_y) {
  Reach reach;
  for (const Vector3& point : points) reach.add(axes * point, tangent_x, tangent_y);
  return reach;
}

/// Points that stand in for ones without extent.
std::array<Vector3, 6> unit_ball(const Vector3& centre) {
  return {centre + Vector3::UnitX(), centre - Vector3::UnitX(), centre + Vector3::UnitY(),
          centre - Vector3::UnitY(), centre + Vector3::UnitZ(), centre - Vector3::UnitZ()};
}

bool have_extent(std::span<const Vector3> points) {
  return std::any_of(points.begin(), points.end(), [&](const Vector3& p) { return p != points.front(); });
}

}  // namespace

Matrix4 perspective(const Frustum& f) {
  Matrix4 m = Matrix4::Zero();
  m(0, 0) = 2.0 / (f.right - f.left);
  m(0, 2) = (f.right + f.left) / (f.right - f.left);
  m(1, 1) = 2.0 / (f.top - f.bottom);
  m(1, 2) = (f.top + f.bottom) / (f.top - f.bottom);
  m(2, 2) = -(f.far + f.near) / (f.far - f.near);
  m(2, 3) = -2.0 * f.far * f.near / (f.far - f.near);
  m(3, 2) = -1.0;
  return m;
}

Camera fit_camera(std::span<const Vector3> points, const FitOptions& options) {
  if (!have_extent(points)) {
    return fit_camera(unit_ball(points.empty() ? Vector3::Zero() : points.front()), options);
  }
  const double tangent_y = std::tan(0.5 * options.vertical_field);
  const double tangent_x = tangent_y * options.aspect;
  const double inner_x = tangent_x * (1.0 - 2.0 * options.margin_x);
  const double inner_y = tangent_y * (1.0 - 2.0 * options.margin_y);
  const Matrix3 axes = camera_axes(options.toward_eye, options.up);
  const Reach reach = reach_of(points, axes, inner_x, inner_y);
  const Wedge across = apex(reach.right, reach.left, inner_x);
  const Wedge upright = apex(reach.top, reach.bottom, inner_y);
  const double depth = reach.nearest - reach.farthest;
  // A thin sheet seen edge-on has no height or width, but the eye must stay in front of it.
  const double least = reach.nearest + 0.05 * depth;
  const Vector3 eye(across.centre, upright.centre, std::max({across.distance, upright.distance, least}));

  // Room behind and before the points, for a floor and its shadow.
  const double near = std::max(0.2 * (eye.z() - reach.nearest), 1e-3 * (eye.z() - reach.farthest));
  const double far = 2.0 * (eye.z() - reach.farthest) + depth;
  Camera camera;
  camera.camera_from_world.linear() = axes;
  camera.camera_from_world.translation() = -eye;
  camera.clip_from_camera = perspective({-tangent_x, tangent_x, -tangent_y, tangent_y, near, far});
  return camera;
}

std::vector<Vector3> outermost(std::span<const Vector3> points) {
  constexpr int kDirections = 32;         // evenly over half a ball; opposite ones come with them
  constexpr double kGolden = 2.39996323;  // rad
  std::vector<Vector3> extremes;
  for (int i = 0; i < kDirections && !points.empty(); ++i) {
    const double z = (i + 0.5) / kDirections;
    const double rho = std::sqrt(1.0 - z * z);
    const Vector3 way(rho * std::cos(kGolden * i), rho * std::sin(kGolden * i), z);
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(),
                            [&](const Vector3& a, const Vector3& b) { return way.dot(a) < way.dot(b); });
    extremes.insert(extremes.end(), {*low, *high});
  }
  return extremes;
}

std::optional<Projected> project(const Camera& camera, const Vector3& point) {
  const Vector3 seen = camera.camera_from_world * point;
  const Eigen::Vector4d clip = camera.clip_from_camera * seen.homogeneous();
  if (!(clip.w() > 0.0) || !clip.allFinite()) return std::nullopt;
  return Projected{0.5 + 0.5 * clip.x() / clip.w(), 0.5 - 0.5 * clip.y() / clip.w(), -seen.z()};
}

base::Bounds device_box(const base::Bounds& box, const Matrix4& clip_from_box) {
  base::Bounds seen;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 at = box.corner(static_cast<base::Bounds::CornerType>(corner));
    const Eigen::Vector4d clip = clip_from_box * at.homogeneous();
    if (!(clip.w() > 0.0)) return {Vector3(-1.0, -1.0, -1.0), Vector3(1.0, 1.0, 1.0)};
    seen.extend(Vector3(clip.head<3>() / clip.w()));
  }
  return seen;
}

double pixels_a_metre(const Camera& camera, const Vector3& centre, double radius, double height) {
  const Vector3 middle = camera.camera_from_world * centre;
  const auto depth = camera.clip_from_camera.row(3);  // the divisor by which things grow smaller
  const double nearest = depth.head<3>() * middle + depth[3] - radius * depth.head<3>().norm();
  const double pixels = 0.5 * height * camera.clip_from_camera.row(1).head<3>().norm() / nearest;
  return nearest > 0.0 && std::isfinite(pixels) ? pixels : HUGE_VAL;
}

double distance_of_depth(const Camera& camera, double depth) {
  const Matrix4& m = camera.clip_from_camera;
  const double ndc = 2.0 * depth - 1.0;
  return (m(2, 3) - ndc * m(3, 3)) / (m(2, 2) - ndc * m(3, 2));
}

Camera light_camera(const Vector3& direction, const Vector3& centre, double radius) {
  const Matrix3 axes = camera_axes(-direction, Vector3::UnitY());
  Camera camera;
  camera.camera_from_world.linear() = axes;
  camera.camera_from_world.translation() = -(axes * centre);
  camera.clip_from_camera.diagonal() << 1.0 / radius, 1.0 / radius, -1.0 / radius, 1.0;
  return camera;
}

}  // namespace icome::render
