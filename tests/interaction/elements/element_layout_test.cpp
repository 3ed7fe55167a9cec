#include "interaction/elements/element_layout.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/random.h"
#include "interaction/elements/element_samples.h"

namespace icome::interaction {
namespace {

Element random_element(base::Random& random, ElementKind kind, std::size_t count) {
  Element element;
  element.kind = kind;
  element.title = {random.index(2) == 0 ? "" : "A title of several words"};
  element.columns = std::uint32_t(random.index(6));
  for (std::size_t i = 0; i < count; ++i) {
    Widget widget;
    widget.name = std::string(1 + random.index(20), 'm');
    widget.text = {widget.name};
    widget.kind = WidgetKind(random.index(6));
    if (random.index(3) == 0) widget.icon = "red";
    if (widget.kind == WidgetKind::Item && random.index(3) == 0)
      for (std::size_t k = 0; k < 3; ++k) widget.widgets.push_back({.name = "below", .text = {"below"}});
    element.widgets.push_back(widget);
  }
  return element;
}

bool overlap(const LaidWidget& a, const LaidWidget& b) {
  const Vector2 between = (a.centre - b.centre).cwiseAbs(), sum = a.half + b.half;
  return between.x() < sum.x() - 1e-9 && between.y() < sum.y() - 1e-9;
}

TEST(ElementLayout, KeepsWidgetsApartAndOnTheirSheet) {
  base::Random random(1);
  for (int i = 0; i < 400; ++i) {
    const auto kind = ElementKind(random.index(5));
    const Element element = random_element(random, kind, 1 + random.index(40));
    std::vector<const Widget*> open;
    for (const Widget& widget : element.widgets)
      if (!widget.widgets.empty() && open.empty()) open.push_back(&widget);
    const ElementLayout layout = lay_out(element, 0, even_letters(), open);
    ASSERT_EQ(layout.sheets.size(), 1 + open.size());
    ASSERT_EQ(layout.widgets.size(), element.widgets.size() + (open.empty() ? 0 : 3));
    for (std::size_t a = 0; a < layout.widgets.size(); ++a) {
      const LaidWidget& laid = layout.widgets[a];
      const LaidSheet& sheet = layout.sheets[laid.sheet];
      EXPECT_TRUE(
          (((laid.centre - sheet.centre).cwiseAbs() + laid.half).array() <= sheet.half.array() + 1e-9).all());
      EXPECT_GE(2.0 * laid.half.x() + 1e-9, laid.widget->kind == WidgetKind::Item
                                                ? element.text_height * 0.8 * double(laid.widget->name.size())
                                                : 0.0);
      for (std::size_t b = a + 1; b < layout.widgets.size(); ++b)
        EXPECT_FALSE(layout.widgets[b].sheet == laid.sheet && overlap(laid, layout.widgets[b])) << i;
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
