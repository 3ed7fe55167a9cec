#include "interaction/elements/colour_wheel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "repeats.h"

namespace icome::interaction {
namespace {

constexpr double kFullCircle = 2.0 * std::numbers::pi;

ColourWheel some_wheel() {
  ColourWheel wheel;
  wheel.centre = {0.013, -0.02};
  wheel.outer = 0.03;
  wheel.inner = 0.0225;
  wheel.corner = 0.0205;
  return wheel;
}

Hsv random_hsv(base::Random& random) {
  return {random.uniform(0.0, kFullCircle), random.uniform(0.0, 1.0), random.uniform(0.0, 1.0)};
}

/// The hexagon of full hues, from corner to corner by straight lines, and from there to white and black: the
/// definition of Smith (1978) without its formulas.
world::Colour by_the_hexagon(const Hsv& hsv) {
  constexpr double kCorners[7][3] = {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, 1},
                                     {0, 0, 1}, {1, 0, 1}, {1, 0, 0}};
  const double sixth = 6.0 * hsv.hue / kFullCircle;
  const int corner = std::min(5, int(sixth));
  world::Colour colour;
  for (std::size_t i = 0; i < 3; ++i) {
    const double full =
        kCorners[corner][i] + (sixth - corner) * (kCorners[corner + 1][i] - kCorners[corner][i]);
    colour[i] = float(hsv.value * (1.0 + hsv.saturation * (full - 1.0)));
  }
  return colour;
}

double apart(const world::Colour& a, const world::Colour& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::abs(double(a[i]) - double(b[i])));
  return most;
}

