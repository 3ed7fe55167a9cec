#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "charts/image.h"
#include "interaction/elements/element_use.h"
#include "render/scene/scene_renderer.h"

namespace icome::session {

enum class ElementTheme : std::uint8_t { Light, Dark, HighContrast };

/// A sheet of an element as it is now, lit, ticked and set: sRGB, premultiplied, clear round its border.
/// `resolution` in pixels a metre, > 0; it is lowered where the picture would have a side above 4096 pixels.
charts::Image draw_sheet(const interaction::ElementUse& use, std::size_t sheet, ElementTheme theme,
                         double resolution);

/// Puts the picture of a sheet where that lies in the scene, with the element's opacity.
void place_panel(const interaction::ElementUse& use, std::size_t sheet, render::SceneOverlay::Panel& panel);

/// All its sheets as they lie in the scene.
std::vector<render::SceneOverlay::Panel> panels_of(const interaction::ElementUse& use, ElementTheme theme,
                                                   double resolution);

}  // namespace icome::session
