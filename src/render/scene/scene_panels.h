#pragma once
#include <cstdint>
#include <memory>
#include <unordered_map>

#include "render/scene/scene_programs.h"
#include "render/scene/scene_renderer.h"

namespace icome::render {

/// The panels to be drawn: those that lie in the scene, or all others. Markers come between them, so that a
/// hand is seen before an element.
enum class PanelLayer : std::uint8_t { InScene, OverAll };

/// Draws the panels of overlays. Keeps their pictures on the graphics card until nobody has them any more.
class ScenePanels {
 public:
  /// `camera` is of the whole picture.
  base::Result<void> draw(const SceneOverlay& overlay, PanelLayer layer, const Camera& camera,
                          const SceneTarget& target, ScenePrograms& programs);

 private:
  struct Entry {
    std::weak_ptr<const charts::Image> picture;
    GlObject texture;
  };
  unsigned texture(const std::shared_ptr<const charts::Image>& picture);

  std::unordered_map<const charts::Image*, Entry> entries_;
  GlObject no_arrays_{GlObject::Kind::VertexArray};
};

}  // namespace icome::render
