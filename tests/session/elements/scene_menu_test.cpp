#include "session/elements/scene_menu.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "base/random.h"
#include "haptics/servo/servo.h"
#include "haptics/servo/servo_fixture.h"
#include "interaction/elements/element_samples.h"

namespace icome::session {
namespace {

using base::Vector2;
using base::Vector3;
using interaction::ElementFrame;

constexpr const char* kToml =
    "centre = [0, 0, 0]\n"
    "[[item]]\nname = \"One\"\n"
    "[[item]]\nname = \"Two\"\n"
    "[[item]]\nname = \"More\"\n[[item.item]]\nname = \"Deep\"\n"
    "[[item]]\nname = \"Tick\"\nkind = \"check\"\n";

/// Lists, numbers, a picker and pages, side by side with what there is to push else.
constexpr const char* kWidgets =
    "[[item]]\nname = \"Pages\"\nkind = \"tabs\"\n"
    "[[item.item]]\nname = \"Paint\"\n[[item.item.item]]\nname = \"Colour\"\nkind = \"colour\"\n"
    "[[item.item]]\nname = \"Rows\"\n[[item.item.item]]\nname = \"List\"\nkind = \"list\"\nrows = 4\n"
    "[[item.item.item.item]]\nname = \"a\"\n[[item.item.item.item]]\nname = \"b\"\nenabled = false\n"
    "[[item.item.item.item]]\nname = \"c\"\n[[item.item.item.item]]\nname = \"d\"\n"
    "[[item.item.item.item]]\nname = \"e\"\n[[item.item.item.item]]\nname = \"f\"\n"
    "[[item]]\nname = \"Number\"\nkind = \"number\"\n";

const ElementFrame kLeaning = {{0.3, -0.2, 0.5}, 0.6, 0.4, 2.5};

class MenuInScene {
 public:
  explicit MenuInScene(const ElementFrame& frame = kLeaning, const char* toml = kToml) {
    menu.open(interaction::element_of(toml), 0, interaction::even_letters(), frame);
  }

  Vector3 at(std::string_view name, double front) const {
    for (const interaction::LaidWidget& it : menu.use()->layout().widgets)
      if (it.widget->name == name) {
        const ElementFrame& frame = menu.use()->frame();
        return frame.in_world(it.centre) + front * frame.size * frame.normal();
      }
    return Vector3::Constant(std::nan(""));
  }
  /// One picture later, with all hands where they are.
  std::string pass(const std::map<std::size_t, std::pair<Vector3, bool>>& hands) {
    std::vector<MenuTick> ticks;
    for (int i = 0; i < 16; ++i) {
      time += 0.001;
      for (const auto& [hand, state] : hands) ticks.push_back({hand, {time, state.first, state.second}});
    }
    std::string chosen;
    for (const MenuChoice& it : menu.take(ticks, time)) chosen += it.widget.name + " ";
    return chosen;
  }

