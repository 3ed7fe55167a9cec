#pragma once
#include "base/result.h"
#include "render/scene/scene_programs.h"
#include "render/scene/scene_renderer.h"
#include "render/scene/scene_targets.h"

namespace icome::render {

/// Draws the pictures of both eyes, each with a renderer of its own, and lays them into one target. Lives in
/// one context.
class StereoPass {
 public:
  /// As SceneRenderer::draw_pass().
  base::Result<void> draw(const RenderScene& scene, const EyeCameras& eyes, StereoLayout layout,
                          const SceneLook& look, const SceneTarget& target, int number,
                          ScenePrograms& programs);

 private:
  base::Result<void> lay_over(const SceneTarget& target, ScenePrograms& programs);
  void lay_beside(StereoLayout layout, const SceneTarget& target) const;

  SceneRenderer left_, right_;
  SceneCanvas left_picture_, right_picture_;
  GlObject no_arrays_{GlObject::Kind::VertexArray};
};

}  // namespace icome::render
