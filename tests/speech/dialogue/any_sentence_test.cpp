// Sentences drawn at random from the grammar, and moments of words: whatever is said, the design is whole.
#include <gtest/gtest.h>

#include "base/random.h"
#include "repeats.h"
#include "speech/dialogue/sayable.h"
#include "speech/grammar/sentence_sampler.h"
#include "speech/words/spoken_words.h"

namespace icome::speech {
namespace {

/// A hand that is somewhere else at every moment.
class MovingHand final : public Stage {
 public:
  std::vector<std::pair<double, Vector3>> places;  // from that moment on, s
  std::vector<ObjectId> selected;

  std::optional<Pointer> pointer(double time) const override {
    std::optional<Pointer> there;
    for (const auto& [from, place] : places)
      if (time >= from) {
        there.emplace();
        there->world_from_pointer.translation() = place;
      }
    return there;
  }
  std::vector<ObjectId> selection() const override { return selected; }
  void select(const std::vector<ObjectId>& objects) override { selected = objects; }
};

struct Talk {
  interaction::OperationRunner design{world::World()};
  MovingHand stage;
  OwnWords own_words;
  Dialogue dialogue{*built_in_vocabulary(), design, stage, own_words};

  std::vector<std::string> names(const std::vector<ObjectId>& objects) const {
    std::vector<std::string> all;
    for (const ObjectId id : objects) all.push_back(design.world().find(id)->name);
    return all;
  }
};

TEST(AnySentence, IsDoneWholeOrLeavesTheDesignAsItWas) {
  base::Random random(11);
  std::size_t done = 0, refused = 0;
  const int talks = repeats(20);
  for (int t = 0; t < talks; ++t) {
    Talk talk;
    for (const char* first :
         {"a small red box", "two blue cones on the box", "a large sphere left of the box"})
      EXPECT_TRUE(talk.dialogue.hear(first).accepted());
    for (int i = 0; i < 60; ++i) {
      const Grammar& grammar = talk.dialogue.vocabulary().grammar;
      const auto words = sample_sentence(grammar, *grammar.find(Dialogue::kSentence), random);
      ASSERT_TRUE(words);
      talk.stage.places = {{0.0, 0.1 * random.direction()}};
      const std::uint64_t before = world::hash(talk.design.world());
      const Answer answer = talk.dialogue.hear(joined_words(*words), {.now = double(i)});
      SCOPED_TRACE(answer.heard);
      EXPECT_FALSE(answer.reply.empty());
      const std::uint64_t after = world::hash(talk.design.world());
      if (answer.state != Answer::State::Done) {
        EXPECT_EQ(after, before) << answer.reply;
        ++refused;
        continue;
      }
      ++done;
      if (after == before || answer.intent.front().second == interaction::Value("undo")) continue;
      if (answer.intent.front().second == interaction::Value("redo")) continue;
      // One sentence is one action.
      EXPECT_TRUE(talk.design.perform(interaction::Value::Fields{{"op", "undo"}}));
      EXPECT_EQ(world::hash(talk.design.world()), before);
      EXPECT_TRUE(talk.design.perform(interaction::Value::Fields{{"op", "redo"}}));
      EXPECT_EQ(world::hash(talk.design.world()), after);
    }
  }
  EXPECT_GT(done, std::size_t(talks) * 15U);
  EXPECT_GT(refused, std::size_t(talks));
}

TEST(AnySentence, ThatIsListedCanBeSaid) {
  Talk talk;
  for (const char* first : {"a red box", "name it seat", "a blue cone", "a blue cone", "undo"})
    ASSERT_TRUE(talk.dialogue.hear(first).accepted()) << first;
  const auto all = sayable_now(talk.dialogue);
  EXPECT_GT(all.size(), 20U);
  bool names_seat = false;
  for (const Sayable& sayable : all)
    for (const std::string& sentence : sayable.sentences) {
      Talk other;
      for (const char* first : {"a red box", "name it seat", "a blue cone", "a blue cone", "undo"})
        ASSERT_TRUE(other.dialogue.hear(first).accepted());
      const Answer answer = other.dialogue.hear(sentence);
      EXPECT_TRUE(answer.accepted()) << sayable.command << ": " << sentence << ": " << answer.reply;
      names_seat |= sentence.find("seat") != std::string::npos;
    }
  EXPECT_TRUE(names_seat);
}

TEST(MomentOfAWord, ThisAndHereAreWhereTheHandWasThen) {
  base::Random random(3);
  const int cases = repeats(100);
  for (int i = 0; i < cases; ++i) {
    Talk talk;
    talk.stage.places = {{0.0, Vector3(0, 0, 0)}};
    ASSERT_TRUE(talk.dialogue.hear("a small red sphere here").accepted());
    talk.stage.places = {{0.0, Vector3(1, 0, 0)}};
    ASSERT_TRUE(talk.dialogue.hear("a small blue box here").accepted());
    // The hand passes from the sphere over a way of its own to the box and beyond.
    const double first = random.uniform(10.0, 11.0), second = first + random.uniform(0.05, 2.0);
    const double end = second + random.uniform(0.05, 2.0);
    const Vector3 there = 5.0 * random.direction();
    talk.stage.places = {{0.0, Vector3(9, 9, 9)},
                         {first - 0.01, Vector3(0, 0, 0)},
                         {first + 0.01, Vector3(1, 0, 0)},
                         {second - 0.01, there},
                         {second + 0.01, Vector3(7, 7, 7)}};
    const Answer answer =
        talk.dialogue.hear("copy this here", {.now = end, .words = {first - 0.3, first, second}});
    ASSERT_TRUE(answer.accepted()) << answer.reply;
    ASSERT_EQ(talk.names(answer.objects), std::vector<std::string>{"sphere 2"});
    EXPECT_NEAR((world::bounds(talk.design.world(), answer.objects.front()).center() - there).norm(), 0.0,
                1e-9);
  }
}

}  // namespace
}  // namespace icome::speech