  SceneMenu menu;
  double time = 0.0;
};

TEST(SceneMenu, TheHandThatIsNearUsesIt) {
  MenuInScene scene;
  const Vector3 far = Vector3::Constant(9.0);
  EXPECT_EQ(scene.pass({{0, {far, false}}, {1, {far, true}}}), "");
  EXPECT_FALSE(scene.menu.hand());
  EXPECT_EQ(scene.pass({{0, {far, false}}, {1, {scene.at("One", 0.01), false}}}), "");
  EXPECT_EQ(scene.menu.hand(), std::size_t(1));
  EXPECT_EQ(scene.menu.use()->lit()->name, "One");
  // Another one that comes nearer does not take it away.
  const auto second = std::pair(scene.at("Two", 0.001), false);
  EXPECT_EQ(scene.pass({{0, second}, {1, {scene.at("One", 0.01), true}}}), "One ");
  EXPECT_EQ(scene.menu.hand(), std::size_t(1));
  EXPECT_EQ(scene.pass({{0, second}, {1, {far, false}}}), "");
  EXPECT_EQ(scene.menu.hand(), std::size_t(0));
  EXPECT_EQ(scene.menu.use()->lit()->name, "Two");
}

TEST(SceneMenu, AHandKeepsItWhileNoTickHasCome) {
  MenuInScene scene;
  scene.pass({{0, {scene.at("One", 0.01), false}}});
  EXPECT_TRUE(scene.menu.take({}, scene.time + 0.002).empty());
  EXPECT_EQ(scene.menu.hand(), std::size_t(0));
  EXPECT_EQ(scene.pass({{0, {scene.at("One", 0.01), true}}}), "One ");
  scene.menu.take({}, scene.time + 0.2);
  EXPECT_FALSE(scene.menu.hand());
}

TEST(SceneMenu, AHandThatComesWithItsButtonDownOrFromBehindChoosesNothing) {
  MenuInScene scene;
  EXPECT_EQ(scene.pass({{0, {scene.at("One", 0.01), true}}}), "");
  EXPECT_EQ(scene.pass({{0, {Vector3::Constant(9.0), false}}}), "");
  for (const double depth : {-0.015, -0.01, -0.005, 0.01})
    EXPECT_EQ(scene.pass({{0, {scene.at("One", depth), false}}}), "");
  EXPECT_EQ(scene.pass({{0, {scene.at("One", -0.004), false}}}), "One ");
}

TEST(SceneMenu, TheMouseClicksWhereItsWayMeetsASheet) {
  MenuInScene scene;
  const Vector3 eye = kLeaning.centre + 1.3 * kLeaning.normal() + Vector3(0.2, 0.1, 0.0);
  const auto way_to = [&](const char* name) {
    return interaction::Ray{eye, (scene.at(name, 0.0) - eye).normalized()};
  };
  const auto click = [&](const char* name) -> std::string {
    scene.menu.point_by_mouse(way_to(name), false, scene.time += 0.01);
    EXPECT_EQ(scene.menu.use()->lit()->name, name);
    const auto chosen = scene.menu.point_by_mouse(way_to(name), true, scene.time += 0.01);
    scene.menu.point_by_mouse(way_to(name), false, scene.time += 0.01);
    return chosen ? chosen->widget.name + (chosen->checked ? " on" : "") : "";
  };
  EXPECT_EQ(scene.menu.point_by_mouse(way_to("One"), true, scene.time += 0.01)->widget.name, "One")
      << "without a motion before";
  scene.menu.point_by_mouse(way_to("One"), false, scene.time += 0.01);
  EXPECT_EQ(click("Two"), "Two");
  EXPECT_EQ(click("Tick"), "Tick on");
  EXPECT_EQ(click("Tick"), "Tick");
  EXPECT_EQ(click("More"), "More");
  EXPECT_EQ(click("Deep"), "Deep");
  EXPECT_LT((*scene.menu.met_by(way_to("One")) - scene.at("One", 0.0)).norm(), 1e-12);
  EXPECT_FALSE(scene.menu.met_by({eye, (eye - scene.at("One", 0.0)).normalized()}));
  const interaction::Ray beside{eye, (kLeaning.in_world(Vector2(0.5, 0.0)) - eye).normalized()};
  EXPECT_FALSE(scene.menu.met_by(beside));
  EXPECT_FALSE(scene.menu.point_by_mouse(beside, true, scene.time += 0.01));
}

TEST(SceneMenu, FadesInForMouseAndKeysAndOutAgain) {
  MenuInScene scene;
  EXPECT_NEAR(scene.menu.use()->opacity(), 0.35, 1e-12);
  scene.menu.press(interaction::ElementKey::Down);
  for (int i = 0; i < 100; ++i) scene.pass({});
  EXPECT_GT(scene.menu.use()->opacity(), 0.999);
  EXPECT_EQ(scene.menu.press(interaction::ElementKey::Enter)->widget.name, "One");
  scene.pass({{0, {scene.at("One", 0.03), false}}});
  for (int i = 0; i < 100; ++i) scene.pass({{0, {Vector3::Constant(9.0), false}}});
  EXPECT_LT(scene.menu.use()->opacity(), 0.36);
}

TEST(SceneMenu, DrawsOnlyWhatHasChanged) {
  MenuInScene scene;
  EXPECT_TRUE(scene.menu.draw(ElementTheme::Light));
  ASSERT_EQ(scene.menu.panels().size(), 1U);
  const auto first = scene.menu.panels().front();
  const ElementFrame& frame = scene.menu.use()->frame();
  const Vector3 right = (*first.lying)[0], up = (*first.lying)[1];
  EXPECT_NEAR(right.norm(), 2.5 * scene.menu.use()->layout().sheets.front().half.x(), 1e-12);
  EXPECT_NEAR(right.dot(up), 0.0, 1e-15);
  EXPECT_GT(right.cross(up).dot(frame.normal()), 0.0);
  EXPECT_FALSE(scene.menu.draw(ElementTheme::Light));
  scene.pass({{0, {scene.at("One", 0.03), false}}});
  EXPECT_TRUE(scene.menu.draw(ElementTheme::Light)) << "it fades in";
  EXPECT_EQ(scene.menu.panels().front().picture, first.picture);
  scene.pass({{0, {scene.at("One", 0.01), false}}});
  EXPECT_TRUE(scene.menu.draw(ElementTheme::Light)) << "an item is lit";
  EXPECT_NE(scene.menu.panels().front().picture, first.picture);
  EXPECT_TRUE(scene.menu.draw(ElementTheme::Dark));
  scene.menu.enable([](const interaction::Widget& it) { return std::optional(it.name != "Two"); });
  EXPECT_TRUE(scene.menu.draw(ElementTheme::Dark));
  scene.menu.close();
  EXPECT_TRUE(scene.menu.draw(ElementTheme::Dark));
  EXPECT_TRUE(scene.menu.panels().empty());
}

TEST(SceneMenu, WhatIsDisabledCannotBeChosen) {
  MenuInScene scene;
  scene.menu.enable(
      [](const interaction::Widget& it) { return it.name == "One" ? std::optional(false) : std::nullopt; });
  EXPECT_FALSE(scene.menu.choose("One"));
  EXPECT_TRUE(scene.menu.choose("Two"));
  scene.menu.enable([](const interaction::Widget&) { return std::optional(true); });
  EXPECT_TRUE(scene.menu.choose("One"));
}

/// Carries a tip over menus that open, close and follow on each other, and gives the largest step of the
/// force.
double largest_step(const char* toml, double size, int ways) {
  haptics::ScriptedDevice device;
  haptics::Servo servo(device, {});
  ElementFrame frame = kLeaning;
  frame.size = size;
  MenuInScene scene(frame, toml);
  base::Random random(7);
  double time = 0.0, largest = 0.0;
  Vector3 last = Vector3::Zero(), from = frame.centre, force_sum = Vector3::Zero();
  for (int way = 0; way < ways; ++way) {
    const Vector2 place(random.uniform(-0.04, 0.04), random.uniform(-0.04, 0.04));
    const double depth = random.uniform(-0.012, 0.01);
    const Vector3 to = frame.in_world(place) + size * depth * frame.normal();
    if (way % 3 == 2) {
      scene.menu.close();
      if (way % 2 == 0) scene.menu.open(interaction::element_of(toml), 0, interaction::even_letters(), frame);
    }
    if (scene.menu.use() == nullptr && way % 3 == 1)
      scene.menu.open(interaction::element_of(toml), 0, interaction::even_letters(), frame);
    for (int i = 1; i <= 100; ++i) {
      time += 0.001;
      const Vector3 tip = from + (to - from) * (i / 100.0);
      device.velocity = (tip - device.position) / 0.001;
      device.position = tip;
      const haptics::TickReport& report = servo.tick(0.001);
      if (scene.menu.use() != nullptr)
        scene.menu.take(std::vector<MenuTick>{{0, {time, report.tip, i == 50 && way % 4 == 0}}}, time);
      if (scene.menu.follow(time)) servo.publish_effects(scene.menu.effects());
      largest = std::max(largest, (report.force - last).norm());
      force_sum += report.force.cwiseAbs();
      last = report.force;
    }
    from = to;
  }
  EXPECT_GT(force_sum.norm(), 0.0);
  return largest;
}

TEST(SceneMenu, OpensClosesAndFollowsWithoutAKick) {
  EXPECT_LT(largest_step(kToml, 1.0, 200), 0.5);
  EXPECT_LT(largest_step(kToml, 3.0, 200), 0.5);
}

TEST(SceneMenu, ScrollsTurnsPagesAndDragsWithoutAKick) {
  EXPECT_LT(largest_step(kWidgets, 1.0, 300), 0.5);
  EXPECT_LT(largest_step(kWidgets, 3.0, 300), 0.5);
}

/// The targets that are felt at a place of the first sheet.
std::vector<haptics::PanelTarget> targets_at(const SceneMenu& menu, const Vector2& place) {
  std::vector<haptics::PanelTarget> found;
  for (const haptics::PanelTarget& it : menu.effects().front().panel->targets)
    if (((place - it.centre).cwiseAbs().array() < it.half.array()).all()) found.push_back(it);
  return found;
}

TEST(SceneMenu, WhatIsFeltFollowsPagesRowsAndHue) {
  MenuInScene scene(kLeaning, kWidgets);
  const auto& use = *scene.menu.use();
  const auto widget = [&](const char* name) -> const interaction::Widget& {
    return *interaction::find_widget(use.element().widgets, name);
  };
  using Shape = haptics::PanelTarget::Shape;
  scene.menu.follow(0.0);
  const auto wheel = interaction::wheel_of(*use.layout().widget(widget("Colour")), use.element().text_height);
  const Vector2 red = wheel.place_of_hue(0.0), cyan = wheel.place_of_hue(3.0);
  ASSERT_EQ(targets_at(scene.menu, red).size(), 2U) << "the ring, and the well of its hue";
  EXPECT_EQ(targets_at(scene.menu, red)[0].shape, Shape::Ring);
  EXPECT_GT(targets_at(scene.menu, red)[1].well, 0.0);
  EXPECT_EQ(targets_at(scene.menu, cyan).size(), 1U);
  EXPECT_EQ(targets_at(scene.menu, wheel.centre)[1].shape, Shape::Triangle);
  // Another hue is pushed.
  const auto over = [&](const Vector2& place, double front) {
    return Vector3(kLeaning.in_world(place) + front * kLeaning.size * kLeaning.normal());
  };
  for (const double front : {0.01, -0.004}) scene.pass({{0, {over(cyan, front), false}}});
  EXPECT_EQ(scene.pass({{0, {over(cyan, 0.01), false}}}), "Colour ");
  EXPECT_TRUE(scene.menu.follow(0.1));
  EXPECT_EQ(targets_at(scene.menu, red).size(), 1U);
  EXPECT_EQ(targets_at(scene.menu, cyan).size(), 2U);
  EXPECT_FALSE(scene.menu.follow(0.2));
  // Another page, and its rows.
  scene.menu.choose("Rows");
  EXPECT_TRUE(scene.menu.follow(0.3));
  const auto well_of = [&](const char* name) {
    const auto felt = targets_at(scene.menu, use.layout().widget(widget(name))->centre);
    return felt.empty() ? -1.0 : felt.front().well;
  };
  EXPECT_GT(well_of("a"), 0.0);
  EXPECT_EQ(well_of("b"), 0.0) << "it is disabled";
  const Vector2 second = use.layout().widget(widget("b"))->centre;
  scene.menu.choose("f");
  EXPECT_TRUE(scene.menu.follow(0.4));
  EXPECT_GT(targets_at(scene.menu, second).front().well, 0.0) << "another row is there now";
  const auto bar =
      targets_at(scene.menu, use.layout().handle(interaction::HandleKind::Bar, &widget("List"))->box.centre);
  ASSERT_EQ(bar.size(), 1U);
  EXPECT_EQ(bar.front().well, 0.0);
  EXPECT_GT(bar.front().recess, 0.0);
  const auto arrow =
      targets_at(scene.menu, use.layout().handle(interaction::HandleKind::Less, &widget("List"))->box.centre);
  EXPECT_GT(arrow.front().well, 0.0);
}

TEST(SceneMenu, TheMouseHoldsWhatItTookAlsoBesideTheSheet) {
  MenuInScene scene(kLeaning, kWidgets);
  const Vector3 eye = kLeaning.centre + 1.3 * kLeaning.normal() + Vector3(0.2, 0.1, 0.0);
  const auto& use = *scene.menu.use();
  const auto& picker = *interaction::find_widget(use.element().widgets, "Colour");
  const auto wheel = interaction::wheel_of(*use.layout().widget(picker), use.element().text_height);
  const auto way_to = [&](const Vector2& place) {
    return interaction::Ray{eye, (kLeaning.in_world(place) - eye).normalized()};
  };
  const auto hue = [&] { return use.settings().of(picker).colour.hue; };
  EXPECT_FALSE(scene.menu.point_by_mouse(way_to(wheel.place_of_hue(1.0)), true, scene.time += 0.01));
  EXPECT_TRUE(scene.menu.is_held_by_mouse());
  EXPECT_NEAR(hue(), 1.0, 1e-6);
  scene.pass({});
  EXPECT_FALSE(scene.menu.point_by_mouse(way_to(wheel.centre + Vector2(0.4, 0.0)), true, scene.time += 0.01));
  EXPECT_NEAR(hue(), 0.5 * std::numbers::pi, 1e-6);
  const auto chosen =
      scene.menu.point_by_mouse(way_to(wheel.centre + Vector2(0.4, 0.0)), false, scene.time += 0.01);
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen->widget.name, "Colour");
  EXPECT_FALSE(scene.menu.is_held_by_mouse());
  // A way that meets the plane nowhere lets go with what was set.
  scene.menu.point_by_mouse(way_to(wheel.place_of_hue(2.0)), true, scene.time += 0.01);
  const interaction::Ray away{eye, kLeaning.normal()};
  EXPECT_TRUE(scene.menu.point_by_mouse(away, false, scene.time += 0.01));
  EXPECT_NEAR(hue(), 2.0, 1e-6);
}

TEST(SceneMenu, AListOfFiveHundredRowsIsDrawnAndFelt) {
  std::string toml = "[[item]]\nname = \"List\"\nkind = \"list\"\n";
  for (int i = 0; i < 500; ++i) toml += "[[item.item]]\nname = \"r" + std::to_string(i) + "\"\n";
  MenuInScene scene(kLeaning, toml.c_str());
  scene.menu.follow(0.0);
  EXPECT_LT(scene.menu.effects().front().panel->targets.size(), 20U);
  EXPECT_TRUE(scene.menu.draw(ElementTheme::Light));
  const auto first = scene.menu.panels().front().picture;
  EXPECT_EQ(scene.menu.choose("r499")->call.operation, "");
  EXPECT_TRUE(scene.menu.draw(ElementTheme::Light));
  EXPECT_NE(scene.menu.panels().front().picture, first);
  EXPECT_EQ(scene.menu.panels().front().picture->width, first->width);
}

TEST(SceneMenu, IsFeltUntilItHasFadedAndThenNoMore) {
  MenuInScene scene;
  EXPECT_TRUE(scene.menu.follow(0.0));
  ASSERT_EQ(scene.menu.effects().size(), 1U);
  EXPECT_FALSE(scene.menu.follow(0.1));
  EXPECT_EQ(scene.menu.effects().front().panel->size, 2.5);
  scene.menu.choose("More");
  EXPECT_TRUE(scene.menu.follow(0.2));
  EXPECT_EQ(scene.menu.effects().size(), 2U);
  scene.menu.close();
  EXPECT_TRUE(scene.menu.follow(0.3));
  for (const auto& it : scene.menu.effects()) EXPECT_TRUE(it.panel->closes);
  EXPECT_TRUE(scene.menu.follow(2.0));
  EXPECT_TRUE(scene.menu.effects().empty());
}

}  // namespace
}  // namespace icome::session
