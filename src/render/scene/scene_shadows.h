#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "render/model/camera.h"
#include "render/model/render_scene.h"
#include "render/scene/scene_targets.h"

namespace icome::render {

/// The ball that shadow maps cover.
struct ShadowRegion {
  base::Vector3 centre;  ///< m, world frame
  double radius = 1.0;   ///< m, > 0
};

/// The part of the visible things that the camera can see: the shadow maps' texels are spent on that.
std::optional<ShadowRegion> shadow_region(const base::Bounds& visible, const Camera& camera);

/// A region that holds the given one and stays the same while that moves and grows a little; not larger
/// than the whole.
ShadowRegion steady_region(const ShadowRegion& region, const base::Bounds& whole);

/// Shadow maps side by side in one texture, and the blocks and lenses that they were drawn from.
struct SceneShadowMaps {
  SceneCanvas canvas;
  /// Blocks of the scene in the maps; kept alive, so that other blocks cannot be taken for them.
  std::vector<std::shared_ptr<const RenderScene::Block>> blocks;
  std::vector<Camera> lenses;

  base::Result<void> fit(int maps, int side);
  bool show(const RenderScene& scene, const std::vector<Camera>& wanted) const;
};

}  // namespace icome::render
