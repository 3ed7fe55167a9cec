#pragma once
#include <memory>
#include <unordered_map>
#include <vector>

#include "render/csg/scene_solids.h"
#include "render/gl/mesh_view.h"
#include "render/model/render_scene.h"
#include "render/scene/scene_plan.h"

namespace icome::render {

/// Shapes and pictures on the graphics card, uploaded when they are first drawn and dropped when no version
/// of a scene has them any more. Lives in one context.
class SceneBuffers {
 public:
  /// `level`: one of the shape's coarser levels, or kFullLevel.
  const MeshView& view(const RenderShapePointer& shape, int level);
  unsigned picture(const std::shared_ptr<const RenderPicture>& picture);

  SceneSolids& solids() { return solids_; }

  void drop_unused();

 private:
  struct ShapeEntry {
    std::weak_ptr<const RenderShape> shape;
    std::vector<std::unique_ptr<MeshView>> views;  // the shape itself, then its coarser ones
  };
  struct PictureEntry {
    std::weak_ptr<const RenderPicture> picture;
    GlObject texture;
  };

  std::unordered_map<const RenderShape*, ShapeEntry> shapes_;
  std::unordered_map<const RenderPicture*, PictureEntry> pictures_;
  SceneSolids solids_;
};

}  // namespace icome::render
