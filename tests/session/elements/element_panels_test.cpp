#include "session/elements/element_panels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "interaction/elements/element_samples.h"
#include "session/elements/scene_menu.h"

namespace icome::session {
namespace {

using base::Vector3;
using interaction::ElementFrame;
using interaction::LaidWidget;

const ElementFrame kTurned = {{0.3, -0.2, 0.5}, 0.6, 0.4, 2.5};

std::string daisy_toml(int count) {
  std::string toml = "kind = \"daisy\"\ntitle = \"All\"\n";
  for (int i = 0; i < count; ++i) toml += "[[item]]\nname = \"N" + std::to_string(i) + "\"\n";
  return toml;
}

TEST(ElementPanels, TilesOfADaisyLieOnItsSphereThoseBehindFirst) {
  const interaction::Element element = interaction::element_of(daisy_toml(30));
  interaction::ElementUse use(element, 0, interaction::even_letters());
  use.place(kTurned);
  const double radius = kTurned.size * use.layout().sheets.front().sphere->radius;
  const Vector3 middle = kTurned.centre - radius * kTurned.normal();
  for (const std::size_t under : {0U, 7U, 29U}) {
    const LaidWidget& laid = use.layout().widgets[under];
    use.point({double(under), kTurned.in_world(laid.centre) + 0.005 * kTurned.normal(), false});
    const auto parts = draw_parts(use, ElementTheme::Light, 2000.0);
    const auto panels = placed_parts(use, parts);
    double last = -1e9;
    int on_sphere = 0;
    for (const auto& panel : panels) {
      const double depth = (*panel.at - kTurned.centre).dot(kTurned.normal());
      EXPECT_GE(depth, last - 1e-12);
      last = depth;
      const bool is_tile = std::abs((*panel.at - middle).norm() - radius) < 1e-9;
      on_sphere += is_tile ? 1 : 0;
      if (is_tile) {
        EXPECT_GT((*panel.at - middle).dot(kTurned.normal()), 0.0) << "those turned away are not to be read";
      }
    }
    EXPECT_EQ(panels.size(), std::size_t(1 + on_sphere));  // with the ball
    int in_front = 0;
    for (const LaidWidget& it : use.layout().widgets)
      in_front +=
          use.layout().sheets.front().sphere->angle_between(it.centre, use.front()) < 0.5 * std::numbers::pi
              ? 1
              : 0;
    EXPECT_EQ(on_sphere, in_front);
    // The tile under the hand is in front, upright, and of the size of its item.
    EXPECT_LT((*panels.back().at - kTurned.centre).norm(), 1e-12);
    EXPECT_LT(((*panels.back().lying)[0] - kTurned.size * laid.half.x() * kTurned.right()).norm(), 1e-12);
    EXPECT_LT(((*panels.back().lying)[1] - kTurned.size * laid.half.y() * kTurned.up()).norm(), 1e-12);
    EXPECT_EQ(panels.back().picture, parts[1 + under].picture);
  }
}

TEST(SceneMenu, ADaisyIsMovedWithoutDrawingItAnew) {
  SceneMenu menu;
  menu.open(interaction::element_of(daisy_toml(12)), 0, interaction::even_letters(), kTurned);
  const auto& laid = menu.use()->layout().widgets;
  const auto at = [&](double share) {
    const Vector3 tip = kTurned.in_world(laid[1].centre * share) + 0.01 * kTurned.normal();
    const MenuTick tick{0, {share, tip, false}};
    menu.take({&tick, 1}, share);
  };
  at(1.0);
  ASSERT_TRUE(menu.draw(ElementTheme::Light));
  const auto before = menu.panels();
  at(1.02);
  ASSERT_TRUE(menu.draw(ElementTheme::Light));
  ASSERT_EQ(menu.panels().size(), before.size());
  EXPECT_EQ(menu.panels().back().picture, before.back().picture);
  EXPECT_GT((*menu.panels().back().at - *before.back().at).norm(), 1e-6);
}

TEST(SceneMenu, TheEyeChoosesWhenTheHandsButtonIsReleased) {
  SceneMenu menu;
  menu.open(interaction::element_of(
                "[choosing]\nby = \"look\"\n[[item]]\nname = \"One\"\n[[item]]\nname = \"Two\"\n"),
            0, interaction::even_letters(), kTurned);
  ASSERT_TRUE(menu.is_looked_at());
  const Vector3 eye = kTurned.centre + 1.3 * kTurned.normal();
  const auto way = [&](std::size_t item) {
    return interaction::Ray{eye,
                            (kTurned.in_world(menu.use()->layout().widgets[item].centre) - eye).normalized()};
  };
  double time = 0.0;
  // The hand itself is far away.
  const auto look = [&](std::size_t item, bool button) -> std::string {
    const MenuTick tick{1, {time += 0.02, Vector3::Constant(5.0), button}};
    const auto chosen = menu.look(way(item), {&tick, 1}, time);
    return chosen.empty() ? "" : chosen.front().widget.name;
  };
  EXPECT_EQ(look(0, true), "");
  EXPECT_EQ(menu.hand(), std::size_t(1));
  EXPECT_EQ(look(1, true), "");
  EXPECT_EQ(menu.use()->lit()->name, "Two");
  EXPECT_EQ(look(1, false), "Two");
  EXPECT_EQ(look(1, false), "");
  EXPECT_FALSE(menu.follow(time)) << "hands do not feel it";
  // The mouse stands for the eye until that looks elsewhere.
  menu.point_by_mouse(way(0), false, time += 0.02);
  menu.look(way(1), {}, time += 0.02);
  EXPECT_EQ(menu.use()->lit()->name, "One");
  menu.point_by_mouse(way(0), true, time += 0.02);
  EXPECT_EQ(menu.point_by_mouse(way(0), false, time += 0.02)->widget.name, "One");
  menu.look({eye, (kTurned.in_world({0.0, 0.001}) - eye).normalized()}, {}, time += 0.02);
  menu.look(way(1), {}, time += 0.02);
  EXPECT_EQ(menu.use()->lit()->name, "Two");
  EXPECT_TRUE(menu.draw(ElementTheme::Dark));
  EXPECT_FALSE(menu.panels().back().at);  // the mark in the middle of the picture
}

}  // namespace
}  // namespace icome::session
