#include "render/scene/scene_shadows.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

namespace icome::render {
namespace {

using base::Bounds;
using base::Vector3;

bool same_lens(const Camera& a, const Camera& b) {
  return a.camera_from_world.matrix() == b.camera_from_world.matrix() &&
         a.clip_from_camera == b.clip_from_camera;
}

}  // namespace

std::optional<ShadowRegion> shadow_region(const Bounds& visible, const Camera& camera) {
  if (visible.isEmpty()) return std::nullopt;
  Bounds seen;
  const Matrix4 world_from_clip = camera.clip_from_world().inverse();
  double farthest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 at = camera.camera_from_world * visible.corner(static_cast<Bounds::CornerType>(corner));
    farthest = std::max(farthest, -at.z());
  }
  const Vector3 eye = camera.eye();
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Vector3 at = (world_from_clip * Eigen::Vector4d(x, y, 0.0, 1.0)).hnormalized();
      const double depth = -(camera.camera_from_world * at).z();
      seen.extend(eye + farthest / depth * (at - eye));
    }
  }
  seen.extend(eye);
  const Bounds region = visible.intersection(seen);
  const Bounds& used = region.isEmpty() || !region.sizes().allFinite() ? visible : region;
  const double radius = 0.5 * used.sizes().norm();
  if (!std::isfinite(radius) || !(radius > 0.0)) return std::nullopt;
  return ShadowRegion{0.5 * (used.min() + used.max()), radius};
}

ShadowRegion steady_region(const ShadowRegion& region, const Bounds& whole) {
  const Vector3 middle = 0.5 * (whole.min() + whole.max());
  double radius = 0.5 * whole.sizes().norm();
  // Its place is rounded to a quarter of the radius: up to 0.22 of that away along the diagonal.
  constexpr double kRoom = 1.4;
  if (!std::isfinite(radius) || !(radius > 2.0 * kRoom * region.radius)) {
    return std::isfinite(radius) && radius > 0.0 ? ShadowRegion{middle, radius} : region;
  }
  radius *= std::exp2(-std::floor(std::log2(radius / (kRoom * region.radius))));
  const double step = 0.25 * radius;
  const Vector3 steps = ((region.centre - middle) / step).array().round();
  return {middle + step * steps, radius};
}

base::Result<void> SceneShadowMaps::fit(int maps, int side) {
  if (canvas.width == maps * side && canvas.height == side) return {};
  blocks.clear();
  lenses.clear();
  auto done = canvas.fit(maps * side, side, 0, GL_DEPTH24_STENCIL8);
  if (!done) return done;
  glBindTexture(GL_TEXTURE_2D, canvas.depth.name());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  return done;
}

bool SceneShadowMaps::show(const RenderScene& scene, const std::vector<Camera>& wanted) const {
  return scene.blocks() == blocks &&
         std::equal(lenses.begin(), lenses.end(), wanted.begin(), wanted.end(), same_lens);
}

}  // namespace icome::render
