#pragma once
#include <optional>
#include <vector>

#include "render/scene/scene_renderer.h"
#include "session/elements/element_picture.h"

namespace icome::session {

/// A part of an element that is drawn by itself: a sheet or, of a daisy, its ball or one of its tiles.
struct ElementPart {
  std::shared_ptr<const charts::Image> picture;
  std::size_t sheet = 0;
  std::optional<std::size_t> tile = {};  // of the layout's widgets
};

/// Draws all parts of an element as they are now.
std::vector<ElementPart> draw_parts(const interaction::ElementUse& use, ElementTheme theme,
                                    double resolution);

/// Puts the parts where they lie in the scene, with the element's opacity, those behind others first.
std::vector<render::SceneOverlay::Panel> placed_parts(const interaction::ElementUse& use,
                                                      const std::vector<ElementPart>& parts);

/// Both at once.
std::vector<render::SceneOverlay::Panel> panels_of(const interaction::ElementUse& use, ElementTheme theme,
                                                   double resolution);

}  // namespace icome::session
