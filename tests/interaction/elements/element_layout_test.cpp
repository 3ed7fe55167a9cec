#include "interaction/elements/element_layout.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "base/random.h"
#include "interaction/elements/element_samples.h"

namespace icome::interaction {
namespace {

Widget random_widget(base::Random& random, WidgetKind kind) {
  Widget widget;
  widget.kind = kind;
  widget.name = std::string(1 + random.index(20), 'm');
  widget.text = {widget.name};
  if (random.index(3) == 0) widget.icon = "red";
  widget.least = -double(random.index(10'000));
  widget.most = double(random.index(10'000)) + 1.0;
  if (random.index(2) == 0) widget.unit = "mm";
  return widget;
}

/// Widgets of all kinds that may lie below each other, with more in them.
std::vector<Widget> random_column(base::Random& random, std::size_t count, int depth) {
  std::vector<Widget> widgets;
  for (std::size_t i = 0; i < count; ++i) {
    constexpr std::array kKinds = {
        WidgetKind::Item,      WidgetKind::Check,  WidgetKind::Radio, WidgetKind::Slider, WidgetKind::Label,
        WidgetKind::Separator, WidgetKind::Number, WidgetKind::List,  WidgetKind::Colour, WidgetKind::Tabs};
    Widget widget = random_widget(random, kKinds[random.index(kKinds.size())]);
    if (widget.kind == WidgetKind::Tabs && depth == 0) widget.kind = WidgetKind::Item;
    if (widget.kind == WidgetKind::List) {
      if (random.index(2) == 0) widget.text.clear();
      widget.rows = std::uint32_t(3 + random.index(8));
      for (std::size_t k = 1 + random.index(20); k-- > 0;)
        widget.widgets.push_back(random_widget(random, WidgetKind::Row));
    }
    if (widget.kind == WidgetKind::Tabs)
      for (std::size_t k = 1 + random.index(4); k-- > 0;) {
        Widget page = random_widget(random, WidgetKind::Page);
        page.widgets = random_column(random, 1 + random.index(5), depth - 1);
        widget.widgets.push_back(page);
      }
    if (widget.kind == WidgetKind::Item && random.index(3) == 0)
      for (std::size_t k = 0; k < 3; ++k) widget.widgets.push_back({.name = "below", .text = {"below"}});
    widgets.push_back(widget);
  }
  return widgets;
}

Element random_element(base::Random& random, ElementKind kind, std::size_t count) {
  Element element;
  element.kind = kind;
  element.title = {random.index(2) == 0 ? "" : "A title of several words"};
  element.columns = std::uint32_t(random.index(6));
  if (kind == ElementKind::Menu || kind == ElementKind::Dialog) {
    element.widgets = random_column(random, count, 2);
    return element;
  }
  for (std::size_t i = 0; i < count; ++i) {
    Widget widget = random_widget(random, WidgetKind(random.index(7)));
    if (widget.kind == WidgetKind::Item && random.index(3) == 0)
      for (std::size_t k = 0; k < 3; ++k) widget.widgets.push_back({.name = "below", .text = {"below"}});
    element.widgets.push_back(widget);
  }
  return element;
}

/// Some pages and rows of all that is in the widgets.
void show_at_random(base::Random& random, const std::vector<Widget>& widgets, ShownParts& shown) {
  for (const Widget& widget : widgets) {
    if (widget.kind == WidgetKind::Tabs)
      shown.pages[&widget] = &widget.widgets[random.index(widget.widgets.size())];
    if (widget.kind == WidgetKind::List) shown.first_rows[&widget] = random.index(30);
    show_at_random(random, widget.widgets, shown);
  }
}

bool overlap(const LaidBox& a, const LaidBox& b) {
  const Vector2 between = (a.centre - b.centre).cwiseAbs(), sum = a.half + b.half;
  return between.x() < sum.x() - 1e-9 && between.y() < sum.y() - 1e-9;
}

bool is_in(const LaidBox& inner, const LaidBox& outer) {
  return (((inner.centre - outer.centre).cwiseAbs() + inner.half).array() <= outer.half.array() + 1e-9).all();
}

LaidBox box_of(const LaidWidget& laid) { return {laid.centre, laid.half}; }
LaidBox box_of(const LaidSheet& sheet) { return {sheet.centre, sheet.half}; }

void expect_apart(const ElementLayout& layout) {
  for (std::size_t a = 0; a < layout.widgets.size(); ++a) {
    const LaidWidget& laid = layout.widgets[a];
    EXPECT_TRUE(is_in(box_of(laid), box_of(layout.sheets[laid.sheet])));
    for (std::size_t b = a + 1; b < layout.widgets.size(); ++b)
      EXPECT_FALSE(layout.widgets[b].sheet == laid.sheet && overlap(box_of(laid), box_of(layout.widgets[b])));
  }
}

/// Handles lie apart from each other and from all widgets but their own number, in which they lie.
void expect_handles_apart(const ElementLayout& layout) {
  for (std::size_t a = 0; a < layout.handles.size(); ++a) {
    const LaidHandle& handle = layout.handles[a];
    EXPECT_TRUE(is_in(handle.box, box_of(layout.sheets[handle.sheet])));
    for (std::size_t b = a + 1; b < layout.handles.size(); ++b)
      EXPECT_FALSE(layout.handles[b].sheet == handle.sheet && overlap(handle.box, layout.handles[b].box));
    for (const LaidWidget& laid : layout.widgets) {
      if (laid.sheet != handle.sheet) continue;
      const bool is_own = laid.widget == handle.of && laid.widget->kind == WidgetKind::Number;
      EXPECT_EQ(overlap(handle.box, box_of(laid)), is_own);
      if (is_own) {
        EXPECT_TRUE(is_in(handle.box, box_of(laid)));
      }
    }
  }
}

/// Rows that are seen are those that follow on each other in their list, never past its ends.
void expect_rows(const ElementLayout& layout, const ShownParts& shown) {
  for (const LaidColumn& column : layout.columns) {
    const std::vector<Widget>& rows = column.of->widgets;
    EXPECT_EQ(column.count, rows.size());
    EXPECT_LE(column.first + column.seen, column.count);
    const auto asked = shown.first_rows.find(column.of);
    if (asked != shown.first_rows.end()) {
      EXPECT_EQ(column.first, std::min(asked->second, column.last_first()));
    }
    double last = 1e9;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const LaidWidget* const laid = layout.widget(rows[i]);
      EXPECT_EQ(laid != nullptr, i >= column.first && i < column.first + column.seen);
      if (laid == nullptr) continue;
      EXPECT_TRUE(is_in(box_of(*laid), column.box));
      EXPECT_LT(laid->centre.y(), last);
      last = laid->centre.y();
    }
  }
}

TEST(ElementLayout, KeepsWidgetsApartAndOnTheirSheet) {
  base::Random random(1);
  std::size_t columns = 0, frames = 0;
  for (int i = 0; i < 400; ++i) {
    const auto kind = ElementKind(random.index(5));
    const bool is_column = kind == ElementKind::Menu || kind == ElementKind::Dialog;
    const Element element = random_element(random, kind, 1 + random.index(is_column ? 8 : 40));
    ShownParts shown;
    show_at_random(random, element.widgets, shown);
    std::vector<const Widget*> open;
    for (const Widget& widget : element.widgets)
      if (widget.opens_menu() && open.empty()) open.push_back(&widget);
    const ElementLayout layout = lay_out(element, 0, even_letters(), open, shown);
    ASSERT_EQ(layout.sheets.size(), 1 + open.size());
    if (!is_column) {
      ASSERT_EQ(layout.widgets.size(), element.widgets.size() + (open.empty() ? 0 : 3));
    }
    expect_apart(layout);
    expect_handles_apart(layout);
    expect_rows(layout, shown);
    for (const LaidFrame& frame : layout.frames)
      EXPECT_TRUE(is_in(frame.box, box_of(layout.sheets[frame.sheet])));
    for (const LaidWidget& laid : layout.widgets) {
      EXPECT_GE(2.0 * laid.half.x() + 1e-9, laid.widget->kind == WidgetKind::Item
                                                ? element.text_height * 0.8 * double(laid.widget->name.size())
                                                : 0.0);
      if (laid.widget->kind != WidgetKind::Colour) continue;
      const ColourWheel wheel = wheel_of(laid, element.text_height);
      EXPECT_TRUE(is_in({wheel.centre, Vector2::Constant(wheel.outer)}, box_of(laid)));
      EXPECT_LT(wheel.corner, wheel.inner);
    }
    columns += layout.columns.size();
    frames += layout.frames.size();
    if (testing::Test::HasFailure()) FAIL() << i;
  }
  EXPECT_GT(columns, 50U);
  EXPECT_GT(frames, 100U);
}

TEST(ElementLayout, MenusStayInTheRoomThatTheyHaveAndScrollWhereTheyAreTooHigh) {
  base::Random random(2);
  std::size_t scrolled = 0, to_the_left = 0;
  for (int i = 0; i < repeats(200); ++i) {
    std::string toml, key = "item";
    for (int depth = 0; depth < 8; ++depth, key += ".item")
      for (std::size_t row = 0, rows = 1 + random.index(30); row < rows; ++row)
        toml += "[[" + key + "]]\nname = \"" + std::to_string(depth) + "-" + std::to_string(row) + "\"\n";
    const Element element = element_of(toml);
    std::vector<const Widget*> open;
    for (const Widget* it = &element.widgets.back(); it->opens_menu(); it = &it->widgets.back())
      open.push_back(it);
    ShownParts shown;
    shown.room = LaidBox{{random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02)},
                         {random.uniform(0.05, 0.3), random.uniform(0.05, 0.3)}};
    // Whatever scrolls is scrolled to the item that opens the next menu.
    for (const Widget* const it : open) shown.first_rows[it] = 1000;
    shown.first_rows[nullptr] = 1000;
    const ElementLayout layout = lay_out(element, 0, even_letters(), open, shown);
    ASSERT_EQ(layout.sheets.size(), open.size() + 1);
    EXPECT_LE(layout.sheets.front().half.y(), shown.room->half.y() + 1e-12);
    for (std::size_t k = 1; k < layout.sheets.size(); ++k) {
      EXPECT_TRUE(is_in(box_of(layout.sheets[k]), *shown.room)) << i << ' ' << k;
      to_the_left += layout.sheets[k].centre.x() < layout.sheets[k - 1].centre.x() ? 1 : 0;
    }
    expect_handles_apart(layout);
    scrolled += layout.columns.size();
    if (testing::Test::HasFailure()) FAIL() << i;
  }
  EXPECT_GT(scrolled, std::size_t(repeats(200)) / 4);
  EXPECT_GT(to_the_left, std::size_t(repeats(200)) / 4);
}

TEST(ElementLayout, LanguagesThatRunFromTheRightAreTheOtherWayRound) {
  EXPECT_TRUE(writes_leftward("ar") && writes_leftward("he-IL") && writes_leftward("fa_IR"));
  EXPECT_FALSE(writes_leftward("en") || writes_leftward("arn") || writes_leftward(""));
  base::Random random(4);
  std::size_t numbers = 0;
  for (int i = 0; i < repeats(200); ++i) {
    const auto kind = ElementKind(random.index(5));
    Element element = random_element(random, kind, 1 + random.index(8));
    ShownParts shown;
    show_at_random(random, element.widgets, shown);
    std::vector<const Widget*> open;
    for (const Widget& widget : element.widgets)
      if (widget.opens_menu() && open.empty()) open.push_back(&widget);
    const ElementLayout usual = lay_out(element, 0, even_letters(), open, shown);
    element.languages = {"ar"};
    const ElementLayout other = lay_out(element, 0, even_letters(), open, shown);
    const bool is_round = kind == ElementKind::Ring || kind == ElementKind::Pie;
    ASSERT_EQ(other.leftward, !is_round);
    expect_apart(other);
    expect_handles_apart(other);
    const auto mirrored = [&](const Vector2& place) {
      return Vector2(is_round ? place.x() : -place.x(), place.y());
    };
    ASSERT_EQ(other.widgets.size(), usual.widgets.size());
    for (const LaidWidget& laid : usual.widgets) {
      const LaidWidget& its = *other.widget(*laid.widget);
      EXPECT_EQ(its.centre, mirrored(laid.centre));
      EXPECT_EQ(its.half, laid.half);
      if (laid.widget->kind == WidgetKind::Number) {
        const LaidBox field = field_of(other, *laid.widget);
        EXPECT_GT(field.half.x(), 0.0) << "the minus is left of the plus, as digits run";
        EXPECT_TRUE(is_in(field, box_of(its)));
        ++numbers;
      }
      if (laid.widget->kind != WidgetKind::Slider) continue;
      const SliderGroove here = groove_of(its, element.text_height),
                         there = groove_of(laid, element.text_height);
      EXPECT_NEAR(here.right - here.left, there.right - there.left, 1e-12);
      EXPECT_NEAR(here.left - its.centre.x(),
                  is_round ? there.left - laid.centre.x() : laid.centre.x() - there.right, 1e-12);
    }
    if (!open.empty() && !is_round) {
      EXPECT_LT(other.sheets[1].centre.x(), other.sheets[0].centre.x());
    }
    if (testing::Test::HasFailure()) FAIL() << i;
  }
  EXPECT_GT(numbers, std::size_t(repeats(200)) / 10);
}

TEST(ElementLayout, ManyButtonsOfADialogLieInRowsAndLongWordsOfAMenuInLines) {
  std::string toml = "kind = \"dialog\"\nwidth_m = 0.1\n";
  for (int i = 0; i < 11; ++i) toml += "[[item]]\nname = \"Button " + std::to_string(i) + "\"\n";
  const Element dialog = element_of(toml);
  const ElementLayout laid = lay_out(dialog, 0, even_letters());
  EXPECT_LE(2.0 * laid.sheets.front().half.x(), 0.1 + 1e-9);
  expect_apart(laid);
  EXPECT_GT(laid.widget(dialog.widgets.front())->centre.y(), laid.widget(dialog.widgets.back())->centre.y());
  const Element menu = element_of("[[item]]\nkind = \"label\"\ntext = \"" + std::string(40, 'a') + " " +
                                  std::string(40, 'b') + "\"\n[[item]]\nname = \"One\"\n");
  const ElementLayout lines = lay_out(menu, 0, even_letters());
  EXPECT_EQ(lines.widgets.front().lines.size(), 2U);
  expect_apart(lines);
}

TEST(ElementLayout, NumbersBelowEachOtherHaveTheirSignsBelowEachOther) {
  const Element element = element_of(
      "[[item]]\nname = \"A\"\nkind = \"number\"\nmost = 3\n[[item]]\nname = \"B\"\nkind = \"number\"\n"
      "most = 1000000000\nunit = \"mm\"\n");
  const ElementLayout layout = lay_out(element, 0, even_letters());
  const auto x = [&](HandleKind kind, std::size_t number) {
    return layout.handle(kind, &element.widgets[number])->box.centre.x();
  };
  EXPECT_EQ(x(HandleKind::Less, 0), x(HandleKind::Less, 1));
  EXPECT_EQ(x(HandleKind::More, 0), x(HandleKind::More, 1));
}

TEST(ElementLayout, MenusOfARingOpenOnTheSideOfTheirItem) {
  std::string toml = "kind = \"ring\"\n";
  for (int i = 0; i < 8; ++i)
    toml += "[[item]]\nname = \"" + std::to_string(i) + "\"\n[[item.item]]\nname = \"in " +
            std::to_string(i) + "\"\n";
  const Element element = element_of(toml);
  for (const Widget& opener : element.widgets) {
    const std::vector<const Widget*> open{&opener};
    const ElementLayout layout = lay_out(element, 0, even_letters(), open);
    const double item = layout.widget(opener)->centre.x();
    if (std::abs(item) > 0.5 * element.text_height) {
      EXPECT_GT(item * layout.sheets[1].centre.x(), 0.0) << opener.name;
    }
  }
}

TEST(ElementLayout, AFieldHoldsEveryValueOfItsNumber) {
  const Element element =
      element_of("[[item]]\nname = \"N\"\nkind = \"number\"\nleast = -1000\nmost = 20000\nunit = \"mm\"\n");
  const ElementLayout layout = lay_out(element, 0, even_letters());
  const LaidBox field = field_of(layout, element.widgets.front());
  EXPECT_GE(2.0 * field.half.x(), 0.8 * 8.0 * element.text_height);
  EXPECT_FALSE(overlap(field, layout.handles[0].box));
  EXPECT_FALSE(overlap(field, layout.handles[1].box));
}

TEST(ElementLayout, TabsAreAsLargeAsTheirLargestPage) {
  base::Random random(3);
  for (int i = 0; i < 100; ++i) {
    Element element;
    Widget tabs = random_widget(random, WidgetKind::Tabs);
    for (std::size_t k = 0; k < 3; ++k) {
      Widget page = random_widget(random, WidgetKind::Page);
      page.widgets = random_column(random, 1 + random.index(6), 1);
      tabs.widgets.push_back(page);
    }
    element.widgets = {tabs};
    const Widget& laid = element.widgets.front();
    const ElementLayout first = lay_out(element, 0, even_letters());
    for (const Widget& page : laid.widgets) {
      const ElementLayout other = lay_out(element, 0, even_letters(), {}, {.pages = {{&laid, &page}}});
      EXPECT_EQ(other.sheets.front().half, first.sheets.front().half);
      for (const Widget& header : laid.widgets)
        EXPECT_EQ(other.widget(header)->centre, first.widget(header)->centre);
      for (const Widget& below : page.widgets)
        if (below.kind != WidgetKind::Tabs && below.kind != WidgetKind::List) {
          EXPECT_NE(other.widget(below), nullptr);
        }
    }
  }
}

TEST(ElementLayout, EveryPlaceOfAPieIsOneItemOrItsMiddle) {
  for (const std::size_t count : {1U, 2U, 5U, 12U, 40U}) {
    base::Random random(count);
    Element element;
    element.kind = ElementKind::Pie;
    for (std::size_t i = 0; i < count; ++i)
      element.widgets.push_back({.name = std::to_string(i), .text = {"one"}});
    const ElementLayout layout = lay_out(element, 0, even_letters());
    const double outer = layout.widgets[0].sector->outer, inner = layout.widgets[0].sector->inner;
    for (int k = 0; k < 2000; ++k) {
      const double radius = random.uniform(0.0, outer), angle = random.uniform(-10.0, 10.0);
      const Vector2 place = radius * Vector2(std::sin(angle), std::cos(angle));
      int found = 0;
      for (const LaidWidget& laid : layout.widgets) found += laid.contains(place) ? 1 : 0;
      EXPECT_EQ(found, radius >= inner ? 1 : 0) << radius << ' ' << angle;
    }
    // Clockwise from the top.
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * double(i) / double(count);
      EXPECT_EQ(layout.at(0.9 * outer * Vector2(std::sin(angle), std::cos(angle)))->widget,
                &element.widgets[i]);
    }
  }
}

TEST(ElementLayout, BreaksTheWordsOfADialog) {
  const Element element = element_of(
      "kind = \"dialog\"\nwidth_m = 0.08\n[[item]]\nkind = \"label\"\ntext = \"one two three four five six "
      "seven\"\n"
      "[[item]]\nname = \"Yes\"\n");
  const ElementLayout layout = lay_out(element, 0, even_letters());
  ASSERT_GT(layout.widgets[0].lines.size(), 1U);
  std::string all;
  for (const std::string& line : layout.widgets[0].lines) {
    EXPECT_LE(0.8 * double(line.size()) * element.text_height, 0.08);
    all += (all.empty() ? "" : " ") + line;
  }
  EXPECT_EQ(all, "one two three four five six seven");
}

}  // namespace
}  // namespace icome::interaction
