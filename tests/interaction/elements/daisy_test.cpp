#include "interaction/elements/daisy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "interaction/elements/element_samples.h"
#include "repeats.h"

namespace icome::interaction {
namespace {

using base::Vector3;

Element daisy_of(std::size_t count, std::size_t letters = 4) {
  Element element;
  element.kind = ElementKind::Daisy;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = std::to_string(i);
    element.widgets.push_back({.name = name, .text = {std::string(letters, 'm') + name}});
  }
  return element;
}

Vector2 any_place(base::Random& random, double reach) {
  const double angle = random.uniform(0.0, 2.0 * std::numbers::pi), length = random.uniform(0.0, reach);
  return length * Vector2(std::cos(angle), std::sin(angle));
}

TEST(DaisySphere, APlaceLiesAsFarAlongTheSphereAsOnTheSheet) {
  base::Random random(1);
  for (int i = 0; i < 10'000; ++i) {
    const DaisySphere sphere{random.uniform(0.01, 0.2), 0.4};
    const Vector2 place = any_place(random, 3.1 * sphere.radius);
    const Vector3 direction = sphere.turn_to(place) * Vector3::UnitZ();
    EXPECT_NEAR(std::acos(std::clamp(direction.z(), -1.0, 1.0)), place.norm() / sphere.radius, 1e-7);
    // In the same direction from the front.
    EXPECT_NEAR(direction.x() * place.y() - direction.y() * place.x(), 0.0, 1e-12);
    EXPECT_GE(direction.head<2>().dot(place), 0.0);
  }
}

TEST(DaisySphere, TheTileUnderTheHandStandsUprightInFront) {
  base::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const DaisySphere sphere{0.05, 0.4};
    const Vector2 place = any_place(random, 0.15);
    const base::Pose pose = sphere.tile_at(place, place);
    EXPECT_TRUE(pose.linear().isApprox(base::Matrix3::Identity(), 1e-12));
    EXPECT_LT(pose.translation().norm(), 1e-12);
    // Wherever it is turned, it touches the sphere, which lies behind the sheet.
    const base::Pose other = sphere.tile_at(place, any_place(random, 0.15));
    const Vector3 from_middle = other.translation() - Vector3(0.0, 0.0, -sphere.radius);
    EXPECT_NEAR(from_middle.norm(), sphere.radius, 1e-12);
    EXPECT_NEAR(from_middle.dot(other.linear().col(2)), sphere.radius, 1e-12);
  }
}

/// Distance of a point in front of a tile's plane, and its place on it.
bool lies_on(const base::Pose& tile, const Vector2& half, const Vector3& point, double before) {
  const Vector3 there = tile.inverse() * point;
  return std::abs(there.z()) < before && std::abs(there.x()) < half.x() && std::abs(there.y()) < half.y();
}

TEST(DaisyLayout, NoTileLiesOverAnother) {
  base::Random random(3);
  for (const std::size_t count : {1U, 2U, 5U, 12U, 40U, 120U}) {
    const Element element = daisy_of(count, 1 + count % 7);
    const ElementLayout layout = lay_out(element, 0, even_letters());
    ASSERT_EQ(layout.widgets.size(), count);
    const DaisySphere& sphere = *layout.sheets.front().sphere;
    std::vector<base::Pose> tiles;
    for (const LaidWidget& it : layout.widgets) {
      EXPECT_LE(it.centre.norm(), kDaisyReach * sphere.radius + 1e-12);
      tiles.push_back(sphere.tile_at(it.centre, Vector2::Zero()));
    }
    // Points of each tile, moved onto the sphere, against all others, seen from the sphere's middle.
    for (std::size_t i = 0; i < count; ++i)
      for (int k = 0; k < repeats(200); ++k) {
        const Vector2 half = layout.widgets[i].half;
        const Vector3 point =
            tiles[i] * Vector3(random.uniform(-half.x(), half.x()), random.uniform(-half.y(), half.y()), 0.0);
        for (std::size_t j = 0; j < count; ++j) {
          if (j == i) continue;
          EXPECT_FALSE(lies_on(tiles[j], layout.widgets[j].half, point, 0.2 * sphere.radius))
              << count << ": " << i << " over " << j;
        }
      }
  }
}

