#include <Eigen/LU>
#include <cmath>

#include "cutout/tracker/table_view.h"

namespace icome::cutout {

void TableView::set_thickness(double millimetres) {
  thickness_ = millimetres;
  below_camera_.setZero();
  camera_height_ = 0;
  wall_share_ = 0;
  if (!has_lens()) return;
  // Columns of the homography are the turned axes of the plane and its origin as the camera has them.
  base::Matrix3 pinhole;
  pinhole << lens_.fx, 0, lens_.cx, 0, lens_.fy, lens_.cy, 0, 0, 1;
  base::Matrix3 seen = pinhole.inverse() * pixels_from_mm_;
  seen *= 2.0 / (seen.col(0).norm() + seen.col(1).norm());
  if (seen(2, 2) < 0) seen = -seen;  // the table lies before the camera
  const base::Vector3 down = seen.col(0).cross(seen.col(1)).normalized();
  base::Matrix3 camera_from_plane;
  camera_from_plane << seen.col(0), seen.col(1), down;
  const base::Vector3 camera = -camera_from_plane.inverse() * seen.col(2);
  if (!(camera.z() < 0)) return;
  below_camera_ = camera.head<2>();
  camera_height_ = -camera.z();
  wall_share_ = thickness_ / (camera_height_ + thickness_);
}

}  // namespace icome::cutout
