#include "speech/grammar/word_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "base/random.h"
#include "speech/grammar/sentence_sampler.h"
#include "speech/words/spoken_words.h"
#include "speech/words/vocabulary.h"

namespace icome::speech {
namespace {

bool accepts(const WordGraph& graph, const std::vector<std::string>& words) {
  std::size_t at = 0;
  for (const std::string& word : words) {
    const auto& next = graph.states[at].next;
    const auto step = std::ranges::find(next, word, &std::pair<std::string, std::uint32_t>::first);
    if (step == next.end()) return false;
    at = step->second;
  }
  return graph.states[at].is_end;
}

Pattern random_graph_pattern(base::Random& random, int depth) {
  const char* const words[] = {"a", "b", "c"};
  const auto kind = depth == 0 ? 0 : random.index(4);
  if (kind == 0) return word_pattern(words[random.index(3)]);
  Pattern pattern{kind == 1   ? Pattern::Kind::Choice
                  : kind == 2 ? Pattern::Kind::Sequence
                              : Pattern::Kind::Optional,
                  {},
                  {}};
  const std::size_t count = kind == 3 ? 1 : 2 + random.index(2);
  for (std::size_t i = 0; i < count; ++i) pattern.parts.push_back(random_graph_pattern(random, depth - 1));
  return pattern;
}

TEST(WordGraph, HoldsWhatTheParserTakesAndNothingElse) {
  base::Random random(4);
  for (int i = 0; i < 300; ++i) {
    Grammar grammar;
    grammar.set("part", random_graph_pattern(random, 2));
    Pattern sentence = random_graph_pattern(random, 2);
    grammar.set("s", sequence_of({sentence, {Pattern::Kind::Rule, "part", {}}}));
    const auto graph = word_graph(grammar, "s");
    ASSERT_TRUE(graph);
    const std::function<void(std::string, int)> try_all = [&](const std::string& text, int left) {
      const auto words = spoken_words(text);
      EXPECT_EQ(accepts(*graph, words), !grammar.parse("s", words).empty()) << text;
      if (left == 0) return;
      for (const char* word : {"a", "b", "c"}) try_all(text + (text.empty() ? "" : " ") + word, left - 1);
    };
    try_all("", 4);
  }
}

TEST(WordGraph, IsTheSmallest) {
  Grammar grammar;
  grammar.set("s",
              *pattern_from_text("(paint | colour) (it | that) red | (paint | colour) (it | that) blue"));
  EXPECT_EQ(word_graph(grammar, "s")->states.size(), 4U);
}

TEST(WordGraph, SharedRulesMakeItSmallAndLoseNoSentence) {
  Vocabulary vocabulary = *built_in_vocabulary();
  Pattern all{Pattern::Kind::Choice, {}, {}};
  for (const Command& command : vocabulary.commands)
    all.parts.push_back({Pattern::Kind::Rule, command.rule, {}});
  vocabulary.grammar.set("all", all);
  const auto graph = word_graph(vocabulary.grammar, "all", {"object"});
  ASSERT_TRUE(graph);
  EXPECT_LT(graph->states.size(), 1000U);
  base::Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const auto words = sample_sentence(vocabulary.grammar, all, random);
    ASSERT_TRUE(words);
    EXPECT_TRUE(accepts(*graph, *words)) << joined_words(*words);
  }
}

}  // namespace
}  // namespace icome::speech
