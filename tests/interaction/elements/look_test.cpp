#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "interaction/elements/element_samples.h"

namespace icome::interaction {
namespace {

using base::Vector3;

constexpr const char* kLookedAt =
    "kind = \"toolbar\"\ncolumns = 3\ncentre = [0.1, 1.2, -0.8]\nturn_deg = 25\n[choosing]\nby = \"look\"\n"
    "[[item]]\nname = \"A\"\n[[item]]\nname = \"B\"\n[[item]]\nname = \"C\"\nenabled = false\n"
    "[[item]]\nname = \"D\"\n[[item.item]]\nname = \"E\"\n";

/// The way from an eye to a place of the element's plane.
Ray towards(const ElementUse& use, const Vector3& eye, const Vector2& place) {
  return {eye, (use.frame().in_world(place) - eye).normalized()};
}

Vector2 middle_of(const ElementUse& use, std::string_view name) {
  for (const LaidWidget& it : use.layout().widgets)
    if (it.widget->name == name) return it.centre;
  return Vector2::Constant(std::nan(""));
}

TEST(LookAtMenu, LightsWhatTheEyeLooksAtFromAnywhereInFront) {
  base::Random random(5);
  const Element element = element_of(kLookedAt);
  ASSERT_TRUE(element.choosing.by_look && !element.choosing.by_click && !element.choosing.by_push);
  ElementUse use(element, 0, even_letters());
  const ElementFrame& frame = use.frame();
  const Vector2 half = use.layout().sheets.front().half;
  int lit = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vector2 place(random.uniform(-1.5, 1.5) * half.x(), random.uniform(-1.5, 1.5) * half.y());
    const Vector3 eye = frame.centre + random.uniform(0.05, 2.0) * frame.normal() +
                        random.uniform(-1.0, 1.0) * frame.right() + random.uniform(-1.0, 1.0) * frame.up();
    EXPECT_FALSE(use.look(towards(use, eye, place), false, 0.01 * i));
    const Widget* expected = nullptr;
    for (const LaidWidget& it : use.layout().widgets)
      if (((place - it.centre).cwiseAbs().array() <= it.half.array()).all() && it.widget->enabled)
        expected = it.widget;
    EXPECT_EQ(use.lit(), expected);
    lit += expected != nullptr ? 1 : 0;
  }
  EXPECT_GT(lit, 2000);
}

TEST(LookAtMenu, ChoosesWhatIsLookedAtWhenTheButtonIsReleased) {
  const Element element = element_of(kLookedAt);
  ElementUse use(element, 0, even_letters());
  const Vector3 eye(0.0, 1.6, 0.0);
  double time = 0.0;
  const auto look = [&](const Vector2& place, bool button) {
    return use.look(towards(use, eye, place), button, time += 0.02);
  };
  // The press that opened it is held already; where it began to look does not count.
  EXPECT_FALSE(look(middle_of(use, "A"), true));
  EXPECT_FALSE(look(middle_of(use, "B"), true));
  const auto choice = look(middle_of(use, "B"), false);
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->widget->name, "B");
  EXPECT_EQ(choice->by, ChosenBy::Look);
  EXPECT_FALSE(look(middle_of(use, "A"), false));  // once for each release
  look(middle_of(use, "C"), true);
  EXPECT_FALSE(look(middle_of(use, "C"), false));  // disabled
  look(middle_of(use, "A"), true);
  EXPECT_FALSE(look(Vector2(3.0, 3.0), false));  // beside it
  // A menu opens, and its items can be looked at.
  look(middle_of(use, "D"), true);
  ASSERT_TRUE(look(middle_of(use, "D"), false));
  ASSERT_EQ(use.open().size(), 1U);
  look(middle_of(use, "E"), true);
  const auto deep = look(middle_of(use, "E"), false);
  ASSERT_TRUE(deep);
  EXPECT_EQ(deep->widget->name, "E");
}

TEST(LookAtMenu, IsNotThereFromBehindOrAside) {
  const Element element = element_of(kLookedAt);
  ElementUse use(element, 0, even_letters());
  const ElementFrame& frame = use.frame();
  const Vector3 behind = frame.centre - 0.5 * frame.normal();
  use.look({behind, frame.normal()}, true, 0.0);
  EXPECT_EQ(use.lit(), nullptr);
  EXPECT_FALSE(use.look({behind, frame.normal()}, false, 0.1));
  const Vector3 front = frame.centre + 0.5 * frame.normal();
  for (const Vector3& away : {frame.normal(), frame.right(), frame.up()}) {
    use.look({front, away}, true, 0.2);
    EXPECT_FALSE(use.look({front, away}, false, 0.3));
    EXPECT_FALSE(use.is_near());
  }
}

TEST(LookAtMenu, FadesInWhileItIsLookedAt) {
  const Element element = element_of(kLookedAt);
  ElementUse use(element, 0, even_letters());
  const Vector3 eye(0.0, 1.6, 0.0);
  double last = use.opacity();
  for (int i = 0; i < 100; ++i) {
    use.look(towards(use, eye, middle_of(use, "A")), false, 0.02 * i);
    EXPECT_GE(use.opacity(), last);
    last = use.opacity();
  }
  EXPECT_GT(last, 0.99);
  EXPECT_NEAR(use.near_seconds(), 1.98, 1e-9);
  for (int i = 100; i < 200; ++i) use.look(towards(use, eye, {2.0, 0.0}), false, 0.02 * i);
  EXPECT_NEAR(use.opacity(), element.fading.least, 0.01);
}

}  // namespace
}  // namespace icome::interaction
