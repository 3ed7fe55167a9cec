#pragma once
#include <array>
#include <span>
#include <vector>

#include "base/result.h"
#include "render/scene/scene_buffers.h"
#include "render/scene/scene_pass_lights.h"
#include "render/scene/scene_plan.h"
#include "render/scene/scene_programs.h"
#include "render/scene/scene_targets.h"

namespace icome::render {

/// A solid that is drawn from images of its operands.
struct PlannedSolid {
  const PlannedItem* item;
  const CsgView* view;
};

/// Draws the stages of one pass into the frame that is bound. Refers to its arguments.
class ScenePass {
 public:
  /// `clip_shift` moves the picture by less than a pixel; `serial` differs from pass to pass.
  ScenePass(ScenePrograms& programs, SceneBuffers& buffers, const ScenePassLights& lights,
            const Matrix4& clip_shift, int serial)
      : programs_(programs), buffers_(buffers), lights_(lights), clip_shift_(clip_shift), serial_(serial) {}

  base::Result<void> shadow_maps(const RenderScene& scene, const SceneCanvas& maps, int side);
  base::Result<void> opaque(std::span<const PlannedItem> items);
  /// Draws backs first, then fronts, mixed with the picture behind, so that nothing behind is lost.
  base::Result<void> blended(std::span<const PlannedItem> items);
  /// The shadow on a plane through `middle`, y up, as black that hides part of the picture behind.
  base::Result<void> ground(const MeshView& square, const Camera& camera, const base::Vector3& middle,
                            double reach);
  /// Draws all items in white.
  base::Result<void> mask(std::span<const PlannedItem> items);

 private:
  base::Result<SceneProgram*> use_lit(base::Result<SceneProgram*> program) const;
  void set_look(const SceneProgram& program, const PlannedItem& item);
  void draw_surface(const SceneProgram& program, const PlannedItem& item);
  base::Result<void> solids(std::span<const PlannedSolid> solids);
  base::Result<void> blended_solid(const PlannedSolid& solid);
  base::Result<void> mask_solids(std::span<const PlannedSolid> solids);
  base::Result<void> cast_solids(std::span<const PlannedItem> casters, const SceneCanvas& maps, int map,
                                 int side);
  void draw_whole(const GlObject& program, const GlObject& source);
  base::Result<void> draw_depths(const GlObject& depths, const std::array<int, 2>& corner, double scale,
                                 double shift);
  base::Result<void> draw_flat(std::span<const PlannedItem> items, const Eigen::Vector4f& colour);

  ScenePrograms& programs_;
  SceneBuffers& buffers_;
  const ScenePassLights& lights_;
  Matrix4 clip_shift_;
  int serial_;
};

}  // namespace icome::render
