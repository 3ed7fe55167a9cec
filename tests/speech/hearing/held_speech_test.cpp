#include "speech/hearing/held_speech.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace icome::speech {
namespace {

/// A room in which tones sound at these times, heard in pieces of 20 ms.
class HeldSpeechTest : public testing::Test {
 protected:
  /// Goes on for so many seconds with the key held or not.
  void go_on(double seconds, bool held, bool sounds) {
    constexpr std::size_t kPiece = kSampleRate / 50;
    for (auto left = std::size_t(seconds * kSampleRate); left >= kPiece; left -= kPiece) {
      std::vector<std::int16_t> samples;
      for (std::size_t i = 0; i < kPiece; ++i, ++count_) {
        const double wave = std::sin(2.0 * std::numbers::pi * 400.0 * double(count_) / kSampleRate);
        samples.push_back(std::int16_t((sounds ? 4000.0 * wave : 0.0) + double(count_ * 7919 % 13) - 6.0));
      }
      if (auto utterance = held_.hear(samples, held)) all_.push_back(std::move(*utterance));
    }
  }
  double now() const { return double(count_) / kSampleRate; }

  HeldSpeech held_;
  std::vector<Utterance> all_;
  std::size_t count_ = 0;
};

TEST_F(HeldSpeechTest, IsOneUtteranceWithItsPauses) {
  go_on(1.0, false, true);  // said without the key
  go_on(1.0, false, false);
  const double begin = now();
  go_on(0.2, true, false);
  go_on(0.5, true, true);
  go_on(1.5, true, false);  // a pause to think
  go_on(0.5, true, true);
  EXPECT_TRUE(held_.is_taking());
  const double spoken = now();
  go_on(0.1, true, false);
  EXPECT_TRUE(all_.empty());
  go_on(0.5, false, false);
  ASSERT_EQ(all_.size(), 1U);
  EXPECT_FALSE(held_.is_taking());
  EXPECT_NEAR(all_[0].speech_end, spoken, 0.05);
  EXPECT_NEAR(all_[0].begin, begin, 0.05);  // 0.2 s before the first sound
  EXPECT_NEAR(double(all_[0].samples.size()) / kSampleRate, spoken - begin, 0.35);
  go_on(1.0, false, true);
  EXPECT_EQ(all_.size(), 1U);
}

TEST_F(HeldSpeechTest, HearsTheEndOfAKeyThatIsLetGoEarlyAndTheBeginningOfOneThatIsPressedLate) {
  go_on(1.0, false, false);
  const double begin = now();
  go_on(0.15, false, true);
  go_on(0.5, true, true);
  go_on(0.15, false, true);
  const double end = now();
  go_on(1.0, false, false);
  ASSERT_EQ(all_.size(), 1U);
  EXPECT_NEAR(all_[0].begin, begin, 0.15);
  EXPECT_NEAR(all_[0].speech_end, end, 0.05);
}

TEST_F(HeldSpeechTest, IsNothingWhereNobodySpeaks) {
  go_on(1.0, true, false);
  go_on(1.0, false, false);
  EXPECT_TRUE(all_.empty());
  EXPECT_FALSE(held_.is_taking());
}

TEST_F(HeldSpeechTest, EndsByItselfWhereTheKeyIsStuck) {
  go_on(1.0, true, true);
  go_on(30.0, true, false);
  EXPECT_EQ(all_.size(), 1U);
}

}  // namespace
}  // namespace icome::speech
