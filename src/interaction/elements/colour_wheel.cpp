#include "interaction/elements/colour_wheel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace icome::interaction {
namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;
constexpr double kNoHue = 1e-9;  // share of a shade below which it has none

double in_circle(double angle) { return angle - kWholeTurn * std::floor(angle / kWholeTurn); }

Vector2 from_top(double angle) { return {std::sin(angle), std::cos(angle)}; }

/// The shares of the corners at a place, of which the sum is 1.
std::array<double, 3> shares_at(const std::array<Vector2, 3>& corners, const Vector2& place) {
  const Vector2 a = corners[1] - corners[0], b = corners[2] - corners[0], p = place - corners[0];
  const double area = a.x() * b.y() - a.y() * b.x();
  const double second = (p.x() * b.y() - p.y() * b.x()) / area;
  const double third = (a.x() * p.y() - a.y() * p.x()) / area;
  return {1.0 - second - third, second, third};
}

Vector2 nearest_on_side(const Vector2& from, const Vector2& to, const Vector2& place) {
  const Vector2 way = to - from;
  return from + std::clamp((place - from).dot(way) / way.squaredNorm(), 0.0, 1.0) * way;
}

Vector2 nearest_in(const std::array<Vector2, 3>& corners, const Vector2& place) {
  if (std::ranges::min(shares_at(corners, place)) >= 0.0) return place;
  Vector2 nearest = corners[0];
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2 on_side = nearest_on_side(corners[i], corners[(i + 1) % 3], place);
    if ((place - on_side).squaredNorm() < (place - nearest).squaredNorm()) nearest = on_side;
  }
  return nearest;
}

}  // namespace

world::Colour rgb_of(const Hsv& colour) {
  const auto part = [&](double ahead) {
    const double sixth = std::fmod(6.0 * colour.hue / kWholeTurn + ahead, 6.0);
    const double lacks = std::clamp(std::min(sixth, 4.0 - sixth), 0.0, 1.0);
    return float(colour.value * (1.0 - colour.saturation * lacks));
  };
  return {part(5.0), part(3.0), part(1.0)};
}

Hsv hsv_of(const world::Colour& colour, const Hsv& otherwise) {
  const double r = colour[0], g = colour[1], b = colour[2];
  const double most = std::max({r, g, b}), range = most - std::min({r, g, b});
  Hsv hsv{otherwise.hue, most > 0.0 ? range / most : otherwise.saturation, most};
  if (range <= 0.0) return hsv;
  double sixth = 0.0;
  if (most == r) {
    sixth = (g - b) / range;
  } else if (most == g) {
    sixth = 2.0 + (b - r) / range;
  } else {
    sixth = 4.0 + (r - g) / range;
  }
  hsv.hue = in_circle(sixth / 6.0 * kWholeTurn);
  return hsv;
}

Hsv with_seen_hue(const Hsv& colour) {
  constexpr double kGrey = 0.02;  // of the strongest channel, from the weakest
  return colour.saturation * colour.value < kGrey ? Hsv{colour.hue, 1.0, 1.0} : colour;
}

std::string colour_text(const world::Colour& colour) {
  const auto byte = [&](std::size_t i) {
    return std::lround(255.0 * std::clamp(double(colour[i]), 0.0, 1.0));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(0), byte(1), byte(2));
}

std::array<Vector2, 3> ColourWheel::corners() const {
  return {centre + corner * from_top(0.0), centre + corner * from_top(2.0 / 3.0 * kWholeTurn),
          centre + corner * from_top(1.0 / 3.0 * kWholeTurn)};
}

ColourWheel::Part ColourWheel::part_at(const Vector2& place) const {
  const double r = (place - centre).norm();
  if (r > outer) return Part::None;
  return r >= inner ? Part::Ring : Part::Triangle;
}

double ColourWheel::outside_triangle(const Vector2& place) const {
  const auto all = corners();
  const Vector2 nearest = nearest_in(all, place);
  if (nearest != place) return (nearest - place).norm();
  // A share falls from 1 to 0 over the triangle's height.
  return -1.5 * corner * std::ranges::min(shares_at(all, place));
}

Vector2 ColourWheel::place_of_hue(double hue) const { return centre + 0.5 * (inner + outer) * from_top(hue); }

Vector2 ColourWheel::place_of_shade(const Hsv& colour) const {
  const auto [full, white, black] = corners();
  return colour.saturation * colour.value * full + (1.0 - colour.saturation) * colour.value * white +
         (1.0 - colour.value) * black;
}

Hsv ColourWheel::with_hue_at(Hsv colour, const Vector2& place) const {
  const Vector2 away = place - centre;
  if (away.norm() > 0.0) colour.hue = in_circle(std::atan2(away.x(), away.y()));
  return colour;
}

Hsv ColourWheel::with_shade_at(Hsv colour, const Vector2& place) const {
  const auto all = corners();
  const auto [full, white, black] = shares_at(all, nearest_in(all, place));
  colour.value = std::clamp(1.0 - black, 0.0, 1.0);
  if (full + white > kNoHue) colour.saturation = std::clamp(full / (full + white), 0.0, 1.0);
  return colour;
}

}  // namespace icome::interaction
