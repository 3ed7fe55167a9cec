#pragma once
#include <memory>
#include <unordered_map>

#include "render/mesh_view.h"
#include "render/render_scene.h"
#include "render/scene_solids.h"

namespace icome::render {

/// Shapes and pictures on the graphics card, uploaded when they are first drawn and dropped when no version
/// of a scene has them any more. Lives in one context.
class SceneBuffers {
 public:
  const MeshView& view(const RenderShapePointer& shape);
  /// A coarser one for shadows, of large shapes.
  const MeshView& caster(const RenderShapePointer& shape);
  unsigned picture(const std::shared_ptr<const RenderPicture>& picture);

  SceneSolids& solids() { return solids_; }

  void drop_unused();

 private:
  struct ShapeEntry {
    std::weak_ptr<const RenderShape> shape;
    std::unique_ptr<MeshView> view;
    std::unique_ptr<MeshView> caster;
  };
  struct PictureEntry {
    std::weak_ptr<const RenderPicture> picture;
    GlObject texture;
  };

  ShapeEntry& entry(const RenderShapePointer& shape);

  std::unordered_map<const RenderShape*, ShapeEntry> shapes_;
  std::unordered_map<const RenderPicture*, PictureEntry> pictures_;
  SceneSolids solids_;
};

}  // namespace icome::render
