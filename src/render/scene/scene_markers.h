#pragma once
#include <vector>

#include "render/scene/scene_pass.h"
#include "render/scene/scene_renderer.h"

namespace icome::render {

/// Draws overlays. Owns the few shapes that markers are made of, and buffers of their lines.
class SceneMarkers {
 public:
  /// The pass's frame is bound, with the scene in it.
  base::Result<void> draw(const SceneOverlay& overlay, const Camera& camera, ScenePass& pass,
                          ScenePrograms& programs, const SceneTarget& target);

 private:
  void make_shapes();
  std::vector<RenderItem> items_of(const SceneOverlay& overlay, float alpha) const;
  base::Result<void> draw_lines(const SceneOverlay& overlay, const Camera& camera, ScenePrograms& programs,
                                const SceneTarget& target, float alpha);
  base::Result<void> draw_dots(const SceneOverlay& overlay, const Camera& camera, ScenePrograms& programs,
                               const SceneTarget& target, float alpha);

  RenderShapePointer ball_, shaft_, head_;
};

}  // namespace icome::render
