#include "cutout/synth/synthetic_camera.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace icome::cutout {
namespace {

constexpr double kFocalPerWidth = 1.15;  // a lens of 47 degrees
constexpr double kMargin = 0.02;         // of the frame's sides, around the table

/// Brown's distortion of a point of the plane at depth 1.
base::Vector2 lens_bent(const Lens& lens, const base::Vector2& point) {
  const double x = point.x(), y = point.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  return {x * radial + 2.0 * lens.p1 * x * y + lens.p2 * (r2 + 2.0 * x * x),
          y * radial + lens.p1 * (r2 + 2.0 * y * y) + 2.0 * lens.p2 * x * y};
}

base::Vector2 lens_straightened(const Lens& lens, const base::Vector2& seen) {
  constexpr double kStep = 1e-6;
  base::Vector2 point = seen;
  for (int i = 0; i < 20; ++i) {
    const base::Vector2 miss = lens_bent(lens, point) - seen;
    if (miss.squaredNorm() < 1e-28) break;
    Eigen::Matrix2d slopes;
    slopes.col(0) = (lens_bent(lens, point + base::Vector2(kStep, 0)) - seen - miss) / kStep;
    slopes.col(1) = (lens_bent(lens, point + base::Vector2(0, kStep)) - seen - miss) / kStep;
    point -= slopes.inverse() * miss;
  }
  return point;
}

}  // namespace

SyntheticCamera SyntheticCamera::over_table(int width, int height, double table_width, double table_height,
                                            double thickness, double tilt) {
  SyntheticCamera camera;
  camera.width_ = width;
  camera.height_ = height;
  const double side = std::max(width, height);
  camera.lens_ = {kFocalPerWidth * side,
                  kFocalPerWidth * 1.001 * side,
                  0.5 * (width - 1) + 0.011 * side,
                  0.5 * (height - 1) - 0.007 * side,
                  -0.11,
                  0.04,
                  0.0008,
                  -0.0006,
                  0.0};
  const base::Vector3 middle(0.5 * table_width, 0.5 * table_height, thickness);
  const auto sees_all = [&] {
    for (const double x : {0.0, table_width})
      for (const double y : {0.0, table_height}) {
        const base::Vector2 seen = camera.project({x, y, thickness});
        if (!(seen.x() > kMargin * width && seen.x() < (1 - kMargin) * width && seen.y() > kMargin * height &&
              seen.y() < (1 - kMargin) * height))
          return false;
      }
    return true;
  };
  double near = 0.5 * std::max(table_width, table_height);
  double far = 20.0 * std::max(table_width, table_height) * (1.0 + side / std::min(width, height));
  for (int i = 0; i < 60; ++i) {
    const double between = 0.5 * (near + far);
    camera.stand_off(between, tilt, middle);
    (sees_all() ? far : near) = between;
  }
  camera.stand_off(far, tilt, middle);
  return camera;
}

void SyntheticCamera::stand_off(double distance, double tilt, const base::Vector3& middle) {
  camera_from_world_ =
      (Eigen::AngleAxisd(0.02, base::Vector3::UnitZ()) * Eigen::AngleAxisd(tilt, base::Vector3::UnitX()) *
       Eigen::AngleAxisd(-0.3 * tilt, base::Vector3::UnitY()))
          .toRotationMatrix();
  place_ = middle - distance * camera_from_world_.transpose() * base::Vector3::UnitZ();
}

base::Vector2 SyntheticCamera::project(const base::Vector3& mm) const {
  const base::Vector3 seen = camera_from_world_ * (mm - place_);
  const base::Vector2 point = lens_bent(lens_, seen.head<2>() / seen.z());
  return {lens_.fx * point.x() + lens_.cx, lens_.fy * point.y() + lens_.cy};
}

base::Vector2 SyntheticCamera::slope(const base::Vector2& pixel) const {
  const base::Vector2 point =
      lens_straightened(lens_, {(pixel.x() - lens_.cx) / lens_.fx, (pixel.y() - lens_.cy) / lens_.fy});
  const base::Vector3 way = camera_from_world_.transpose() * base::Vector3(point.x(), point.y(), 1.0);
  return way.head<2>() / way.z();
}

base::Vector2 SyntheticCamera::on_plane(const base::Vector2& pixel, double z) const {
  return place_.head<2>() + slope(pixel) * (z - place_.z());
}

base::Matrix3 SyntheticCamera::pixels_from_faces() const {
  base::Matrix3 pinhole;
  pinhole << lens_.fx, 0, lens_.cx, 0, lens_.fy, lens_.cy, 0, 0, 1;
  base::Matrix3 place;
  place << camera_from_world_.col(0), camera_from_world_.col(1), -camera_from_world_ * place_;
  return pinhole * place;
}

}  // namespace icome::cutout
