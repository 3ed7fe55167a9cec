#include "speech/grammar/grammar.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "base/random.h"
#include "speech/grammar/sentence_sampler.h"
#include "speech/words/spoken_words.h"

namespace icome::speech {
namespace {

Grammar grammar_of(std::initializer_list<std::pair<const char*, const char*>> rules) {
  Grammar grammar;
  for (const auto& [name, text] : rules) grammar.set(name, *pattern_from_text(text));
  return grammar;
}

TEST(Grammar, FindsEveryReadingInTheOrderOfItsAlternatives) {
  const Grammar grammar =
      grammar_of({{"s", "<a> {first} | paint {second} (it | box)"}, {"a", "paint [the] box {boxed}"}});
  const auto readings = grammar.parse("s", spoken_words("paint box"));
  ASSERT_EQ(readings.size(), 2U);
  EXPECT_EQ(readings[0].tag(), "first");
  EXPECT_TRUE(readings[0].part("a")->has("boxed"));
  EXPECT_EQ(readings[1].tag(), "second");
  EXPECT_TRUE(grammar.parse("s", spoken_words("paint the")).empty());
  EXPECT_TRUE(grammar.parse("s", spoken_words("paint box box")).empty());
}

TEST(Grammar, KnowsWhichWordsAPartCovers) {
  const Grammar grammar = grammar_of({{"s", "put <thing> on <thing>"}, {"thing", "the (box | ball)"}});
  const auto readings = grammar.parse("s", spoken_words("put the ball on the box"));
  ASSERT_EQ(readings.size(), 1U);
  const auto things = readings[0].all("thing");
  ASSERT_EQ(things.size(), 2U);
  EXPECT_EQ(things[0]->begin, 1U);
  EXPECT_EQ(things[0]->end, 3U);
  EXPECT_EQ(things[1]->begin, 4U);
}

TEST(Grammar, AnyWordsAreOneToThree) {
  const Grammar grammar = grammar_of({{"s", "call it <words>"}});
  EXPECT_EQ(grammar.parse("s", spoken_words("call it left front leg"))[0].part("words")->tag(),
            "left front leg");
  EXPECT_TRUE(grammar.parse("s", spoken_words("call it")).empty());
  EXPECT_TRUE(grammar.parse("s", spoken_words("call it a b c d")).empty());
}

TEST(Grammar, RefusesWhatHasNoEndOrNoRule) {
  EXPECT_TRUE(grammar_of({{"s", "<a>"}, {"a", "b"}}).check("s"));
  EXPECT_NE(grammar_of({{"s", "<a>"}, {"a", "x [<s>]"}}).check("s").error().message.find("refers to itself"),
            std::string::npos);
  EXPECT_NE(grammar_of({{"s", "<b>"}}).check("s").error().message.find("no rule <b>"), std::string::npos);
}

/// All sentences of a pattern, by an own way that shares nothing with the parser.
std::set<std::string> all_sentences(const Grammar& grammar, const Pattern& pattern) {
  switch (pattern.kind) {
    case Pattern::Kind::Word:
      return {pattern.text};
    case Pattern::Kind::Tag:
      return {""};
    case Pattern::Kind::Rule:
      return all_sentences(grammar, *grammar.find(pattern.text));
    case Pattern::Kind::Choice: {
      std::set<std::string> all;
      for (const Pattern& part : pattern.parts) all.merge(all_sentences(grammar, part));
      return all;
    }
    case Pattern::Kind::Optional: {
      std::set<std::string> all = all_sentences(grammar, pattern.parts.front());
      all.insert("");
      return all;
    }
    case Pattern::Kind::Sequence:
      break;
  }
  std::set<std::string> all{""};
  for (const Pattern& part : pattern.parts) {
    std::set<std::string> longer;
    for (const std::string& before : all)
      for (const std::string& next : all_sentences(grammar, part))
        longer.insert(before + (before.empty() || next.empty() ? "" : " ") + next);
    all = std::move(longer);
  }
  return all;
}

Pattern random_pattern(base::Random& random, int depth) {
  const char* const words[] = {"a", "b", "c"};
  const auto kind = depth == 0 ? 0 : random.index(5);
  if (kind == 0) return word_pattern(words[random.index(3)]);
  if (kind == 1) return tag_pattern("t");
  Pattern pattern{kind == 2   ? Pattern::Kind::Choice
                  : kind == 3 ? Pattern::Kind::Sequence
                              : Pattern::Kind::Optional,
                  {},
                  {}};
  const std::size_t count = kind == 4 ? 1 : 2 + random.index(2);
  for (std::size_t i = 0; i < count; ++i) pattern.parts.push_back(random_pattern(random, depth - 1));
  return pattern;
}

TEST(Grammar, ParsesExactlyTheSentencesOfRandomPatterns) {
  base::Random random(1);
  std::size_t sentences = 0;
  for (int i = 0; i < 500; ++i) {
    Grammar grammar;
    grammar.set("s", random_pattern(random, 3));
    const auto all = all_sentences(grammar, *grammar.find("s"));
    // All sentences of up to four words over the letters, whether they belong to it or not.
    const std::function<void(std::string, int)> try_all = [&](const std::string& text, int left) {
      const auto words = spoken_words(text);
      EXPECT_EQ(!grammar.parse("s", words).empty(), all.contains(text)) << text;
      ++sentences;
      if (left == 0) return;
      for (const char* word : {"a", "b", "c"}) try_all(text + (text.empty() ? "" : " ") + word, left - 1);
    };
    try_all("", 4);
    const auto sample = sample_sentence(grammar, *grammar.find("s"), random);
    ASSERT_TRUE(sample);
    EXPECT_TRUE(all.contains(joined_words(*sample)));
  }
  EXPECT_EQ(sentences, 500U * 121U);
}

TEST(Grammar, JsgfLeavesOutRulesWithoutWords) {
  Grammar grammar = grammar_of({{"s", "go to <place> | select [the] <name>"}, {"name", "box | ball"}});
  grammar.set("place", {Pattern::Kind::Choice, {}, {}});
  const std::string text = grammar.jsgf("s", "test");
  EXPECT_EQ(text,
            "#JSGF V1.0 UTF-8;\ngrammar test;\n<name> = (box | ball);\npublic <s> = select [the] <name>;\n");
}

}  // namespace
}  // namespace icome::speech
