#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "render/model/camera.h"
#include "render/model/render_scene.h"
#include "render/scene/scene_targets.h"

namespace icome::render {

/// What shadow maps cover.
struct ShadowRegion {
  base::Vector3 centre;  ///< m, world frame
  double radius = 1.0;   ///< m, > 0
};

/// What the camera can see of the visible things: the shadow maps' texels are spent on that.
std::optional<ShadowRegion> shadow_region(const base::Bounds& visible, const Camera& camera);

/// One that has the region in it and stays the same while the region moves and grows a little; not larger
/// than the whole.
ShadowRegion steady_region(const ShadowRegion& region, const base::Bounds& whole);

/// Shadow maps side by side in one texture, and what was drawn into them.
struct SceneShadowMaps {
  SceneCanvas canvas;
  /// Of what is in them; keeps the scene's blocks, so that another cannot be taken for it.
  std::vector<std::shared_ptr<const RenderScene::Block>> blocks;
  std::vector<Camera> lenses;

  base::Result<void> fit(int maps, int side);
  bool show(const RenderScene& scene, const std::vector<Camera>& wanted) const;
};

}  // namespace icome::render
