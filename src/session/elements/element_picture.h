#pragma once
#include <cstdint>
#include <string>

#include "charts/image.h"
#include "interaction/elements/element_use.h"

namespace icome::session {

enum class ElementTheme : std::uint8_t { Light, Dark, HighContrast };

// All pictures are sRGB, premultiplied, and clear round their border. `resolution` is in pixels a metre, > 0;
// it is lowered where a picture would have a side above 4096 pixels.

/// The letters of an element's texts in one of its languages that no font of this desktop has, each once: its
/// pictures show boxes for them.
std::string letters_without_font(const interaction::Element& element, std::size_t language);

/// A sheet of an element as it is now, lit, ticked and set.
charts::Image draw_sheet(const interaction::ElementUse& use, std::size_t sheet, ElementTheme theme,
                         double resolution);

/// A widget that lies by itself, such as on the sphere of a daisy.
charts::Image draw_tile(const interaction::ElementUse& use, const interaction::LaidWidget& laid,
                        ElementTheme theme, double resolution);

/// The ball of a daisy, without what lies on it. Precondition: the element is one.
charts::Image draw_ball(const interaction::ElementUse& use, ElementTheme theme, double resolution);
/// Half the width and height of that picture, m in the element's plane; the ball is in its middle.
interaction::Vector2 half_of_ball(const interaction::ElementUse& use);

/// A mark for the place where the eye looks.
charts::Image draw_look_mark(ElementTheme theme);

}  // namespace icome::session
