#include "apps/design/shot_eyes.h"

#include <algorithm>
#include <cmath>

#include "render/model/views.h"

namespace icome::apps {
namespace {

using base::Vector3;
using interaction::View;

/// The view of a camera that looks straight at the middle of its picture.
View shot_view_of(const render::Camera& camera, const base::Bounds& bounds) {
  View view;
  view.world_from_eye = camera.camera_from_world.inverse();
  view.field = 2.0 * std::atan(1.0 / std::max(camera.clip_from_camera(0, 0), camera.clip_from_camera(1, 1)));
  if (!bounds.isEmpty()) {
    const double ahead = -(camera.camera_from_world * Vector3(bounds.center())).z();
    if (ahead > 0.0 && std::isfinite(ahead)) view.distance = ahead;
  }
  return interaction::usable(view);
}

render::Camera shot_camera_of(const View& view, const base::Bounds& bounds, double aspect) {
  render::Camera camera;
  camera.camera_from_world = view.world_from_eye.inverse();
  camera.clip_from_camera =
      render::lens_for(camera.camera_from_world, bounds, view.field, aspect, view.shift);
  return camera;
}

}  // namespace

bool has_own_eyes(const ShotOptions& options) {
  return options.stereo.kind != interaction::StereoKind::Off || options.screen || options.eye;
}

ShotEyes shot_eyes(const render::Camera& camera, const base::Bounds& bounds, const ShotOptions& options) {
  const double aspect = double(options.width) / options.height;
  interaction::FishTank screen;
  View view = shot_view_of(camera, bounds);
  if (options.screen) {
    screen.size = *options.screen;
    view = interaction::with_field(view, interaction::field_of(screen));
  }
  const double scale = view.distance / screen.distance;
  const Vector3 place =
      scale * (options.eye.value_or(Vector3(0.0, 0.0, screen.distance)) - Vector3(0.0, 0.0, screen.distance));
  const auto seen = [&](double aside) {
    const Vector3 eye = place + Vector3(aside * scale * options.stereo.eye_distance, 0.0, 0.0);
    return shot_camera_of(interaction::seen_from(view, eye), bounds, aspect);
  };
  return {seen(0.0), {seen(-0.5), seen(0.5)}};
}

}  // namespace icome::apps
