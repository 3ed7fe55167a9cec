// Lists, numbers, pickers of colours and tabs in use.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "base/random.h"
#include "interaction/elements/element_hand.h"
#include "repeats.h"

namespace icome::interaction {
namespace {

std::string list_of(std::size_t count, std::size_t rows, const std::string& more = "") {
  std::string toml = "[[item]]\nname = \"Before\"\n[[item]]\nname = \"List\"\nkind = \"list\"\nrows = " +
                     std::to_string(rows) + "\n" + more;
  for (std::size_t i = 0; i < count; ++i) toml += "[[item.item]]\nname = \"r" + std::to_string(i) + "\"\n";
  return toml + "[[item]]\nname = \"After\"\n";
}

Vector2 middle_of(const UsedElement& it, HandleKind kind, const Widget* of) {
  const LaidHandle* const handle = it.use.layout().handle(kind, of);
  return handle != nullptr ? handle->box.centre : Vector2::Constant(std::nan(""));
}

const LaidColumn& column_in(const UsedElement& it, const Widget* of) { return *it.use.layout().column(of); }

/// Turns the button on and off over a place for that long, in ticks.
std::string hold_at(UsedElement& it, const Vector2& place, double seconds) {
  std::string chosen = it.hand.move(it.hand.over(place, 0.01), 0.05);
  chosen += it.hand.move(it.hand.tip(), seconds, true);
  return chosen + it.hand.move(it.hand.tip(), 0.01);
}

TEST(WidgetUse, ARowIsTheOneOfItsListHoweverItIsChosen) {
  for (int way = 0; way < 4; ++way) {
    UsedElement it(list_of(20, 6, "value = \"r19\"\n"));
    const Widget& list = it.widget("List");
    EXPECT_EQ(it.use.settings().of(list).chosen->name, "r19");
    EXPECT_EQ(column_in(it, &list).first, 14U) << "the chosen row is seen";
    EXPECT_EQ(it.use.layout().widget(it.widget("r3")), nullptr);
    ASSERT_TRUE(it.use.show("r3"));
    EXPECT_EQ(column_in(it, &list).first, 3U);
    if (way == 0) {
      EXPECT_EQ(it.hand.click("r4"), "r4");
    }
    if (way == 1) {
      EXPECT_EQ(it.hand.push("r4"), "r4");
    }
    if (way == 2) {
      ASSERT_EQ(it.use.lit()->name, "r3") << "what is shown is lit";
      it.use.press(ElementKey::Down);
      EXPECT_EQ(it.use.press(ElementKey::Enter)->widget->name, "r4");
    }
    if (way == 3) {
      EXPECT_EQ(it.use.choose("r4")->widget->name, "r4");
    }
    EXPECT_EQ(it.use.settings().of(list).chosen->name, "r4");
    EXPECT_EQ(*it.use.settings().value_of(list).text(), "r4");
    EXPECT_NE(it.use.layout().widget(it.widget("r4")), nullptr);
  }
}

// Against a model that knows nothing but the number of the first row.
TEST(WidgetUse, ScrollingFollowsAModelAndNeverPassesTheEnds) {
  base::Random random(1);
  for (int trial = 0; trial < repeats(20); ++trial) {
    const std::size_t rows = 3 + random.index(8), count = trial == 0 ? 500 : rows + 1 + random.index(60);
    UsedElement it(list_of(count, rows));
    const Widget& list = it.widget("List");
    const auto last = std::ptrdiff_t(count - rows);
    std::ptrdiff_t first = 0;
    std::ptrdiff_t light = -1;  // the row that is lit; -1: none
    const auto show = [&](std::ptrdiff_t row) {
      if (row < first) first = row;
      if (row >= first + std::ptrdiff_t(rows)) first = row + 1 - std::ptrdiff_t(rows);
    };
    for (int step = 0; step < 60; ++step) {
      switch (random.index(5)) {
        case 0:
        case 1: {  // an arrow, clicked or pushed
          const bool down = random.index(2) == 0;
          const Vector2 at = middle_of(it, down ? HandleKind::More : HandleKind::Less, &list);
          EXPECT_EQ(random.index(2) == 0 ? it.hand.click_at(at) : it.hand.push_at(at), "");
          first = std::clamp<std::ptrdiff_t>(first + (down ? 1 : -1), 0, last);
          light = -1;
          break;
        }
        case 2: {  // the wheel, with the pointer over a row
          const LaidColumn column = column_in(it, &list);
          it.hand.move(it.hand.over(column.box.centre - Vector2(0.3 * column.box.half.x(), 0.0), 0.01), 0.05);
          const double notches = double(random.index(9)) - 4.0;
          EXPECT_FALSE(it.use.turn_wheel(notches));
          first = std::clamp<std::ptrdiff_t>(first - std::ptrdiff_t(3.0 * notches), 0, last);
          light = -2;
          break;
        }
        case 3: {  // a name
          const auto row = std::ptrdiff_t(random.index(count));
          EXPECT_EQ(it.use.choose("r" + std::to_string(row))->widget->name, "r" + std::to_string(row));
          show(row);
          if (light < first || light >= first + std::ptrdiff_t(rows)) light = -2;
          break;
        }
        default: {  // the bar
          const LaidHandle bar = *it.use.layout().handle(HandleKind::Bar, &list);
          const double share = random.uniform(0.0, 1.0);
          const Vector2 at = bar.box.centre + Vector2(0.0, (1.0 - 2.0 * share) * bar.box.half.y());
          it.hand.click_at(at);
          first =
              std::clamp<std::ptrdiff_t>(std::lround(share * double(count) - 0.5 * double(rows)), 0, last);
          light = -1;
        }
      }
      ASSERT_EQ(std::ptrdiff_t(column_in(it, &list).first), first) << trial << ' ' << step;
      if (light == -1) {
        ASSERT_EQ(it.use.lit(), nullptr);
      }
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_EQ(it.use.layout().widget(list.widgets[i]) != nullptr,
                  std::ptrdiff_t(i) >= first && std::ptrdiff_t(i) < first + std::ptrdiff_t(rows));
    }
  }
}

TEST(WidgetUse, TheLightMovesThroughRowsThatAreNotSeenAndTheListFollows) {
  UsedElement it(list_of(500, 6));
  const Widget& list = it.widget("List");
  it.use.press(ElementKey::Down);
  EXPECT_EQ(it.use.lit()->name, "Before");
  std::size_t first = 0;
  for (std::size_t i = 0; i < 500; ++i) {
    it.use.press(ElementKey::Down);
    ASSERT_EQ(it.use.lit(), &list.widgets[i]);
    if (i >= first + 6) first = i - 5;
    ASSERT_EQ(column_in(it, &list).first, first);
  }
  it.use.press(ElementKey::Down);
  EXPECT_EQ(it.use.lit()->name, "After");
  it.use.press(ElementKey::Up);
  it.use.press(ElementKey::PageUp);
  EXPECT_EQ(it.use.lit()->name, "r493");
  EXPECT_EQ(column_in(it, &list).first, 493U);
  for (int i = 0; i < 100; ++i) it.use.press(ElementKey::PageUp);
  EXPECT_EQ(it.use.lit()->name, "Before");
  EXPECT_EQ(column_in(it, &list).first, 1U) << "r1 was lit before";
}

TEST(WidgetUse, AMenuWithRowsScrollsAsAListDoes) {
  std::string toml = "rows = 4\n";
  for (int i = 0; i < 9; ++i) toml += "[[item]]\nname = \"m" + std::to_string(i) + "\"\n";
  toml += "[[item]]\nname = \"More\"\nrows = 3\n";
  for (int i = 0; i < 12; ++i) toml += "[[item.item]]\nname = \"d" + std::to_string(i) + "\"\n";
  UsedElement it(toml);
  const LaidColumn& own = column_in(it, nullptr);
  EXPECT_EQ(own.count, 10U);
  EXPECT_EQ(own.seen, 4U);
  it.hand.push_at(middle_of(it, HandleKind::More, nullptr));
  EXPECT_EQ(column_in(it, nullptr).first, 1U);
  EXPECT_EQ(it.use.choose("d11")->widget->name, "d11");
  EXPECT_EQ(column_in(it, nullptr).first, 6U);
  EXPECT_TRUE(it.use.open().empty()) << "what does something closes menus";
  EXPECT_EQ(it.hand.click("More"), "More");
  const Widget& more = it.widget("More");
  EXPECT_EQ(column_in(it, &more).seen, 3U);
  for (int i = 0; i < 12; ++i) it.use.press(ElementKey::Down);
  EXPECT_EQ(it.use.lit()->name, "d11");
  EXPECT_EQ(column_in(it, &more).first, 9U);
  // The menu closes with the item that opened it.
  for (int i = 0; i < 9; ++i) it.hand.click_at(middle_of(it, HandleKind::Less, nullptr));
  EXPECT_EQ(column_in(it, nullptr).first, 0U);
  EXPECT_TRUE(it.use.open().empty());
  EXPECT_EQ(it.use.layout().sheets.size(), 1U);
}

constexpr const char* kNumbers =
    "[[item]]\nname = \"Width\"\nkind = \"number\"\nleast = 10\nmost = 200\nstep = 5\nvalue = 100\nunit = "
    "\"mm\"\n"
    "[[item]]\nname = \"Turn\"\nkind = \"number\"\nleast = -1\nmost = 1\nstep = 0.1\nvalue = 0\n";

TEST(WidgetUse, ANumberStepsWithinItsRange) {
  UsedElement it(kNumbers);
  const Widget& width = it.widget("Width");
  const Vector2 less = middle_of(it, HandleKind::Less, &width),
                more = middle_of(it, HandleKind::More, &width);
  EXPECT_EQ(it.hand.click_at(more), "Width");
  EXPECT_EQ(it.use.value_of(width), 105.0);
  EXPECT_EQ(it.hand.push_at(less), "Width");
  EXPECT_EQ(it.hand.push_at(less), "Width");
  EXPECT_EQ(it.use.value_of(width), 95.0);
  EXPECT_EQ(it.use.pushes(), 2U);
  EXPECT_EQ(it.use.press(ElementKey::Right)->widget->name, "Width");
  EXPECT_EQ(it.use.value_of(width), 100.0);
  EXPECT_EQ(it.use.turn_wheel(2.0)->by, ChosenBy::Wheel);
  EXPECT_EQ(it.use.value_of(width), 110.0);
  for (int i = 0; i < 30; ++i) it.use.turn_wheel(-1.0);
  EXPECT_EQ(it.use.value_of(width), 10.0);
  EXPECT_EQ(it.hand.click_at(field_of(it.use.layout(), width).centre), "Width") << "its value again";
  EXPECT_EQ(it.use.value_of(width), 10.0);
}

TEST(WidgetUse, StepsOfATenthStayTenths) {
  UsedElement it(kNumbers);
  const Widget& turn = it.widget("Turn");
  while (it.use.lit() != &turn) it.use.press(ElementKey::Down);
  for (int i = 1; i <= 10; ++i) {
    it.use.press(ElementKey::Right);
    EXPECT_EQ(it.use.value_of(turn), i / 10.0);
  }
  it.use.press(ElementKey::Right);
  EXPECT_EQ(it.use.value_of(turn), 1.0);
}

TEST(WidgetUse, ANumberThatIsHeldStepsOnQuickerAfterASecondAndIsChosenOnce) {
  std::map<double, double> after;  // steps by seconds
  for (const double seconds : {0.3, 0.9, 1.0, 2.0}) {
    UsedElement it("[[item]]\nname = \"N\"\nkind = \"number\"\nmost = 1000\n");
    EXPECT_EQ(hold_at(it, middle_of(it, HandleKind::More, &it.widget("N")), seconds), "N");
    after[seconds] = it.use.value_of(it.widget("N"));
  }
  EXPECT_EQ(after[0.3], 1.0);
  EXPECT_GE(after[0.9], 4.0);
  EXPECT_LE(after[0.9], 7.0);
  EXPECT_GT((after[2.0] - after[1.0]) / 1.0, 3.0 * (after[0.9] - after[0.3]) / 0.6);
  // A push that stays in does the same, once.
  UsedElement it("[[item]]\nname = \"N\"\nkind = \"number\"\nmost = 1000\n");
  const Vector2 more = middle_of(it, HandleKind::More, &it.widget("N"));
  it.hand.move(it.hand.over(more, 0.01), 0.1);
  it.hand.move(it.hand.over(more, -0.005), 0.1);
  EXPECT_EQ(it.hand.move(it.hand.tip(), 1.0), "");
  EXPECT_EQ(it.hand.move(it.hand.over(more, 0.01), 0.1), "N");
  EXPECT_GE(it.use.value_of(it.widget("N")), 4.0);
  EXPECT_EQ(it.use.pushes(), 1U);
}

TEST(WidgetUse, WhatIsHeldStopsWhereThePointerLeavesIt) {
  UsedElement it("[[item]]\nname = \"N\"\nkind = \"number\"\nmost = 1000\n");
  const Vector2 more = middle_of(it, HandleKind::More, &it.widget("N"));
  it.hand.move(it.hand.over(more, 0.01), 0.1);
  it.hand.move(it.hand.tip(), 0.01, true);
  it.hand.move(it.hand.over(more + Vector2(0.2, 0.0), 0.01), 0.001, true);
  it.hand.move(it.hand.tip(), 2.0, true);
  EXPECT_EQ(it.use.value_of(it.widget("N")), 1.0);
  EXPECT_EQ(it.hand.move(it.hand.tip(), 0.001), "N");
}

std::string typed(UsedElement& it, std::string_view letters) {
  for (const char letter : letters) EXPECT_TRUE(it.use.type(letter)) << letter;
  const auto choice = it.use.press(ElementKey::Enter);
  return choice ? choice->widget->name : "";
}

TEST(WidgetUse, DigitsAreTypedSetAndGivenUp) {
  UsedElement it(kNumbers);
  const Widget& width = it.widget("Width");
  EXPECT_FALSE(it.use.type('5')) << "nothing is lit";
  it.use.press(ElementKey::Down);
  EXPECT_FALSE(it.use.type('x'));
  EXPECT_EQ(typed(it, "42.5"), "Width");
  EXPECT_EQ(it.use.value_of(width), 42.5) << "typed values need be at no step";
  it.use.type('7');
  EXPECT_EQ(*it.use.typed_into(width), "7");
  it.use.press(ElementKey::Escape);
  EXPECT_EQ(it.use.typed_into(width), nullptr);
  EXPECT_EQ(it.use.value_of(width), 42.5);
  it.use.type('9');
  it.use.type('1');
  it.use.press(ElementKey::Backspace);
  it.use.type('9');
  EXPECT_EQ(it.use.press(ElementKey::Enter)->by, ChosenBy::Key);
  EXPECT_EQ(it.use.value_of(width), 99.0);
  it.use.type('5');
  it.use.press(ElementKey::Down);  // the light goes, and what was typed with it
  EXPECT_EQ(it.use.value_of(width), 99.0);
  EXPECT_EQ(it.use.lit()->name, "Turn");
  EXPECT_EQ(typed(it, "-0,5"), "Turn");
  EXPECT_EQ(it.use.value_of(it.widget("Turn")), -0.5);
}

TEST(WidgetUse, WhatIsOutOfRangeIsToldAndNotSet) {
  UsedElement it(kNumbers);
  const Widget& width = it.widget("Width");
  it.use.press(ElementKey::Down);
  EXPECT_EQ(typed(it, "500"), "");
  EXPECT_EQ(it.use.trouble(), "Width: 500 is not between 10 and 200 mm.");
  EXPECT_EQ(it.use.value_of(width), 100.0);
  it.use.press(ElementKey::Backspace);
  EXPECT_EQ(it.use.trouble(), "");
  EXPECT_EQ(it.use.press(ElementKey::Enter)->widget->name, "Width");
  EXPECT_EQ(it.use.value_of(width), 50.0);
  EXPECT_EQ(typed(it, "-"), "");
  EXPECT_NE(it.use.trouble().find("no number"), std::string::npos);
}

constexpr const char* kPicker =
    "[[item]]\nname = \"Colour\"\nkind = \"colour\"\nvalue = \"#336699\"\n[[item]]\nname = \"Below\"\n";

TEST(WidgetUse, APickerTakesHueFromItsRingAndShadeFromItsTriangle) {
  base::Random random(9);
  for (int trial = 0; trial < repeats(200); ++trial) {
    UsedElement it(kPicker);
    const Widget& picker = it.widget("Colour");
    const ColourWheel wheel = wheel_of(*it.use.layout().widget(picker), it.element.text_height);
    const Hsv wanted{random.uniform(0.0, 6.28), random.uniform(0.0, 1.0), random.uniform(0.02, 1.0)};
    const bool pushes = trial % 2 == 0;
    const auto choose_at = [&](const Vector2& place) {
      return pushes ? it.hand.push_at(place) : it.hand.click_at(place);
    };
    EXPECT_EQ(choose_at(wheel.place_of_hue(wanted.hue)), "Colour");
    EXPECT_EQ(choose_at(wheel.place_of_shade(wanted)), "Colour");
    const Hsv& set = it.use.settings().of(picker).colour;
    EXPECT_NEAR(set.hue, wanted.hue, 1e-9);
    EXPECT_NEAR(set.saturation, wanted.saturation, 1e-9);
    EXPECT_NEAR(set.value, wanted.value, 1e-9);
    EXPECT_EQ(*it.use.settings().value_of(picker).text(), colour_text(rgb_of(wanted)));
    EXPECT_EQ(it.use.pushes(), pushes ? 2U : 0U);
  }
}

TEST(WidgetUse, ADragKeepsWhatItHoldsAndIsChosenOnce) {
  UsedElement it(kPicker);
  const Widget& picker = it.widget("Colour");
  const ColourWheel wheel = wheel_of(*it.use.layout().widget(picker), it.element.text_height);
  const Hsv before = it.use.settings().of(picker).colour;
  it.hand.move(it.hand.over(wheel.place_of_hue(0.2), 0.01), 0.1);
  std::string chosen = it.hand.move(it.hand.tip(), 0.01, true);
  EXPECT_TRUE(it.use.is_holding());
  // Over the triangle, and far beside the sheet.
  chosen += it.hand.move(it.hand.over(wheel.centre + Vector2(0.001, 0.0), 0.01), 0.1, true);
  EXPECT_NEAR(it.use.settings().of(picker).colour.hue, std::numbers::pi / 2.0, 1e-9);
  chosen += it.hand.move(it.hand.over(wheel.centre + Vector2(0.0, -0.5), 0.01), 0.1, true);
  EXPECT_EQ(chosen, "");
  EXPECT_EQ(it.hand.move(it.hand.tip(), 0.001), "Colour");
  const Hsv& set = it.use.settings().of(picker).colour;
  EXPECT_NEAR(set.hue, std::numbers::pi, 1e-9);
  EXPECT_EQ(set.saturation, before.saturation);
  // Another pointer ends it, with what was set.
  it.hand.move(it.hand.over(wheel.place_of_hue(0.2), 0.01), 0.1);
  it.hand.move(it.hand.tip(), 0.01, true);
  EXPECT_EQ(it.use.change_pointer()->widget, &picker);
  EXPECT_FALSE(it.use.is_holding());
}

TEST(WidgetUse, TheRingOfAGreyGivesTheFullHue) {
  for (const char* const grey : {"#cccccc", "#000000", "#ffffff"}) {
    UsedElement it("[[item]]\nname = \"Colour\"\nkind = \"colour\"\nvalue = \"" + std::string(grey) + "\"\n");
    const Widget& picker = it.widget("Colour");
    const ColourWheel wheel = wheel_of(*it.use.layout().widget(picker), it.element.text_height);
    EXPECT_EQ(it.hand.click_at(wheel.place_of_hue(2.0 * std::numbers::pi / 3.0)), "Colour");
    EXPECT_EQ(*it.use.settings().value_of(picker).text(), "#00ff00") << grey;
  }
  UsedElement it("[[item]]\nname = \"Colour\"\nkind = \"colour\"\nvalue = \"#808080\"\n");
  it.use.press(ElementKey::Down);
  it.use.press(ElementKey::Right);
  it.use.press(ElementKey::Enter);
  EXPECT_EQ(it.use.settings().of(it.widget("Colour")).colour.saturation, 1.0);
}

constexpr const char* kSlider =
    "[[item]]\nname = \"Size\"\nkind = \"slider\"\nleast = 10\nmost = 20\nvalue = 12\n"
    "operation = \"reshape\"\nvalue_as = \"radius\"\nvalue_times = 0.001\n[[item]]\nname = \"Below\"\n";

TEST(WidgetUse, ASliderIsDraggedAlongItsGrooveAndChosenOnceWhenItIsLetGo) {
  base::Random random(4);
  for (int trial = 0; trial < repeats(200); ++trial) {
    UsedElement it(kSlider);
    const Widget& slider = it.widget("Size");
    const LaidWidget laid = *it.use.layout().widget(slider);
    const SliderGroove groove = groove_of(laid, it.element.text_height);
    const bool pushes = trial % 2 == 0;
    const double front = pushes ? -0.005 : 0.01;
    it.hand.move(it.hand.over({random.uniform(groove.left, groove.right), laid.centre.y()}, 0.01), 0.1);
    std::string chosen = it.hand.move(it.hand.tip() + (front - 0.01) * it.use.frame().normal(), 0.1, !pushes);
    EXPECT_EQ(it.use.changing(), &slider);
    double value = 0.0;
    for (int way = 0; way < 3; ++way) {
      // The button holds it anywhere, a push as long as there is ground to push.
      const double share = pushes ? random.uniform(0.0, 1.0) : random.uniform(-0.5, 1.5);
      const double up = pushes ? 0.0 : random.uniform(-0.1, 0.1);
      const Vector2 to(groove.left + share * (groove.right - groove.left), laid.centre.y() + up);
      chosen += it.hand.move(it.hand.over(to, front), 0.1, !pushes);
      value = 10.0 + 10.0 * std::clamp(share, 0.0, 1.0);
      EXPECT_NEAR(it.use.value_of(slider), value, 1e-9);
    }
    EXPECT_EQ(chosen, "");
    chosen = it.hand.move(it.hand.tip() + (0.01 - front) * it.use.frame().normal(), 0.1);
    EXPECT_EQ(chosen, "Size");
    EXPECT_EQ(it.use.changing(), nullptr);
    EXPECT_NEAR(it.use.value_of(slider), value, 1e-9);
  }
}

TEST(WidgetUse, TheTextBesideASlidersGrooveSetsNothing) {
  UsedElement it(kSlider);
  const Widget& slider = it.widget("Size");
  const LaidWidget& laid = *it.use.layout().widget(slider);
  EXPECT_EQ(it.hand.click_at({laid.centre.x() - 0.9 * laid.half.x(), laid.centre.y()}), "");
  EXPECT_EQ(it.use.value_of(slider), 12.0);
}

TEST(WidgetUse, WhatTheWorldHasIsShownUnlessItIsHeldOrTyped) {
  UsedElement it(std::string(kSlider) +
                 "[[item]]\nname = \"Paint\"\nkind = \"colour\"\nvalue = \"#336699\"\n"
                 "[[item]]\nname = \"Tick\"\nkind = \"check\"\n"
                 "[[item]]\nname = \"List\"\nkind = \"list\"\nrows = 3\n[[item.item]]\nname = \"a\"\n"
                 "[[item.item]]\nname = \"b\"\n[[item.item]]\nname = \"c\"\n[[item.item]]\nname = \"d\"\n"
                 "[[item]]\nname = \"Number\"\nkind = \"number\"\nmost = 1000\n");
  const auto& settings = it.use.settings();
  it.use.show_value(it.widget("Size"), 0.0175);
  EXPECT_EQ(it.use.value_of(it.widget("Size")), 17.5) << "in the unit of the widget";
  it.use.show_value(it.widget("Paint"), "#ff8000");
  EXPECT_EQ(*settings.value_of(it.widget("Paint")).text(), "#ff8000");
  const Hsv orange = settings.of(it.widget("Paint")).colour;
  it.use.show_value(it.widget("Paint"), "#808080");
  EXPECT_EQ(settings.of(it.widget("Paint")).colour.hue, orange.hue) << "a grey keeps the hue";
  it.use.show_value(it.widget("Tick"), true);
  EXPECT_TRUE(it.use.is_checked(it.widget("Tick")));
  it.use.show_value(it.widget("List"), "d");
  EXPECT_EQ(settings.of(it.widget("List")).chosen, &it.widget("d"));
  EXPECT_NE(it.use.layout().widget(it.widget("d")), nullptr) << "it is seen";
  it.use.show_value(it.widget("List"), "elsewhere");
  EXPECT_EQ(settings.of(it.widget("List")).chosen, nullptr);
  // What is of another kind changes nothing.
  it.use.show_value(it.widget("Size"), "wide");
  it.use.show_value(it.widget("Paint"), 5.0);
  it.use.show_value(it.widget("Tick"), "yes");
  EXPECT_EQ(it.use.value_of(it.widget("Size")), 17.5);
  EXPECT_TRUE(it.use.is_checked(it.widget("Tick")));

  const LaidWidget laid = *it.use.layout().widget(it.widget("Size"));
  const SliderGroove groove = groove_of(laid, it.element.text_height);
  it.hand.move(it.hand.over({groove.left, laid.centre.y()}, 0.01), 0.1);
  it.hand.move(it.hand.tip(), 0.01, true);
  it.use.show_value(it.widget("Size"), 0.019);
  EXPECT_EQ(it.use.value_of(it.widget("Size")), 10.0) << "it is held";
  EXPECT_EQ(it.hand.move(it.hand.tip(), 0.01), "Size");
  it.hand.move(it.hand.at("Number", 0.01), 0.1);
  ASSERT_TRUE(it.use.type('7'));
  it.use.show_value(it.widget("Number"), 50.0);
  EXPECT_EQ(it.use.press(ElementKey::Enter)->widget->name, "Number");
  EXPECT_EQ(it.use.value_of(it.widget("Number")), 7.0);
}

TEST(WidgetUse, KeysChangeAColourUntilItIsSetOrGivenUp) {
  UsedElement it(kPicker);
  const Widget& picker = it.widget("Colour");
  const Hsv before = it.use.settings().of(picker).colour;
  it.use.press(ElementKey::Down);
  ASSERT_EQ(it.use.lit(), &picker);
  EXPECT_FALSE(it.use.press(ElementKey::Right));
  EXPECT_FALSE(it.use.press(ElementKey::Up));
  EXPECT_FALSE(it.use.press(ElementKey::PageDown));
  Hsv now = it.use.settings().of(picker).colour;
  EXPECT_NEAR(now.hue - before.hue, std::numbers::pi / 36.0, 1e-9);
  EXPECT_NEAR(now.value - before.value, 0.05, 1e-9);
  EXPECT_NEAR(now.saturation - before.saturation, -0.05, 1e-9);
  it.use.press(ElementKey::Escape);
  EXPECT_EQ(it.use.settings().of(picker).colour, before);
  it.use.press(ElementKey::Left);
  EXPECT_EQ(it.use.press(ElementKey::Enter)->widget, &picker);
  now = it.use.settings().of(picker).colour;
  EXPECT_NEAR(before.hue - now.hue, std::numbers::pi / 36.0, 1e-9);
  it.use.press(ElementKey::Down);
  EXPECT_EQ(it.use.lit()->name, "Below") << "without an edit Down goes on";
}

constexpr const char* kTabs =
    "[[item]]\nname = \"Tabs\"\nkind = \"tabs\"\n"
    "[[item.item]]\nname = \"P1\"\n[[item.item.item]]\nname = \"A\"\n[[item.item.item]]\nname = \"B\"\n"
    "[[item.item]]\nname = \"P2\"\n[[item.item.item]]\nname = \"C\"\nkind = \"check\"\n"
    "[[item.item]]\nname = \"P3\"\nenabled = false\n[[item.item.item]]\nname = \"D\"\n"
    "[[item.item]]\nname = \"P4\"\n[[item.item.item]]\nname = \"E\"\n[[item.item.item.item]]\nname = \"F\"\n"
    "[[item]]\nname = \"Below\"\n";

TEST(WidgetUse, OnePageShowsAndItIsTheOneThatWasChosen) {
  for (const int way : {0, 1, 2, 3}) {
    UsedElement it(kTabs);
    EXPECT_NE(it.use.layout().widget(it.widget("A")), nullptr);
    EXPECT_EQ(it.use.layout().widget(it.widget("C")), nullptr);
    if (way == 0) {
      EXPECT_EQ(it.hand.click("P2"), "P2");
    }
    if (way == 1) {
      EXPECT_EQ(it.hand.push("P2"), "P2");
    }
    if (way == 2) {
      it.use.press(ElementKey::Down);
      EXPECT_EQ(it.use.press(ElementKey::Right)->widget->name, "P2");
      EXPECT_EQ(it.use.lit()->name, "P2");
    }
    if (way == 3) {
      EXPECT_EQ(it.use.choose("P2")->by, ChosenBy::Name);
    }
    EXPECT_EQ(it.use.layout().widget(it.widget("A")), nullptr);
    EXPECT_NE(it.use.layout().widget(it.widget("C")), nullptr);
    EXPECT_EQ(it.use.settings().of(it.widget("Tabs")).chosen->name, "P2");
    EXPECT_EQ(it.hand.click("C"), "C");
    EXPECT_TRUE(it.use.is_checked(it.widget("C")));
  }
}

TEST(WidgetUse, ANameOnAnotherPageShowsThatPage) {
  UsedElement it(kTabs);
  EXPECT_EQ(it.use.choose("E")->widget->name, "E");
  EXPECT_EQ(it.use.settings().of(it.widget("Tabs")).chosen->name, "P4");
  EXPECT_EQ(it.use.open().size(), 1U);
  EXPECT_NE(it.use.layout().widget(it.widget("F")), nullptr);
  EXPECT_EQ(it.use.choose("B")->widget->name, "B");
  EXPECT_TRUE(it.use.open().empty()) << "a menu of a page goes with it";
  EXPECT_FALSE(it.use.choose("D")) << "its page is disabled";
  EXPECT_EQ(it.use.settings().of(it.widget("Tabs")).chosen->name, "P1");
  EXPECT_FALSE(it.use.choose("Tabs"));
}

TEST(WidgetUse, KeysGoThroughThePageThatShowsAndPassDisabledPages) {
  UsedElement it(kTabs);
  std::string way;
  for (int i = 0; i < 4; ++i) {
    it.use.press(ElementKey::Down);
    way += it.use.lit()->name + " ";
  }
  EXPECT_EQ(way, "P1 A B Below ");
  while (it.use.lit()->name != "P1") it.use.press(ElementKey::Down);
  it.use.press(ElementKey::Right);
  EXPECT_EQ(it.use.press(ElementKey::Right)->widget->name, "P4");
  EXPECT_FALSE(it.use.press(ElementKey::Right));
  EXPECT_EQ(it.use.press(ElementKey::Left)->widget->name, "P2");
}

// On an element with all of them: whatever is pushed, at most one thing is chosen by a push, and the hand
// that comes back may push again.
TEST(WidgetUse, APushChoosesAtMostOnce) {
  const std::string toml = std::string(kPicker) + kNumbers + list_of(30, 5) + kTabs;
  std::string unique = toml;
  const auto rename = [&](const std::string& from, const std::string& to) {
    const auto at = unique.rfind(from);
    unique.replace(at, from.size(), to);
  };
  rename("\"Below\"", "\"Below too\"");
  UsedElement it(unique);
  base::Random random(4);
  std::size_t chosen = 0;
  for (int i = 0; i < repeats(1500); ++i) {
    const LaidSheet& sheet = it.use.layout().sheets.front();
    const Vector2 place =
        sheet.centre + sheet.half.cwiseProduct(Vector2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)));
    const std::uint64_t before = it.use.pushes();
    const std::string names = it.hand.push_at(place);
    EXPECT_EQ(it.use.pushes(), before + 1);
    EXPECT_TRUE(names.empty() || find_widget(it.element.widgets, names) != nullptr) << names;
    chosen += names.empty() ? 0 : 1;
    EXPECT_FALSE(it.use.is_holding());
  }
  EXPECT_GT(chosen, std::size_t(repeats(1500)) / 3);
}

