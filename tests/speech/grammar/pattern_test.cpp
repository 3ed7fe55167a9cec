#include "speech/grammar/pattern.h"

#include <gtest/gtest.h>

namespace icome::speech {
namespace {

TEST(Pattern, ReadsWhatItWrites) {
  for (const char* text : {"make it", "(make | colour) <objects> [in] <colour>", "[the [red | blue]] box"}) {
    const auto pattern = pattern_from_text(text);
    ASSERT_TRUE(pattern) << text;
    const auto again = pattern_from_text(text_of(*pattern));
    ASSERT_TRUE(again) << text_of(*pattern);
    EXPECT_EQ(*again, *pattern);
  }
}

TEST(Pattern, SaysWhereItIsWrong) {
  for (const auto& [text, place] :
       {std::pair{"make (it", "at letter 9"}, std::pair{"make it)", "at letter 8"},
        std::pair{"make | | it", "at letter 8"}, std::pair{"", "at letter 1"},
        std::pair{"make <it", "at letter 6"}, std::pair{"Make it", "at letter 1"},
        std::pair{"make it!", "at letter 8"}, std::pair{"a {}", "at letter 3"}}) {
    const auto pattern = pattern_from_text(text);
    ASSERT_FALSE(pattern) << text;
    EXPECT_NE(pattern.error().message.find(place), std::string::npos) << pattern.error().message;
  }
}

TEST(Pattern, RefusesEndlessNesting) {
  const auto pattern = pattern_from_text(std::string(100'000, '('));
  ASSERT_FALSE(pattern);
  EXPECT_NE(pattern.error().message.find("deep"), std::string::npos);
}

}  // namespace
}  // namespace icome::speech
