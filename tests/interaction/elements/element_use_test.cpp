#include "interaction/elements/element_use.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "interaction/elements/element_hand.h"

namespace icome::interaction {
namespace {

constexpr const char* kMenu =
    "languages = [\"en\", \"nl\"]\ncentre = [0.1, 0.2, -0.3]\nturn_deg = 40\n"
    "[[item]]\nname = \"One\"\ntext = { en = \"One\", nl = \"Een\" }\n"
    "[[item]]\nname = \"Off\"\nenabled = false\n"
    "[[item]]\nname = \"More\"\n"
    "[[item.item]]\nname = \"Deep\"\n[[item.item.item]]\nname = \"Deepest\"\n"
    "[[item]]\nname = \"Tick\"\nkind = \"check\"\n"
    "[[item]]\nname = \"A\"\nkind = \"radio\"\ngroup = \"g\"\nchecked = true\n"
    "[[item]]\nname = \"B\"\nkind = \"radio\"\ngroup = \"g\"\n"
    "[[item]]\nname = \"Size\"\nkind = \"slider\"\nleast = 10\nmost = 20\nstep = 2\n";

struct Fixture : UsedElement {
  explicit Fixture(const std::string& toml = kMenu) : UsedElement(toml) {}
};

TEST(ElementUse, APointerThatRestsLeavesTheLightToTheKeys) {
  Fixture it;
  it.hand.move(it.hand.at("One", 0.01), 0.1);
  EXPECT_EQ(it.use.lit()->name, "One");
  it.use.press(ElementKey::Down);
  it.hand.move(it.hand.tip(), 0.1);
  EXPECT_EQ(it.use.lit()->name, "More");
  it.hand.move(it.hand.at("Tick", 0.01), 0.1);
  EXPECT_EQ(it.use.lit()->name, "Tick");
}

TEST(ElementUse, ClickAndPushChooseTheSame) {
  for (const std::string name : {"One", "Tick", "B"}) {
    Fixture clicked, pushed;
    EXPECT_EQ(clicked.hand.click(name), name);
    EXPECT_EQ(pushed.hand.push(name), name);
    EXPECT_EQ(pushed.use.pushes(), 1U);
  }
}

TEST(ElementUse, ADisabledItemNeitherLightsNorChooses) {
  Fixture it;
  EXPECT_EQ(it.hand.click("Off"), "");
  EXPECT_EQ(it.use.lit(), nullptr);
  EXPECT_EQ(it.hand.push("Off"), "");
  EXPECT_FALSE(it.use.choose("Off").has_value());
}

TEST(ElementUse, NearIsEnoughToLightUp) {
  Fixture it;
  it.hand.move(it.hand.at("One", 0.021), 0.1);
  EXPECT_FALSE(it.use.is_near());
  it.hand.move(it.hand.at("One", 0.019), 0.1);
  EXPECT_TRUE(it.use.is_near());
  ASSERT_NE(it.use.lit(), nullptr);
  EXPECT_EQ(it.use.lit()->name, "One");
}

// A hand that trembles by half a millimetre round the depth where a push counts pushes once.
TEST(ElementUse, ATremblingHandPushesOnce) {
  base::Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    Fixture it;
    std::string chosen = it.hand.move(it.hand.at("One", 0.01), 0.1);
    const double around = random.uniform(0.003, 0.005), hertz = random.uniform(6.0, 12.0);
    for (int i = 0; i < 1000; ++i) {
      const double depth = std::min(around, 0.00003 * i) + 0.0005 * std::sin(6.283 * hertz * i / 1000.0);
      chosen += it.hand.move(it.hand.at("One", -depth), 0.001);
    }
    EXPECT_LE(chosen, "One");
    EXPECT_LE(it.use.pushes(), 1U);
    EXPECT_GE(it.use.pushes(), around > 0.0036 ? 1U : 0U);
  }
}

TEST(ElementUse, AHandFromBehindPushesNothing) {
  Fixture it;
  it.hand.move(it.hand.at("One", -0.05) + 0.5 * it.use.frame().right(), 0.1);  // behind, beside it
  EXPECT_EQ(it.hand.move(it.hand.at("One", -0.05), 0.1), "");
  EXPECT_EQ(it.hand.move(it.hand.at("One", 0.01), 0.2), "");
  EXPECT_EQ(it.use.pushes(), 0U);
  EXPECT_EQ(it.hand.push("One"), "One");
}

TEST(ElementUse, APushIsAsDeepAsItIsSetTo) {
  Fixture it;
  it.hand.move(it.hand.at("One", 0.01), 0.1);
  EXPECT_EQ(it.hand.move(it.hand.at("One", -0.0029), 0.1), "");
  EXPECT_EQ(it.hand.move(it.hand.at("One", -0.0031), 0.1), "One");
}

// Where the ground carries from both sides, a hand behind it stays behind while it presses through to the
// front.
TEST(ElementUse, NobodyPushesFromBehindThroughAGroundOfTwoSides) {
  Fixture it(std::string("ground = { both_sides = true }\n") + kMenu);
  it.hand.move(it.hand.at("One", -0.05) + 0.5 * it.use.frame().right(), 0.1);
  it.hand.move(it.hand.at("One", -0.05), 0.1);
  EXPECT_EQ(it.hand.move(it.hand.at("One", 0.005), 0.2), "");
  EXPECT_EQ(it.hand.move(it.hand.at("One", -0.01), 0.2), "");
  EXPECT_EQ(it.use.pushes(), 0U);
}

TEST(ElementUse, MenusOpenAndCloseWhenThePointerRecedes) {
  Fixture it;
  EXPECT_EQ(it.hand.push("More"), "More");
  ASSERT_EQ(it.use.open().size(), 1U);
  EXPECT_EQ(it.hand.click("Deep"), "Deep");
  ASSERT_EQ(it.use.open().size(), 2U);
  it.hand.move(it.hand.at("Deepest", 0.01), 0.1);
  EXPECT_EQ(it.use.open().size(), 2U);
  it.hand.move(it.hand.at("Deepest", 0.08), 0.1);
  it.hand.move(it.hand.at("Deepest", 0.08), 0.5);
  EXPECT_TRUE(it.use.open().empty());
  // Choosing what does something closes them, too.
  it.hand.click("More");
  it.hand.click("Deep");
  EXPECT_EQ(it.hand.click("Deepest"), "Deepest");
  EXPECT_TRUE(it.use.open().empty());
}

TEST(ElementUse, TicksRadiosAndSlidersKeepWhatIsSet) {
  Fixture it;
  const auto widget = [&](const char* name) -> const Widget& {
    return *find_widget(it.element.widgets, name);
  };
  it.hand.click("Tick");
  EXPECT_TRUE(it.use.is_checked(widget("Tick")));
  it.hand.push("Tick");
  EXPECT_FALSE(it.use.is_checked(widget("Tick")));
  it.hand.push("B");
  EXPECT_TRUE(it.use.is_checked(widget("B")));
  EXPECT_FALSE(it.use.is_checked(widget("A")));
  // The middle of the groove is the middle of the range, in steps of 2.
  const LaidWidget* slider = nullptr;
  for (const LaidWidget& laid : it.use.layout().widgets)
    if (laid.widget == &widget("Size")) slider = &laid;
  const SliderGroove groove = groove_of(*slider, it.element.text_height);
  const Vector2 place(groove.left + 0.62 * (groove.right - groove.left), slider->centre.y());
  it.hand.move(it.use.frame().in_world(place) + 0.01 * it.use.frame().normal(), 0.1);
  EXPECT_EQ(it.hand.move(it.hand.tip(), 0.01, true), "") << "it is held";
  EXPECT_EQ(it.hand.move(it.hand.tip(), 0.01), "Size");
  EXPECT_EQ(it.use.value_of(widget("Size")), 16.0);
}

TEST(ElementUse, KeysReachEverythingThatThePointerDoes) {
  Fixture it;
  EXPECT_FALSE(it.use.press(ElementKey::Down));
  ASSERT_NE(it.use.lit(), nullptr);
  EXPECT_EQ(it.use.press(ElementKey::Enter)->widget->name, "One");
  it.use.press(ElementKey::Down);  // over the disabled one
  EXPECT_EQ(it.use.lit()->name, "More");
  EXPECT_EQ(it.use.press(ElementKey::Enter)->widget->name, "More");
  EXPECT_EQ(it.use.lit()->name, "Deep") << "Enter goes into a menu as Right does";
  it.use.press(ElementKey::Left);
  EXPECT_EQ(it.use.press(ElementKey::Right)->widget->name, "More");
  EXPECT_EQ(it.use.lit()->name, "Deep");
  it.use.press(ElementKey::Right);
  EXPECT_EQ(it.use.lit()->name, "Deepest");
  it.use.press(ElementKey::Left);
  EXPECT_EQ(it.use.lit()->name, "Deep");
  it.use.press(ElementKey::Escape);
  EXPECT_TRUE(it.use.open().empty());
  it.use.press(ElementKey::Up);
  EXPECT_EQ(it.use.lit()->name, "Size");
  it.use.press(ElementKey::Right);
  EXPECT_EQ(it.use.value_of(*it.use.lit()), 12.0);
}

TEST(ElementUse, KeysGoAsTextsRun) {
  Fixture it(
      "languages = [\"he\"]\n[[item]]\nname = \"More\"\n[[item.item]]\nname = \"Deep\"\n[[item]]\nname = "
      "\"Size\"\nkind = \"slider\"\nmost = 100\nstep = 10\n");
  it.use.press(ElementKey::Down);
  EXPECT_FALSE(it.use.press(ElementKey::Right));
  EXPECT_EQ(it.use.press(ElementKey::Left)->widget->name, "More");
  EXPECT_EQ(it.use.lit()->name, "Deep");
  it.use.press(ElementKey::Right);
  EXPECT_EQ(it.use.lit()->name, "More");
  it.use.press(ElementKey::Down);
  it.use.press(ElementKey::Right);
  EXPECT_EQ(it.use.value_of(*it.use.lit()), 10.0) << "values rise to the right in all languages";
}

TEST(ElementUse, NamesAndWordsOfAnyLanguageChoose) {
  Fixture it;
  EXPECT_EQ(it.use.choose("Een")->widget->name, "One");
  EXPECT_EQ(it.use.choose("Deepest")->widget->name, "Deepest");
  EXPECT_FALSE(it.use.choose("Twee").has_value());
}

TEST(ElementUse, FadesMonotonouslyAndWithoutJumps) {
  Fixture it;
  it.hand.move(it.hand.at("One", 0.2), 0.1);
  double last = it.use.opacity();
  EXPECT_NEAR(last, it.element.fading.least, 1e-9);
  for (int i = 0; i < 2000; ++i) {
    it.hand.move(it.hand.at("One", std::max(0.001, 0.2 - 0.0002 * i)), 0.001);
    EXPECT_GE(it.use.opacity(), last - 1e-12);
    EXPECT_LT(it.use.opacity() - last, 0.02);
    last = it.use.opacity();
  }
  it.hand.move(it.hand.tip(), 10.0);
  last = it.use.opacity();
  EXPECT_NEAR(last, 1.0, 1e-9);
  for (int i = 0; i < 2000; ++i) {
    it.hand.move(it.hand.at("One", std::min(0.2, 0.001 + 0.0002 * i)), 0.001);
    EXPECT_LE(it.use.opacity(), last + 1e-12);
    EXPECT_LT(last - it.use.opacity(), 0.02);
    last = it.use.opacity();
  }
  EXPECT_LT(last, it.element.fading.least + 0.02);
}

TEST(ElementUse, EnterAndEscapeAnswerADialog) {
  Fixture it(
      "kind = \"dialog\"\n[[item]]\nname = \"Clear\"\n[[item]]\nname = \"Keep\"\ndefault = true\ncancel = "
      "true\n");
  EXPECT_EQ(it.use.press(ElementKey::Enter)->widget->name, "Keep");
  EXPECT_EQ(it.use.press(ElementKey::Escape)->widget->name, "Keep");
}

}  // namespace
}  // namespace icome::interaction
