#pragma once
#include "apps/design/shot_options.h"
#include "base/vector.h"
#include "render/scene/scene_renderer.h"

namespace icome::apps {

/// Is another eye asked for than the one straight before the picture's middle?
bool has_own_eyes(const ShotOptions& options);

/// The eyes that look at a picture through a screen, and the middle of both.
struct ShotEyes {
  render::Camera middle;
  render::EyeCameras eyes;
};

/// The eyes by the options' screen, place and distance, for a camera before the middle of its picture. The
/// screen lies in the plane through the middle of the bounds, which has no parallax, and shows as much of it
/// as the camera did.
ShotEyes shot_eyes(const render::Camera& camera, const base::Bounds& bounds, const ShotOptions& options);

}  // namespace icome::apps
