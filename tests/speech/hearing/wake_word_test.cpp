#include "speech/hearing/wake_word.h"

#include <gtest/gtest.h>

#include <sstream>

#include "speech/words/spoken_words.h"

namespace icome::speech {
namespace {

Heard said(const std::string& sentence, double behind = 0.0) {
  Heard one{.behind = behind};
  std::istringstream words(sentence);
  double time = 0.0;
  for (std::string word; words >> word; time += 0.5) one.words.push_back({word, time, time + 0.5});
  return one;
}

std::string sentences(const WakeWord::Meant& meant) {
  std::string all;
  for (const Heard& one : meant.sentences) all += one.sentence() + ";";
  return all;
}

TEST(WakeWord, BeginsWhatIsMeant) {
  WakeWord word = *WakeWord::of("Computer");
  EXPECT_EQ(word.text(), "computer");
  const auto meant = word.meant({said("computer a red box"), said("computer the red box", 3.0)}, 10.0, 12.0);
  EXPECT_TRUE(meant.is_meant);
  EXPECT_EQ(sentences(meant), "a red box;the red box;");
  EXPECT_DOUBLE_EQ(meant.sentences[0].words[0].begin, 0.5);  // words keep their times
  EXPECT_FALSE(word.meant({said("a red box")}, 13.0, 14.0).is_meant);
  EXPECT_FALSE(word.meant({}, 15.0, 16.0).is_meant);
}

TEST(WakeWord, IsNotHeardWhereOtherWordsAreLikelier) {
  WakeWord word = *WakeWord::of("computer");
  EXPECT_FALSE(word.meant({said("a red box"), said("computer a red box", 1.0)}, 1.0, 2.0).is_meant);
  // And where it is, sentences without it were not said.
  EXPECT_EQ(sentences(word.meant({said("computer undo"), said("a red box", 1.0)}, 3.0, 4.0)), "undo;");
}

TEST(WakeWord, AloneIsForTheNextSentenceWithinSomeSeconds) {
  WakeWord word = *WakeWord::of("hello world");
  const auto called = word.meant({said("hello world")}, 1.0, 2.0);
  EXPECT_TRUE(called.is_called);
  EXPECT_TRUE(called.sentences.empty());
  EXPECT_EQ(sentences(word.meant({said("undo")}, 2.0 + WakeWord::kAwake - 0.1, 20.0)), "undo;");
  word.fall_asleep();
  EXPECT_FALSE(word.meant({said("undo")}, 3.0, 4.0).is_meant);
  word.meant({said("hello world")}, 30.0, 31.0);
  EXPECT_FALSE(word.meant({said("undo")}, 31.0 + WakeWord::kAwake + 0.1, 50.0).is_meant);
  word.stay_awake(60.0);
  EXPECT_TRUE(word.meant({said("yes")}, 61.0, 62.0).is_meant);
}

TEST(WakeWord, MayComeBeforeEachSentenceOfTheGrammar) {
  Grammar grammar;
  grammar.set("s", *pattern_from_text("undo [that]"));
  grammar.set("often", *pattern_from_text("undo"));
  const Grammar with = WakeWord::of("computer")->with_word(grammar, {"s", "often"});
  ASSERT_TRUE(with.check(WakeWord::kRules.sentence));
  const auto can_be_said = [&](const std::string& sentence) {
    return !with.parse(WakeWord::kRules.sentence, spoken_words(sentence)).empty();
  };
  EXPECT_TRUE(can_be_said("computer undo that"));
  EXPECT_TRUE(can_be_said("undo that"));
  EXPECT_TRUE(can_be_said("computer"));
  EXPECT_FALSE(can_be_said("undo computer"));
  EXPECT_FALSE(with.parse(WakeWord::kRules.usual, spoken_words("computer undo")).empty());
}

TEST(WakeWord, ConsistsOfLetters) {
  for (const char* const wrong : {"", " ", "x2", "a, b", "one two three four", "<s>"})
    EXPECT_FALSE(WakeWord::of(wrong)) << wrong;
}

}  // namespace
}  // namespace icome::speech
