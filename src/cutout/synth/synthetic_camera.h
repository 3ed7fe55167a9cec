#pragma once
#include "base/vector.h"
#include "cutout/tracker/table_view.h"

namespace icome::cutout {

/// A pinhole camera with a lens that bends, above the table. World: mm, x to the right and y down as the
/// camera sees them, z away from the camera; the upper faces of triangles lie at z = 0.
class SyntheticCamera {
 public:
  /// Sees all of a table, whose upper left corner is the origin, and little more.
  static SyntheticCamera over_table(int width, int height, double table_width, double table_height,
                                    double thickness, double tilt);

  int width() const { return width_; }
  int height() const { return height_; }
  const base::Vector3& place() const { return place_; }
  const Lens& lens() const { return lens_; }
  const base::Matrix3& camera_from_world() const { return camera_from_world_; }

  base::Vector2 project(const base::Vector3& mm) const;  ///< pixels
  /// The place in the plane of that height that the pixel sees. Newton's method, right to 1e-10 pixels.
  base::Vector2 on_plane(const base::Vector2& pixel, double z) const;
  /// Slope of the pixel's ray: mm in x and y for each mm in z.
  base::Vector2 slope(const base::Vector2& pixel) const;

  /// The homography from mm of the upper faces' plane to pixels without the lens' bending.
  base::Matrix3 pixels_from_faces() const;

 private:
  void stand_off(double distance, double tilt, const base::Vector3& middle);

  int width_ = 0, height_ = 0;
  Lens lens_;
  base::Matrix3 camera_from_world_ = base::Matrix3::Identity();
  base::Vector3 place_ = base::Vector3::Zero();
};

}  // namespace icome::cutout
