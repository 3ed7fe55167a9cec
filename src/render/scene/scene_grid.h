#pragma once
#include <optional>

#include "base/result.h"
#include "render/model/camera.h"
#include "render/scene/scene_programs.h"

namespace icome::render {

struct SceneLook;

/// The lines of a ground grid.
struct GridPlan {
  base::Vector2 middle;   ///< m, x and z of the place that it is drawn around: below the eye
  double cell = 0.1;      ///< m, of the finest lines: a power of ten
  double fineness = 0.0;  ///< 0: the finest are seen best; towards 1 they give way to those of ten cells
  double reach = 1.0;     ///< m, from the middle to where it has faded away
};

/// Fits a grid to the part of the plane y = 0 that the camera looks at. Nothing when the eye is in the plane.
std::optional<GridPlan> plan_grid(const Camera& camera);

/// Draws the grid of the look into the frame that is bound, with the scene's depths in it.
class SceneGrid {
 public:
  SceneGrid();
  /// `clip_shift` as for ScenePass. `camera` is of the target's window, `whole` of the whole picture.
  base::Result<void> draw(const SceneLook& look, const Camera& whole, const Camera& camera,
                          const Matrix4& clip_shift, ScenePrograms& programs);

 private:
  GlObject arrays_{GlObject::Kind::VertexArray}, corners_{GlObject::Kind::Buffer};
};

}  // namespace icome::render
