#include "speech/hearing/likely_meant.h"

#include <gtest/gtest.h>

#include <sstream>

#include "interaction/operations/operation_runner.h"
#include "speech/said_aloud.h"

namespace icome::speech {
namespace {

class NobodysStage final : public Stage {
 public:
  std::vector<ObjectId> selection() const override { return {}; }
  void select(const std::vector<ObjectId>&) override {}
};

class LikelyMeant : public testing::Test {
 protected:
  LikelyMeant() {
    dialogue_.hear("a red box");
    dialogue_.vocabulary();
  }

  static Heard heard(const std::string& sentence, double behind, double score = -3.0) {
    Heard one{.score = score, .behind = behind};
    std::istringstream words(sentence);
    for (std::string word; words >> word;) one.words.push_back({word});
    return one;
  }
  std::string meant(const std::vector<Heard>& all) {
    const Heard* const one = likely_meant(all, dialogue_);
    return one != nullptr ? one->sentence() : "";
  }

  interaction::OperationRunner design_{world::World()};
  NobodysStage stage_;
  OwnWords own_words_;
  Dialogue dialogue_{*built_in_vocabulary(), design_, stage_, own_words_};
};

TEST_F(LikelyMeant, IsTheLikeliestThatCanBeDone) {
  EXPECT_EQ(meant({heard("delete the red box", 0.0), heard("a red box", 5.0)}), "delete the red box");
  // There is no blue box, but one can be made.
  EXPECT_EQ(meant({heard("the blue box", 0.0), heard("a blue box", 30.0)}), "a blue box");
  // Unless nothing but the impossible was said.
  EXPECT_EQ(meant({heard("the blue box", 0.0), heard("a blue box", 70.0)}), "the blue box");
  EXPECT_EQ(meant({heard("the blue box", 0.0)}), "the blue box");
}

TEST_F(LikelyMeant, IsDone) {
  const auto done =
      understand_utterance(dialogue_, {heard("the blue box", 0.0), heard("a blue box", 30.0)}, 1.0, 2.0);
  EXPECT_TRUE(done.answer.accepted());
  EXPECT_EQ(done.answer.heard, "a blue box");
  EXPECT_EQ(done.heard->sentence(), "a blue box");
  EXPECT_EQ(design_.world().objects().size(), 2U);
  const auto unlikely = understand_utterance(dialogue_, {heard("a cone", 150.0)}, 1.0, 2.0);
  EXPECT_FALSE(unlikely.answer.accepted());
  EXPECT_EQ(unlikely.answer.heard, "a cone");
  EXPECT_FALSE(understand_utterance(dialogue_, {}, 1.0, 2.0).heard);
  EXPECT_EQ(design_.world().objects().size(), 2U);
}

TEST_F(LikelyMeant, IsDoneAfterTheWakeWordOnly) {
  WakeWord word = *WakeWord::of("computer");
  const auto understand = [&](const std::string& sentence, double begin) {
    return understand_utterance(dialogue_, {heard(sentence, 0.0)}, begin, begin + 1.0, {}, &word);
  };
  const auto overheard = understand("a cone", 0.0);
  EXPECT_FALSE(overheard.is_addressed);
  EXPECT_FALSE(overheard.answer.accepted());
  EXPECT_EQ(overheard.answer.reply, "That was not said to me: begin with \"computer\".");
  EXPECT_EQ(understand("computer", 10.0).answer.reply, "Yes?");
  EXPECT_TRUE(understand("a blue cone", 13.0).answer.accepted());
  EXPECT_FALSE(understand("a red cone", 15.0).is_addressed);  // one sentence for each call
  EXPECT_TRUE(understand("computer a green cone", 30.0).answer.accepted());
  EXPECT_EQ(design_.world().objects().size(), 3U);
  // A question is answered without the word.
  EXPECT_EQ(understand("computer select the cone", 50.0).answer.state, Answer::State::Asked);
  EXPECT_FALSE(understand_utterance(dialogue_, {}, 52.0, 52.2, {}, &word).answer.accepted());  // a noise
  EXPECT_TRUE(understand("the blue one", 53.0).answer.accepted());
  // A word that only sounds like it does not count.
  EXPECT_FALSE(
      understand_utterance(dialogue_, {heard("computer", 0.0, -7.5)}, 70.0, 71.0, {}, &word).is_addressed);
}

TEST_F(LikelyMeant, IsHeardWithAPauseInIt) {
  const auto recogniser = make_sphinx_recogniser();
  if (!recogniser) GTEST_SKIP() << recogniser.error().message;
  const Grammar grammar =
      WakeWord::of("computer")
          ->with_word(dialogue_.vocabulary().grammar, {Dialogue::kSentence, Dialogue::kUsualSentence});
  ASSERT_TRUE((*recogniser)->set_grammar(grammar, WakeWord::kRules));
  const auto sentences = (*recogniser)->recognise(said_aloud("computer, create a small red sphere"));
  ASSERT_TRUE(sentences) << sentences.error().message;
  ASSERT_FALSE(sentences->empty());
  EXPECT_EQ(sentences->front().sentence(), "computer create a small red sphere");
  EXPECT_EQ(sentences->front().behind, 0.0);
}

TEST_F(LikelyMeant, IsNothingWhereAllAreUnlikely) {
  EXPECT_EQ(meant({}), "");
  EXPECT_EQ(meant({heard("a red box", 150.0)}), "");
  EXPECT_EQ(meant({heard("a red box", 0.0, -9.0)}), "");
}

}  // namespace
}  // namespace icome::speech
