#pragma once
#include <memory>
#include <optional>
#include <unordered_map>

#include "render/csg/csg_view.h"
#include "render/gl/gl_context.h"
#include "render/model/render_shape.h"
#include "render/scene/scene_plan.h"
#include "render/scene/scene_targets.h"

namespace icome::render {

/// The way in which CSG solids are drawn.
enum class CsgWay {
  Automatic,  ///< whichever is faster
  Images,     ///< from images of their operands, wherever the driver can
  Triangles
};

/// CSG solids on the graphics card, uploaded when they are first drawn and dropped when no version of a scene
/// has them any more. Lives in one context.
class SceneSolids {
 public:
  /// `pixels` are those of the picture.
  void set_rule(CsgWay way, double pixels);

  /// The view that draws the item from images; null where its triangles are drawn.
  const CsgView* images(const PlannedItem& planned);
  /// The view that draws its shadow from images, as its triangles lack parts; null where they are all there.
  const CsgView* shadow_images(const PlannedItem& planned);

  void drop_unused();

  unsigned no_arrays() const { return no_arrays_.name(); }

  SceneCanvas depths;  ///< of solids, or those that are put aside while one is drawn
  SceneCanvas shadow;  ///< of solids, one map

 private:
  struct Entry {
    std::weak_ptr<const RenderShape> shape;
    std::unique_ptr<CsgView> view;
  };

  bool is_able();
  bool prefers_images(const PlannedItem& planned) const;
  const CsgView& view(const RenderShapePointer& shape);

  CsgWay way_ = CsgWay::Automatic;
  double pixels_ = 1.0;
  std::optional<ContextTraits> traits_;  // of the context, once asked for
  std::shared_ptr<const CsgImages> images_;
  std::unordered_map<const RenderShape*, Entry> views_;
  GlObject no_arrays_{GlObject::Kind::VertexArray};
};

}  // namespace icome::render
