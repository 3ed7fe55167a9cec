#include "speech/words/spoken_words.h"

#include <gtest/gtest.h>

namespace icome::speech {
namespace {

TEST(SpokenWords, AreSmallAndWithoutPunctuation) {
  EXPECT_EQ(joined_words(spoken_words("  Make the BOX red,\tplease! ")), "make the box red please");
  EXPECT_EQ(joined_words(spoken_words("What's \xe2\x80\x98this\xe2\x80\x99? 'It'.")), "what's this it");
  EXPECT_TRUE(spoken_words(" .,;!? ").empty());
  EXPECT_EQ(spoken_words("dark-blue").size(), 2U);
}

TEST(SpokenWords, NumbersAreWords) {
  EXPECT_EQ(joined_words(spoken_words("25 mm")), "twenty five mm");
  EXPECT_EQ(joined_words(spoken_words("1.5 m")), "one point five m");
  EXPECT_EQ(joined_words(spoken_words("cone2")), "cone two");
  EXPECT_EQ(joined_words(spoken_words("007")), "zero zero seven");
  EXPECT_EQ(joined_words(spoken_words("1000")), "one zero zero zero");
  EXPECT_EQ(joined_words(spoken_words("3.")), "three");
}

TEST(SpokenWords, WholeNumbersUpToTheThousandReadAsPeopleSayThem) {
  EXPECT_EQ(number_words(0), "zero");
  EXPECT_EQ(number_words(13), "thirteen");
  EXPECT_EQ(number_words(40), "forty");
  EXPECT_EQ(number_words(100), "one hundred");
  EXPECT_EQ(number_words(999), "nine hundred ninety nine");
}

TEST(SpokenWords, SpellingsThatAreHeardAlikeAreOne) {
  EXPECT_EQ(joined_words(spoken_words("Color it", {{"color", "colour"}})), "colour it");
}

}  // namespace
}  // namespace icome::speech
