#pragma once
#include <array>
#include <optional>
#include <string_view>

#include "render/model/camera.h"
#include "render/model/render_scene.h"

namespace icome::render {

/// A direction of view, given to the eye, and the upright direction, where y is up.
struct ViewDirection {
  std::string_view name;
  base::Vector3 toward_eye;
  base::Vector3 up;
};

/// front, back, left, right, top, bottom and iso.
const std::array<ViewDirection, 7>& view_directions();

/// The direction of that name; nothing for other names.
std::optional<ViewDirection> view_direction(std::string_view name);

/// The camera that looks in that direction and sees all of the scene, as large as it can be; aspect is width
/// over height.
Camera fit_scene(const RenderScene& scene, const ViewDirection& direction, double aspect);

/// The camera at a viewpoint of the design, without the stretching or mirroring of its placement.
Camera look_from(const RenderViewpoint& viewpoint, const base::Bounds& bounds, double aspect);

/// The perspective of a window that, before its middle, holds `field` (rad) along its shorter side; its
/// middle lies `shift` (tangents, to the right and up) from straight ahead. Near and far are chosen so that
/// depth tells things within the bounds (m, world frame) apart.
Matrix4 lens_for(const base::Pose& camera_from_world, const base::Bounds& bounds, double field, double aspect,
                 const base::Vector2& shift = base::Vector2::Zero());

}  // namespace icome::render
