#include "study/menus/menu_bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "study/menus/menu_person.h"

namespace icome::study {
namespace {

using interaction::ElementKind;
using interaction::PersonModel;

double letters_wide(const std::string& text) { return 0.8 * double(text.size()); }

/// A person without noise, tremor or jolt, whose movements take a known time.
PersonModel sure_person() {
  PersonModel person;
  person.arm.noise = person.arm.tremor = person.arm.press_jolt = 0.0;
  person.known = interaction::KnownDuration{0.5, 0.0};
  return person;
}

TEST(MenuPerson, ASurePersonChoosesAnyItemAtTheFirstTry) {
  for (const MenuCondition& condition : menu_conditions()) {
    const interaction::Element element = menu_of(condition);
    for (const interaction::Widget& wanted : element.widgets) {
      base::Random random(3);
      const MenuRun run = choose_from_menu(sure_person(), element, letters_wide, wanted, random);
      ASSERT_NE(run.chosen, nullptr) << wanted.name;
      EXPECT_EQ(run.chosen->name, wanted.name);
      EXPECT_EQ(run.movements, 1);
    }
  }
}

TEST(MenuPerson, TheTimeOfASureClickIsTheSumOfItsParts) {
  const PersonModel person = sure_person();
  for (const std::size_t items : {5U, 12U}) {
    const interaction::Element element = menu_of({ElementKind::Menu, items, false, MenuFeel::None});
    base::Random random(4);
    const MenuRun run = choose_from_menu(person, element, letters_wide, element.widgets[1], random);
    const double sum = person.reaction + 0.5 + person.correction + person.press;
    EXPECT_NEAR(run.seconds, sum, 0.005);
    // From 3 cm before the middle straight to the item, but for what the ground gives way.
    EXPECT_GT(run.way, 0.03);
  }
}

TEST(MenuPerson, ItsForcesAreThoseOfTheGround) {
  // 300 N/m of the hand against 600 N/m of the ground, 1 mm deep: 0.2 N when it rests.
  const interaction::Element element = menu_of({ElementKind::Menu, 5, false, MenuFeel::None});
  base::Random random(5);
  const MenuRun run = choose_from_menu(sure_person(), element, letters_wide, element.widgets[2], random);
  EXPECT_GT(run.most_force, 0.15);
  EXPECT_LT(run.most_force, 0.4);
}

TEST(MenuPerson, AnUnsteadyPersonMakesMoreErrors) {
  const interaction::Element element = menu_of({ElementKind::Menu, 12, false, MenuFeel::None});
  double wrong[2] = {0.0, 0.0};
  for (const int unsteady : {0, 1}) {
    PersonModel person;
    person.arm.press_jolt = unsteady == 1 ? 0.008 : 0.0005;
    base::Random random(6);
    for (int i = 0; i < 150; ++i) {
      const interaction::Widget& wanted = element.widgets[random.index(element.widgets.size())];
      wrong[unsteady] += choose_from_menu(person, element, letters_wide, wanted, random).chosen != &wanted;
    }
  }
  EXPECT_LT(wrong[0], 10.0);
  EXPECT_GT(wrong[1], 40.0);
}

TEST(MenuPerson, WellsHoldAHandThatTrembles) {
  // The tip of a hand that rests on an item strays less where the item pulls.
  double errors[2] = {0.0, 0.0};
  for (const MenuFeel feel : {MenuFeel::None, MenuFeel::Well}) {
    const interaction::Element element = menu_of({ElementKind::Menu, 12, false, feel});
    PersonModel person;
    person.arm.press_jolt = 0.006;
    base::Random random(7);
    for (int i = 0; i < 200; ++i) {
      const interaction::Widget& wanted = element.widgets[random.index(element.widgets.size())];
      errors[feel == MenuFeel::Well ? 1 : 0] +=
          choose_from_menu(person, element, letters_wide, wanted, random).chosen != &wanted;
    }
  }
  EXPECT_LT(errors[1], errors[0]);
}

TEST(MenuBench, GivesTheSameBitsOnAnyNumberOfThreads) {
  MenuBenchSettings settings;
  settings.users = 2;
  settings.trials = 2;
  const auto one = run_menu_bench(settings), other = run_menu_bench(settings);
  ASSERT_TRUE(one && other);
  ASSERT_EQ(one->conditions.size(), 72U);
  for (std::size_t i = 0; i < one->conditions.size(); ++i) {
    EXPECT_EQ(one->conditions[i].time.mean, other->conditions[i].time.mean);
    EXPECT_EQ(one->conditions[i].way, other->conditions[i].way);
  }
  settings.seed = 2;
  EXPECT_NE(run_menu_bench(settings)->conditions[0].time.mean, one->conditions[0].time.mean);
}

TEST(MenuBench, RefusesImpossibleSettingsAndEndsWhenAsked) {
  MenuBenchSettings settings;
  settings.users = 0;
  EXPECT_FALSE(run_menu_bench(settings));
  settings.users = 1;
  settings.trials = 1001;
  EXPECT_FALSE(run_menu_bench(settings));
  settings.trials = 1;
  const auto ended = run_menu_bench(settings, [](double) { return false; });
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().message, "interrupted");
}

}  // namespace
}  // namespace icome::study
