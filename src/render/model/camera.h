#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.h"

namespace icome::render {

using Matrix4 = Eigen::Matrix4d;

/// Where one looks from and through which window: a pose and a projection, so that a head-tracked
/// (off-axis) view is a camera like any other. The camera looks along its -z, +y up.
struct Camera {
  base::Pose camera_from_world = base::Pose::Identity();
  Matrix4 clip_from_camera = Matrix4::Identity();  ///< OpenGL clip space, depth -1 ... 1

  Matrix4 clip_from_world() const { return clip_from_camera * camera_from_world.matrix(); }
  base::Vector3 eye() const { return camera_from_world.inverse().translation(); }
};

/// The window one looks through, as tangents of the angles to its edges, and the depth range.
struct Frustum {
  double left, right, bottom, top;  ///< tangents, left < right, bottom < top
  double near, far;                 ///< distances along the view axis in the world's unit, 0 < near < far
};

/// The perspective projection through that window; off-axis where its edges are not symmetric.
Matrix4 perspective(const Frustum& frustum);

/// How a view is fitted around something.
struct FitOptions {
  base::Vector3 toward_eye{0.0, 0.0, 1.0};  ///< from what is seen to the eye, any length > 0
  base::Vector3 up{0.0, 1.0, 0.0};          ///< what stands upright in the picture, any length > 0
  double vertical_field = 0.42;             ///< rad, opening of the whole picture; 0.3 ... 1.2
  double aspect = 1.5;                      ///< width / height of the picture
  double margin_x = 0.05;                   ///< share of the width left free on each side; < 0.5
  double margin_y = 0.05;                   ///< share of the height left free on each side; < 0.5
};

/// The camera nearest to the points that sees all of them within the margins, exact for perspective.
/// Without points, or when all coincide, it frames a ball of radius 1 around them (or the origin).
Camera fit_camera(std::span<const base::Vector3> points, const FitOptions& options);

/// Of many points those farthest out in 64 directions all round, which frame a view nearly as well.
std::vector<base::Vector3> outermost(std::span<const base::Vector3> points);

/// A point as the picture shows it.
struct Projected {
  double x, y;      ///< share of the picture's width from the left and of its height from the top
  double distance;  ///< along the view axis, in the world's unit
};

/// Where the point appears; nothing when it is not in front of the camera.
std::optional<Projected> project(const Camera& camera, const base::Vector3& point);

/// The box around where a box (in the frame that `clip_from_box` takes) appears, in OpenGL's normalised
/// device coordinates; x and y are -1 ... 1 when part of it is not in front of the camera.
base::Bounds device_box(const base::Bounds& box, const Matrix4& clip_from_box);

/// How many pixels a metre takes where a ball is nearest to the eye, in a picture of that height (pixels);
/// infinite where the eye may be in the ball.
double pixels_a_metre(const Camera& camera, const base::Vector3& centre, double radius, double height);

/// The distance along the view axis that a depth buffer's value (0 ... 1) stands for.
double distance_of_depth(const Camera& camera, double depth);

/// The lens of a light that shines along `direction` (any length > 0) on a ball of that radius: an
/// orthographic camera.
Camera light_camera(const base::Vector3& direction, const base::Vector3& centre, double radius);

}  // namespace icome::render
