#include "speech/speaking/speaker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "speech/hearing/word_sounds.h"
#include "speech/until.h"

namespace icome::speech {
namespace {

/// Keeps what loudspeakers were told.
struct Played {
  std::atomic<int> sentences = 0, stops = 0;
  std::atomic<std::size_t> samples = 0;  // of the last
  std::atomic<bool> plays = false;
};

class Phones final : public Loudspeaker {
 public:
  explicit Phones(Played& played) : played_(played) {}
  void play(SpokenSentence sentence) override {
    played_.samples = sentence.samples.size();
    played_.plays = true;
    ++played_.sentences;
  }
  void stop() override {
    played_.plays = false;
    ++played_.stops;
  }
  bool is_playing() const override { return played_.plays; }

 private:
  Played& played_;
};

OpenLoudspeaker phones(Played& played) {
  return [&played](int rate) -> base::Result<std::unique_ptr<Loudspeaker>> {
    EXPECT_GT(rate, 8000);
    return std::unique_ptr<Loudspeaker>(std::make_unique<Phones>(played));
  };
}

TEST(SpokenSentence, LastsAsLongAsPeopleTakeForIt) {
  const auto spoken = spoken_sentence("Small red cone, left of the box.");
  ASSERT_TRUE(spoken) << spoken.error().message;
  const double seconds = double(spoken->samples.size()) / spoken->rate;
  EXPECT_GT(seconds, 1.0);
  EXPECT_LT(seconds, 5.0);
  double squares = 0.0;
  for (const std::int16_t sample : spoken->samples) squares += double(sample) * sample;
  EXPECT_GT(std::sqrt(squares / double(spoken->samples.size())), 300.0);
  const auto longer =
      spoken_sentence("Small red cone, left of the box, which is behind the large green sphere.");
  EXPECT_GT(longer->samples.size(), spoken->samples.size() * 3 / 2);
  // Sounds of words come from that library too.
  EXPECT_EQ(sounds_of_word("cat"), "K AE T");
}

TEST(Speaker, SpeaksUntilTheLastSoundWasPlayed) {
  Played played;
  Speaker speaker(phones(played));
  EXPECT_FALSE(speaker.is_speaking());
  speaker.say("Small red cone.");
  EXPECT_TRUE(speaker.is_speaking());
  ASSERT_TRUE(until([&] { return played.sentences == 1; }));
  EXPECT_TRUE(speaker.is_speaking());
  played.plays = false;  // it has ended
  EXPECT_TRUE(until([&] { return !speaker.is_speaking(); }));
  EXPECT_TRUE(speaker.is_about());  // it may still come back from the room
  EXPECT_TRUE(until([&] { return !speaker.is_about(); }));
  EXPECT_EQ(speaker.problem(), "");
}

TEST(Speaker, SpeaksTheLastSentenceAndIsSilencedAtOnce) {
  Played played;
  Speaker speaker(phones(played));
  speaker.say("One.");
  ASSERT_TRUE(until([&] { return played.sentences == 1; }));
  const std::size_t first = played.samples;
  speaker.say("A much longer sentence takes its place.");
  ASSERT_TRUE(until([&] { return played.sentences == 2; }));
  EXPECT_GT(played.samples, first);
  speaker.stop();
  EXPECT_TRUE(until([&] { return !speaker.is_speaking(); }));
  EXPECT_FALSE(played.plays);
}

TEST(Speaker, TellsWhyItIsNotHeardAndTriesAgain) {
  Played played;
  std::atomic<bool> there = false;
  Speaker speaker([&](int rate) -> base::Result<std::unique_ptr<Loudspeaker>> {
    if (!there) return base::fail("there is no loudspeaker");
    return phones(played)(rate);
  });
  speaker.say("One.");
  EXPECT_TRUE(until([&] { return speaker.problem() == "there is no loudspeaker"; }));
  EXPECT_TRUE(until([&] { return !speaker.is_speaking(); }));
  there = true;
  speaker.say("Two.");
  EXPECT_TRUE(until([&] { return played.sentences == 1; }));
  EXPECT_EQ(speaker.problem(), "");
}

}  // namespace
}  // namespace icome::speech
