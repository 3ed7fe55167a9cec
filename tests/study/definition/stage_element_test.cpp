#include "study/definition/stage_element.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "base/random.h"
#include "charts/lettering.h"
#include "study/trial_menus.h"
#include "study/trial_scenes.h"

namespace icome::study {
namespace {

using base::Vector3;

SceneElement element_of(const std::string& file) { return {"menu", file, {}, {}, {}}; }

TEST(StageElement, IsWhereTheStudyPutsIt) {
  const TemplateFolder folder("menu");
  SceneElement element = element_of("scenes/colour-menu.toml");
  element.centre = Vector3(0.1, 0.2, 0.3);
  element.turn = 0.5;
  const auto read = read_stage_element(element, folder.path());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->element->centre, Vector3(0.1, 0.2, 0.3));
  EXPECT_EQ(read->element->turn, 0.5);
  EXPECT_EQ(read->element->widgets.size(), 7U);
  EXPECT_TRUE(languages_lacking(*read, folder.study()).empty());
  EXPECT_EQ(interaction::language_of(*read->element, "nl"), 1U);
  EXPECT_EQ(interaction::language_of(*read->element, "fr"), 0U);
}

TEST(StageElement, OneThatDoesNotLieInTheWorldIsRefused) {
  const TemplateFolder folder("menu");
  std::ofstream(folder.path() / "head.toml") << "at = \"head\"\n[[item]]\nname = \"a\"\n";
  const auto head = read_stage_element(element_of("head.toml"), folder.path());
  ASSERT_FALSE(head);
  EXPECT_NE(head.error().message.find("at = \"world\""), std::string::npos) << head.error().message;
  const auto gone = read_stage_element(element_of("gone.toml"), folder.path());
  ASSERT_FALSE(gone);
  EXPECT_NE(gone.error().message.find("gone.toml"), std::string::npos);
}

/// Equations 5.2 and 5.6 by general formulas, of a plane through three points (5.7.2, corrected): its normal
/// is their cross product, and the projection is the foot of the perpendicular.
bool is_near_by_hand(const Vector3& centre, double alpha, const base::Vector2& half, double margin,
                     const Vector3& place, double distance) {
  const Vector3 up = (centre + Vector3(0, 1, 0)) - centre;
  const Vector3 along =
      Vector3(centre.x() + std::cos(alpha), centre.y(), centre.z() + std::sin(alpha)) - centre;
  const Vector3 normal = along.cross(up);
  const double far = std::abs(normal.dot(place - centre)) / normal.norm();
  const Vector3 foot = place - normal * (normal.dot(place - centre) / normal.squaredNorm());
  const double x = (foot - centre).dot(along) / along.norm(), y = foot.y() - centre.y();
  return far <= distance && std::abs(x) <= half.x() + margin && std::abs(y) <= half.y() + margin;
}

TEST(StageElement, VicinityIsTheThesissByBruteForce) {
  base::Random random(22);
  int near = 0;
  for (int i = 0; i < 20'000; ++i) {
    interaction::Element element = two_items();
    for (int axis = 0; axis < 3; ++axis) element.centre[axis] = random.uniform(-0.1, 0.1);
    element.turn = i % 5 == 0 ? double(i % 3 - 1) * std::numbers::pi / 2.0 : random.uniform(-3.1, 3.1);
    const interaction::ElementUse use(element, 0, charts::line_width);
    const base::Vector2 half = use.layout().sheets.front().half;
    Vector3 place = element.centre;
    for (int axis = 0; axis < 3; ++axis) place[axis] += random.uniform(-0.06, 0.06);
    const double distance = random.uniform(0.005, 0.05);
    const bool expected =
        is_near_by_hand(element.centre, element.turn, half, element.choosing.margin, place, distance);
    near += expected ? 1 : 0;
    ASSERT_EQ(is_in_vicinity(use, place, distance), expected) << i;
  }
  EXPECT_GT(near, 300);
}

}  // namespace
}  // namespace icome::study
