#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "charts/image.h"
#include "cutout/synth/motion.h"

namespace icome::cutout {

/// Colour in linear light: blue, green, red, each from 0 (none) to 1 (white paper in full light).
using LinearColour = std::array<float, 3>;

/// The colour that a screen shows of red, green and blue from 0 to 255, in linear light.
LinearColour linear_colour(double red, double green, double blue);

/// A point of a hand or its sleeve: distance from the outline (mm, below zero inside) and colour.
struct HandPoint {
  double distance = 1e9;
  LinearColour colour = {};
};

/// A hand seen from above, in its own frame: the origin between the tips of thumb and forefinger, x along the
/// arm towards them, y to the thumb's other side; mm.
class HandShape {
 public:
  virtual ~HandShape() = default;
  virtual HandPoint at(const base::Vector2& mm) const = 0;
};

/// Fingers, palm, arm, a dark watch and a blue sleeve. `skin` chooses its tone.
std::unique_ptr<HandShape> drawn_hand(int skin);
/// A photo with opacity, whose arm leaves it at the side with the most of it; a blue sleeve goes on from
/// there.
std::unique_ptr<HandShape> photo_hand(charts::Image photo);

/// The skin tone of that number.
LinearColour skin_tone(int number);

/// Place of a point of the table in the hand's own frame.
base::Vector2 in_hand(const SyntheticHand& hand, const base::Vector2& mm);

}  // namespace icome::cutout
