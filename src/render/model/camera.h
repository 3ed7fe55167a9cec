#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.h"

namespace icome::render {

using Matrix4 = Eigen::Matrix4d;

/// The eye and the window that it looks through: a pose and a projection, so that a head-tracked
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

/// Settings for fitting a view around points.
struct FitOptions {
  base::Vector3 toward_eye{0.0, 0.0, 1.0};  ///< from the points to the eye, any length > 0
  base::Vector3 up{0.0, 1.0, 0.0};          ///< upright direction in the picture, any length > 0
  double vertical_field = 0.42;             ///< rad, opening of the whole picture; 0.3 ... 1.2
  double aspect = 1.5;                      ///< width / height of the picture
  double margin_x = 0.05;                   ///< share of the width left free on each side; < 0.5
  double margin_y = 0.05;                   ///< share of the height left free on each side; < 0.5
};

/// The camera nearest to the points that sees all of them within the margins, exact for perspective.
/// Without points, or when all coincide, it frames a ball of radius 1 around them (or the origin).
Camera fit_camera(std::span<const base::Vector3> points, const FitOptions& options);

/// The points farthest out in 64 directions all round, which frame a view nearly as well as all of them.
std::vector<base::Vector3> outermost(std::span<const base::Vector3> points);

/// A point as the picture shows it.
struct Projected {
  double x, y;      ///< share of the picture's width from the left and of its height from the top
  double distance;  ///< along the view axis, in the world's unit
};

/// The point as it appears; nothing when it is not in front of the camera.
std::optional<Projected> project(const Camera& camera, const base::Vector3& point);

/// The box around the picture of a box (in the frame that `clip_from_box` takes), in OpenGL's
/// normalised device coordinates; x and y are -1 ... 1 when part of it is not in front of the camera.
base::Bounds device_box(const base::Bounds& box, const Matrix4& clip_from_box);

/// Pixels that a metre takes at the place of a ball nearest to the eye, in a picture of that height
/// (pixels); infinite where the eye may be in the ball.
double pixels_a_metre(const Camera& camera, const base::Vector3& centre, double radius, double height);

/// The distance along the view axis that a depth buffer's value (0 ... 1) stands for.
double distance_of_depth(const Camera& camera, double depth);

/// The lens of a light that shines along `direction` (any length > 0) on a ball of that radius: an
/// orthographic camera.
Camera light_camera(const base::Vector3& direction, const base::Vector3& centre, double radius);

}  // namespace icome::render
