#include "charts/lettering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "charts/canvas.h"

namespace icome::charts {
namespace {

/// The first and last column of a picture with ink in it.
std::pair<int, int> ink_of(const Image& image) {
  std::pair<int, int> ink{image.width, -1};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (image.pixel(x, y)[0] > 128) continue;
      ink.first = std::min(ink.first, x);
      ink.second = std::max(ink.second, x);
    }
  return ink;
}

TEST(Printable, ReplacesWhatIsNotUtf8) {
  EXPECT_EQ(printable("b\u00fcste \u4e2d"), "b\u00fcste \u4e2d");
  EXPECT_EQ(printable("a\xff"
                      "b"),
            "a\ufffd"
            "b");
  EXPECT_EQ(printable("\xc3"), "\ufffd");                      // cut short
  EXPECT_EQ(printable("\xc0\xaf"), "\ufffd\ufffd");            // an overlong slash
  EXPECT_EQ(printable("\xed\xa0\x80"), "\ufffd\ufffd\ufffd");  // a surrogate
  EXPECT_EQ(printable("a\tb"), "a b");
}

TEST(Lettering, TextIsAsWideAsItIsDrawn) {
  for (const char* const text :
       {"HHHH", "Surface contact", "\u0627\u0644\u0633\u0644\u0627\u0645", "\u05e9\u05dc\u05d5\u05dd"}) {
    constexpr double kSize = 40.0;
    Canvas canvas(600, 100, 1.0);
    canvas.text({50, 60}, text, {kSize, {}, false});
    const auto [left, right] = ink_of(canvas.snapshot());
    const double width = line_width(text) * kCapitalHeight * kSize;
    EXPECT_NEAR(canvas.text_width(text, {kSize, {}, false}), width, 1e-9);
    EXPECT_NEAR(left, 50, 0.15 * kSize) << text;
    EXPECT_NEAR(right, 50 + width, 0.15 * kSize) << text;
  }
}

TEST(Lettering, WidthsDoNotDependOnWhatWasDrawnBefore) {
  const double before = line_width("Surface contact point");
  Canvas canvas(300, 300, 0.37);
  canvas.text({200, 100}, "turned", {9.0, {}, true, 0.5, 0.7});
  EXPECT_EQ(line_width("Surface contact point"), before);
  double elsewhere = 0.0;
  std::thread([&] { elsewhere = line_width("Surface contact point"); }).join();
  EXPECT_EQ(elsewhere, before);
}

TEST(Lettering, LettersThatJoinAreSetTogether) {
  // Seen, lam, alif, meem: their joined forms, with lam and alif as one.
  const double word = line_width("\u0633\u0644\u0627\u0645");
  double alone = 0.0;
  for (const char* const letter : {"\u0633", "\u0644", "\u0627", "\u0645"}) alone += line_width(letter);
  EXPECT_LT(word, 0.85 * alone);
  EXPECT_GT(word, 0.3 * alone);
}

TEST(Lettering, LettersThatNoFontHasAreTold) {
  // Letters of a private plane, which fonts leave alone.
  EXPECT_EQ(letters_without_font("a\U0010fffdb\U0010fffd c\U0010fffc"), "\U0010fffd\U0010fffc");
  EXPECT_EQ(letters_without_font("Sketch \u00e9\u0416\u05d0\u0633"), "");
  EXPECT_EQ(letters_without_font(""), "");
}

}  // namespace
}  // namespace icome::charts
