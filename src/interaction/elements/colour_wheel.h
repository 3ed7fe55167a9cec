#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "base/vector.h"
#include "world/shape/fixture.h"

namespace icome::interaction {

using base::Vector2;

/// A colour as hue, saturation and value (Smith 1978).
struct Hsv {
  double hue = 0.0;                      // rad, 0 ... 2 pi; 0: red, a third of a turn on: green
  double saturation = 0.0, value = 0.0;  // 0 ... 1

  bool operator==(const Hsv&) const = default;
};

/// A colour whose hue is seen when it is turned: a grey or black becomes the full hue.
Hsv with_seen_hue(const Hsv& colour);

world::Colour rgb_of(const Hsv& colour);
/// Greys have no hue, and black no saturation: these are taken from `otherwise`.
Hsv hsv_of(const world::Colour& colour, const Hsv& otherwise = {});
/// "#rrggbb".
std::string colour_text(const world::Colour& colour);

/// The usual picker of colours: a ring of hues, clockwise from red at the top, round a triangle whose corners
/// are the full hue (top), white (lower left) and black (lower right). The triangle does not turn with the
/// hue, so that a hand finds each shade where it was. Lengths in m, in the plane of the element.
struct ColourWheel {
  Vector2 centre = Vector2::Zero();
  double inner = 0.0, outer = 0.0;  // radii of the ring
  double corner = 0.0;              // distance of the triangle's corners from the centre, <= inner

  enum class Part : std::uint8_t { None, Ring, Triangle };

  /// What is between the triangle and the ring stands for the nearest shade.
  Part part_at(const Vector2& place) const;
  std::array<Vector2, 3> corners() const;
  /// Distance from the triangle, < 0 inside.
  double outside_triangle(const Vector2& place) const;
  /// In the middle of the ring.
  Vector2 place_of_hue(double hue) const;
  /// In the triangle.
  Vector2 place_of_shade(const Hsv& colour) const;
  /// The colour with the hue in that direction; unchanged at the centre.
  Hsv with_hue_at(Hsv colour, const Vector2& place) const;
  /// The colour with the saturation and value at that place, or, outside the triangle, at the nearest one.
  Hsv with_shade_at(Hsv colour, const Vector2& place) const;
};

}  // namespace icome::interaction