TEST(DaisyLayout, TheSphereGrowsWithItsItemsAndNoFurther) {
  double last = 0.0;
  for (const std::size_t count : {1U, 5U, 12U, 40U, 200U}) {
    const DaisyLayout layout = daisy_layout(count, {0.03, 0.01}, 0.0);
    EXPECT_GE(layout.radius, last);
    last = layout.radius;
    // Tiles cover a good part of what they may.
    const double cap = 2.0 * std::numbers::pi * (1.0 - std::cos(kDaisyReach)) * layout.radius * layout.radius;
    if (count >= 12) {
      EXPECT_GT(double(count) * 0.03 * 0.01 / cap, 0.4) << count;
    }
  }
  EXPECT_EQ(daisy_layout(5, {0.03, 0.01}, 0.5).radius, 0.5);
  EXPECT_EQ(daisy_layout(5, {0.03, 0.01}, 0.5).places.front(), Vector2::Zero());
}

TEST(DaisyUse, TheConeTakesTheNearestTile) {
  base::Random random(4);
  const Element element = daisy_of(30);
  const ElementLayout layout = lay_out(element, 0, even_letters());
  const DaisySphere& sphere = *layout.sheets.front().sphere;
  int none = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Vector2 place = any_place(random, 3.0 * sphere.radius);
    const Vector3 front = sphere.turn_to(place) * Vector3::UnitZ();
    const Widget* nearest = nullptr;
    double most = std::cos(sphere.cone);
    for (const LaidWidget& it : layout.widgets) {
      const double cosine = front.dot(sphere.turn_to(it.centre) * Vector3::UnitZ());
      if (cosine < most) continue;
      most = cosine;
      nearest = it.widget;
    }
    const LaidWidget* const found = layout.at(place);
    EXPECT_EQ(found == nullptr ? nullptr : found->widget, nearest);
    none += nearest == nullptr ? 1 : 0;
  }
  EXPECT_GT(none, 100);  // the back is bare
}

TEST(DaisyUse, TheHandTurnsItAndClicks) {
  const Element element = daisy_of(20);
  ElementUse use(element, 0, even_letters());
  double time = 0.0;
  for (const LaidWidget& it : use.layout().widgets) {
    const Vector3 tip = use.frame().in_world(it.centre) + 0.004 * Vector3::UnitZ();
    EXPECT_FALSE(use.point({time += 0.01, tip, false}));
    EXPECT_EQ(use.lit(), it.widget);
    EXPECT_NEAR((use.front() - it.centre).norm(), 0.0, 1e-12);
    const auto choice = use.point({time += 0.01, tip, true});
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->widget, it.widget);
    use.point({time += 0.01, tip, false});
  }
  // A hand that leaves does not turn it; keys do.
  const Vector2 left = use.front();
  use.point({time += 0.01, Vector3(0.0, 0.0, 0.5), false});
  EXPECT_EQ(use.front(), left);
  use.press(ElementKey::Down);
  ASSERT_NE(use.lit(), nullptr);
  const auto& laid = use.layout().widgets;
  const auto lit = std::ranges::find(laid, use.lit(), &LaidWidget::widget);
  EXPECT_EQ(lit->centre, use.front());
}

TEST(DaisyFile, TellsWhatDoesNotFitOnIt) {
  const auto slider = read_element(
      "kind = \"daisy\"\n[[item]]\nname = \"Size\"\nkind = \"slider\"\n[[item]]\nkind = \"separator\"\n",
      "d.toml");
  ASSERT_FALSE(slider);
  EXPECT_NE(slider.error().message.find("not 'Size'"), std::string::npos) << slider.error().message;
  std::string many = "kind = \"daisy\"\n";
  for (int i = 0; i < 201; ++i) many += "[[item]]\nname = \"n" + std::to_string(i) + "\"\n";
  const auto crowd = read_element(many, "d.toml");
  ASSERT_FALSE(crowd);
  EXPECT_NE(crowd.error().message.find("200 items at most, not 201"), std::string::npos);
  EXPECT_FALSE(read_element("kind = \"daisy\"\ncone_deg = 0\n[[item]]\nname = \"a\"\n", "d.toml"));
  const Element wide =
      element_of("kind = \"daisy\"\ncone_deg = 90\nradius_m = 0.3\n[[item]]\nname = \"a\"\n");
  EXPECT_NEAR(wide.cone, 0.5 * std::numbers::pi, 1e-12);
  EXPECT_EQ(lay_out(wide, 0, even_letters()).sheets.front().sphere->radius, 0.3);
}

}  // namespace
}  // namespace icome::interaction
