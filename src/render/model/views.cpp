#include "render/model/views.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/decompositions.h"

namespace icome::render {
namespace {

using base::Vector3;

std::vector<Vector3> outermost_points(const RenderScene& scene) {
  constexpr std::size_t kExactUpTo = 20'000;  // objects; of more the boxes alone
  const bool exact = scene.object_count() <= kExactUpTo;
  std::vector<Vector3> points;
  scene.for_each([&](const RenderItem& item) {
    if (item.bounds.isEmpty()) return;
    if (exact) {
      for (const Vector3& it : item.shape->extremes) points.push_back(item.world_from_object * it);
    } else {
      for (int corner = 0; corner < 8; ++corner)
        points.push_back(item.bounds.corner(static_cast<base::Bounds::CornerType>(corner)));
    }
  });
  std::erase_if(points, [](const Vector3& it) { return !it.allFinite(); });
  return points;
}

}  // namespace

const std::array<ViewDirection, 7>& view_directions() {
  static const std::array<ViewDirection, 7> kViews = {{
      {"front", Vector3::UnitZ(), Vector3::UnitY()},
      {"back", -Vector3::UnitZ(), Vector3::UnitY()},
      {"left", -Vector3::UnitX(), Vector3::UnitY()},
      {"right", Vector3::UnitX(), Vector3::UnitY()},
      {"top", Vector3::UnitY(), -Vector3::UnitZ()},
      {"bottom", -Vector3::UnitY(), Vector3::UnitZ()},
      {"iso", Vector3(0.62, 0.52, 1.0), Vector3::UnitY()},
  }};
  return kViews;
}

std::optional<ViewDirection> view_direction(std::string_view name) {
  for (const ViewDirection& it : view_directions()) {
    if (it.name == name) return it;
  }
  return std::nullopt;
}

Camera fit_scene(const RenderScene& scene, const ViewDirection& direction, double aspect) {
  FitOptions options;
  options.toward_eye = direction.toward_eye;
  options.up = direction.up;
  options.aspect = aspect;
  // The shorter side keeps the angle, so that tall pictures are no wide-angle ones.
  if (aspect < 1.0) options.vertical_field = 2.0 * std::atan(std::tan(0.5 * options.vertical_field) / aspect);
  options.margin_x = options.margin_y = 0.07;
  return fit_camera(outermost_points(scene), options);
}

Matrix4 lens_for(const base::Pose& camera_from_world, const base::Bounds& bounds, double field, double aspect,
                 const base::Vector2& shift) {
  double nearest = 1.0, farthest = 1.0;
  if (!bounds.isEmpty()) {
    nearest = INFINITY;
    farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 at = camera_from_world * bounds.corner(static_cast<base::Bounds::CornerType>(corner));
      nearest = std::min(nearest, -at.z());
      farthest = std::max(farthest, -at.z());
    }
  }
  constexpr double kDepthRatio = 2e-4;  // of 24 bits this leaves 1e-5 of the distance half-way
  // Behind the farthest there may be a floor.
  const double far = farthest > 0.0 && std::isfinite(farthest) ? 3.0 * farthest : 1.0;
  const double near = std::max(0.5 * nearest, kDepthRatio * far);
  const double tangent = std::tan(0.5 * field);
  const double x = aspect < 1.0 ? tangent : tangent * aspect;
  const double y = aspect < 1.0 ? tangent / aspect : tangent;
  return perspective({shift.x() - x, shift.x() + x, shift.y() - y, shift.y() + y, near, far});
}

Camera look_from(const RenderViewpoint& viewpoint, const base::Bounds& bounds, double aspect) {
  base::Pose world_from_camera;
  const base::Matrix3 linear = viewpoint.world_from_viewpoint.linear();
  if (linear.allFinite()) {
    const base::SingularValues parts = base::singular_values(linear);
    world_from_camera.linear() = parts.u * parts.v.transpose();
  } else {
    world_from_camera.linear().setIdentity();
  }
  if (world_from_camera.linear().determinant() < 0.0) world_from_camera.linear().col(0) *= -1.0;
  world_from_camera.translation() = viewpoint.world_from_viewpoint.translation();
  Camera camera;
  camera.camera_from_world = world_from_camera.inverse();
  // A lens cannot see half of everything.
  const double field = std::clamp(viewpoint.field_of_view, 0.01, 2.8);
  camera.clip_from_camera = lens_for(camera.camera_from_world, bounds, field, aspect);
  return camera;
}

}  // namespace icome::render