TEST(WidgetUse, ValuesReachTheArgumentsOfOperations) {
  UsedElement it(
      "[[item]]\nname = \"Colour\"\nkind = \"colour\"\nvalue = \"#336699\"\noperation = \"colour\"\n"
      "value_as = \"colour\"\nwith = { shared = true }\n"
      "[[item]]\nname = \"Radius\"\nkind = \"number\"\nvalue = 20\nunit = \"mm\"\noperation = \"reshape\"\n"
      "value_as = \"radius\"\nvalue_times = 0.001\nleast = 1\n"
      "[[item]]\nname = \"Shapes\"\nkind = \"list\"\noperation = \"create\"\nvalue_as = \"shape\"\n"
      "[[item.item]]\nname = \"box\"\n[[item.item]]\nname = \"sphere\"\n"
      "[[item.item]]\nname = \"Other\"\noperation = \"undo\"\n");
  const auto call = [&](const char* name) {
    const OperationCall made = it.use.settings().call_of(it.widget(name));
    return made.operation + " " + json_from_value(made.arguments);
  };
  EXPECT_EQ(call("Colour"), "colour {\"shared\":true,\"colour\":\"#336699\"}");
  EXPECT_EQ(call("Radius"), "reshape {\"radius\":0.02}");
  EXPECT_EQ(call("sphere"), "create {\"shape\":\"sphere\"}");
  EXPECT_EQ(call("Other"), "undo {}");
  it.use.press(ElementKey::Down);
  it.use.press(ElementKey::Down);
  it.use.press(ElementKey::Right);
  EXPECT_EQ(call("Radius"), "reshape {\"radius\":0.021}");
}

}  // namespace
}  // namespace icome::interaction