TEST(ColourWheel, ColoursAreThoseOfTheHexagon) {
  base::Random random(1);
  for (int i = 0; i < repeats(100'000); ++i) {
    const Hsv hsv = random_hsv(random);
    ASSERT_LT(apart(rgb_of(hsv), by_the_hexagon(hsv)), 1e-6);
  }
  EXPECT_EQ(colour_text(rgb_of({kFullCircle / 3.0, 1.0, 1.0})), "#00ff00");
  EXPECT_EQ(colour_text({1.0F, 0.5F, 0.0F}), "#ff8000");
}

// Colour, its two places, and what those places say of another colour.
TEST(ColourWheel, EveryColourComesBackFromItsPlaces) {
  base::Random random(2);
  const ColourWheel wheel = some_wheel();
  for (int i = 0; i < repeats(100'000); ++i) {
    world::Colour colour;
    for (float& part : colour)
      part = i % 4 == 0 ? float(random.index(256)) / 255.0F : float(random.uniform(0.0, 1.0));
    if (i % 50 == 0) colour[1] = colour[2] = colour[0];  // grey
    if (i % 500 == 0) colour = {};
    const Hsv hsv = hsv_of(colour, random_hsv(random));
    ASSERT_EQ(wheel.part_at(wheel.place_of_hue(hsv.hue)), ColourWheel::Part::Ring);
    const Hsv turned = wheel.with_hue_at(random_hsv(random), wheel.place_of_hue(hsv.hue));
    const Hsv back = wheel.with_shade_at(turned, wheel.place_of_shade(hsv));
    ASSERT_LT(apart(rgb_of(back), colour), 1.0 / 255.0 - 1e-9) << colour_text(colour);
    ASSERT_LT(apart(rgb_of(back), colour), 1e-5) << colour_text(colour);
  }
}

TEST(ColourWheel, TheTriangleMixesTheColoursOfItsCorners) {
  base::Random random(3);
  const ColourWheel wheel = some_wheel();
  const auto corners = wheel.corners();
  for (int i = 0; i < repeats(20'000); ++i) {
    const Hsv hsv = random_hsv(random);
    double a = random.uniform(0.0, 1.0), b = random.uniform(0.0, 1.0);
    if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
    const Vector2 place = a * corners[0] + b * corners[1] + (1.0 - a - b) * corners[2];
    const world::Colour full = by_the_hexagon({hsv.hue, 1.0, 1.0});
    world::Colour mixed;
    for (std::size_t k = 0; k < 3; ++k) mixed[k] = float(a * full[k] + b);
    ASSERT_LT(apart(rgb_of(wheel.with_shade_at(hsv, place)), mixed), 1e-5);
  }
}

TEST(ColourWheel, PlacesNextToEachOtherHaveColoursNextToEachOther) {
  base::Random random(4);
  const ColourWheel wheel = some_wheel();
  constexpr double kStep = 1e-6;  // m
  for (int i = 0; i < repeats(50'000); ++i) {
    const Hsv hsv = random_hsv(random);
    const Vector2 place =
        wheel.centre + 1.2 * wheel.outer * Vector2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    const double way = random.uniform(0.0, kFullCircle);
    const Vector2 beside = place + kStep * Vector2(std::cos(way), std::sin(way));
    // From a corner to the opposite side, 1.5 corners away, a part changes by 1.
    const double shade =
        apart(rgb_of(wheel.with_shade_at(hsv, place)), rgb_of(wheel.with_shade_at(hsv, beside)));
    ASSERT_LT(shade, 2.0 * kStep / (1.5 * wheel.corner) + 1e-6);
    const double r = (place - wheel.centre).norm();
    if (r < 0.1 * wheel.outer) continue;
    const Hsv full{0.0, 1.0, 1.0};
    const double hue = apart(rgb_of(wheel.with_hue_at(full, place)), rgb_of(wheel.with_hue_at(full, beside)));
    ASSERT_LT(hue, 6.0 * 1.01 * kStep / (r * kFullCircle) + 1e-6);
  }
}

/// Is a place left of all sides of a triangle, or right of all?
bool in_triangle(const std::array<Vector2, 3>& corners, const Vector2& place) {
  int left = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2 side = corners[(i + 1) % 3] - corners[i], way = place - corners[i];
    left += side.x() * way.y() - side.y() * way.x() > 0.0 ? 1 : 0;
  }
  return left == 0 || left == 3;
}

TEST(ColourWheel, PartsAndDistancesAreThoseOfTheirShapes) {
  base::Random random(5);
  const ColourWheel wheel = some_wheel();
  const auto corners = wheel.corners();
  for (int i = 0; i < repeats(20'000); ++i) {
    const Vector2 place =
        wheel.centre + 1.2 * wheel.outer * Vector2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    const double r = std::hypot(place.x() - wheel.centre.x(), place.y() - wheel.centre.y());
    const bool inside = in_triangle(corners, place);
    const auto part = wheel.part_at(place);
    ASSERT_EQ(part == ColourWheel::Part::Ring, r >= wheel.inner && r <= wheel.outer);
    ASSERT_EQ(part == ColourWheel::Part::Triangle, r < wheel.inner);
    // The nearest of many places of the border.
    double nearest = 1.0;
    for (std::size_t side = 0; side < 3; ++side) {
      const Vector2 from = corners[side] - place, way = corners[(side + 1) % 3] - corners[side];
      const double x = from.x(), y = from.y(), along_x = way.x(), along_y = way.y();
      for (double share = 0.0; share < 1.0; share += 0.005)
        nearest = std::min(nearest, std::hypot(x + share * along_x, y + share * along_y));
    }
    ASSERT_NEAR(std::abs(wheel.outside_triangle(place)), nearest, 1.5e-4);
    ASSERT_EQ(wheel.outside_triangle(place) <= 0.0, inside);
  }
}

TEST(ColourWheel, BlackAndGreyKeepTheHueThatTheyHad) {
  const ColourWheel wheel = some_wheel();
  const Hsv colour{2.0, 0.7, 0.8};
  const Hsv black = wheel.with_shade_at(colour, wheel.corners()[2]);
  EXPECT_EQ(colour_text(rgb_of(black)), "#000000");
  EXPECT_EQ(black.hue, 2.0);
  EXPECT_EQ(hsv_of({0.0F, 0.0F, 0.0F}, colour).saturation, 0.7);
  EXPECT_EQ(hsv_of({0.5F, 0.5F, 0.5F}, colour).hue, 2.0);
}

}  // namespace
}  // namespace icome::interaction
