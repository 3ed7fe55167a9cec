#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>

#include "base/random.h"
#include "places.h"
#include "speech/hearing/noise_floor.h"
#include "speech/hearing/recogniser.h"
#include "speech/hearing/recording.h"
#include "speech/hearing/voice_activity.h"
#include "speech/hearing/word_sounds.h"

namespace icome::speech {
namespace {

/// Noise with tones of 300 Hz in it: each from a time to another, s.
std::vector<std::int16_t> tones(double seconds, const std::vector<std::pair<double, double>>& spans) {
  base::Random random(1);
  std::vector<std::int16_t> sound(std::size_t(seconds * kSampleRate));
  for (std::size_t i = 0; i < sound.size(); ++i) {
    const double time = double(i) / kSampleRate;
    double value = random.uniform(-30.0, 30.0);
    for (const auto& [begin, end] : spans)
      if (time >= begin && time < end) value += 3000.0 * std::sin(2.0 * std::numbers::pi * 300.0 * time);
    sound[i] = std::int16_t(value);
  }
  return sound;
}

TEST(VoiceActivity, CutsWhereNobodySpeaksLongEnough) {
  const auto sound = tones(4.0, {{0.5, 1.0}, {1.1, 1.5}, {2.5, 3.0}});
  const auto utterances = utterances_of(sound, {.hang = 0.2});
  ASSERT_EQ(utterances.size(), 2U);
  EXPECT_NEAR(utterances[0].begin, 0.3, 0.02);
  EXPECT_NEAR(utterances[0].speech_end, 1.5, 0.02);
  EXPECT_NEAR(double(utterances[0].samples.size()) / kSampleRate, 1.7 - 0.3, 0.03);
  EXPECT_NEAR(utterances[1].speech_end, 3.0, 0.02);
}

TEST(VoiceActivity, HearsWhatBeginsAndEndsWithSpeech) {
  const auto utterances = utterances_of(tones(0.5, {{0.0, 0.5}}), {});
  ASSERT_EQ(utterances.size(), 1U);
  EXPECT_NEAR(utterances[0].speech_end, 0.5, 0.02);
}

TEST(VoiceActivity, SilenceClicksAndNothingAreNoSpeech) {
  EXPECT_TRUE(utterances_of({}, {}).empty());
  EXPECT_TRUE(utterances_of(std::vector<std::int16_t>(16000, 0), {}).empty());
  EXPECT_TRUE(utterances_of(tones(2.0, {{1.0, 1.03}}), {}).empty());
}

TEST(VoiceActivity, AStreamGivesAnUtteranceAsSoonAsItHasEnded) {
  const auto sound = tones(2.0, {{0.6, 1.0}});
  VoiceActivity activity;
  std::size_t heard = 0;
  for (std::size_t at = 0; at + 160 <= sound.size(); at += 160) {
    heard += activity.hear(Sound(sound).subspan(at, 160)).size();
    const double time = double(at + 160) / kSampleRate;
    EXPECT_EQ(heard, time > 1.215 ? 1U : time < 1.185 ? 0U : heard) << time;
  }
}

TEST(WordSounds, AreThoseOfTheCmuDictionary) {
  EXPECT_EQ(sounds_from_ipa("t\u0283\u02c8\u025b\u0279i"), "CH EH R IY");
  EXPECT_EQ(sounds_from_ipa("?!"), "");
  EXPECT_EQ(sounds_of_word("spoon"), "S P UW N");
}

class RecordingFile : public testing::Test {
 protected:
  RecordingFile() {
    std::string name = (std::filesystem::temp_directory_path() / "icome-sound-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~RecordingFile() override { std::filesystem::remove_all(folder_); }

  /// A WAV file of so many bytes of 16 bit samples of one channel.
  std::filesystem::path wav(const std::string& name, std::uint32_t rate,
                            const std::vector<std::int16_t>& samples) {
    const auto file = folder_ / name;
    std::ofstream out(file, std::ios::binary);
    const auto number = [&](std::uint32_t value, int bytes) {
      for (int i = 0; i < bytes; ++i) out.put(char(value >> (8 * i)));
    };
    const auto size = std::uint32_t(2 * samples.size());
    out << "RIFF";
    number(36 + size, 4);
    out << "WAVEfmt ";
    number(16, 4);
    number(1, 2);
    number(1, 2);
    number(rate, 4);
    number(2 * rate, 4);
    number(2, 2);
    number(16, 2);
    out << "data";
    number(size, 4);
    for (const std::int16_t sample : samples) number(std::uint16_t(sample), 2);
    return file;
  }

  std::filesystem::path folder_;
};

TEST_F(RecordingFile, ComesAtTheRateOfTheRecogniser) {
  std::vector<std::int16_t> tone(8000);
  for (std::size_t i = 0; i < tone.size(); ++i)
    tone[i] = std::int16_t(10000.0 * std::sin(2.0 * std::numbers::pi * 440.0 * double(i) / 8000.0));
  const auto sound = read_recording(wav("tone.wav", 8000, tone));
  ASSERT_TRUE(sound) << sound.error().message;
  EXPECT_NEAR(double(sound->size()), 16000.0, 2.0);
  // The same tone: a quarter second in, against the closed form.
  double worst = 0.0;
  for (std::size_t i = 4000; i < 12000; ++i)
    worst = std::max(worst, std::abs((*sound)[i] - 10000.0 * std::sin(2.0 * std::numbers::pi * 440.0 *
                                                                      double(i) / 16000.0)));
  EXPECT_LT(worst, 100.0);
}

TEST_F(RecordingFile, WithSamplesThatAreNoNumbersIsDamaged) {
  // A WAV file of floats: format 3, 32 bits.
  const auto file = folder_ / "floats.wav";
  std::ofstream out(file, std::ios::binary);
  const auto number = [&](std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out.put(char(value >> (8 * i)));
  };
  out << "RIFF";
  number(36 + 8, 4);
  out << "WAVEfmt ";
  number(16, 4);
  number(3, 2);
  number(1, 2);
  number(16000, 4);
  number(64000, 4);
  number(4, 2);
  number(32, 2);
  out << "data";
  number(8, 4);
  number(0, 4);
  number(0x7fc00000U, 4);  // not a number
  out.close();
  const auto sound = read_recording(file);
  ASSERT_FALSE(sound);
  EXPECT_NE(sound.error().message.find("sample 2"), std::string::npos) << sound.error().message;
}

TEST_F(RecordingFile, WhatIsNoneIsToldByItsName) {
  std::ofstream(folder_ / "text.wav") << "no sound at all";
  for (const char* name : {"text.wav", "missing.wav", ""}) {
    const auto sound = read_recording(folder_ / name);
    ASSERT_FALSE(sound);
    EXPECT_NE(sound.error().message.find(name), std::string::npos);
  }
}

TEST(SphinxRecogniser, HearsAPersonSayYes) {
  const auto file = places::shared_data() / "speech" / "yes_1000ms.wav";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const auto recogniser = make_sphinx_recogniser();
  if (!recogniser) GTEST_SKIP() << recogniser.error().message;
  Grammar grammar;
  grammar.set("s", *pattern_from_text("yes | no | save | delete the (red | blue) (box | cone)"));
  grammar.set("often", *pattern_from_text("save | yes"));
  EXPECT_FALSE((*recogniser)->recognise({}));  // there is no grammar yet
  EXPECT_FALSE((*recogniser)->set_grammar(grammar, {"nothing", "often"}));
  ASSERT_TRUE((*recogniser)->set_grammar(grammar, {"s", "often"}));
  const auto sound = read_recording(file);
  ASSERT_TRUE(sound);
  const auto heard = (*recogniser)->recognise(*sound);
  ASSERT_TRUE(heard);
  ASSERT_FALSE(heard->empty());
  const Heard& best = heard->front();
  EXPECT_EQ(best.sentence(), "yes");
  EXPECT_LT(best.score, 0.0);
  EXPECT_GE(best.behind, 0.0);
  EXPECT_GT(best.words.front().begin, 0.0);
  EXPECT_LT(best.words.front().end, 1.01);
  std::set<std::string> different;
  double behind = 0.0;
  for (const Heard& one : *heard) {
    EXPECT_TRUE(different.insert(one.sentence()).second) << one.sentence();
    EXPECT_GE(one.behind, behind);
    behind = one.behind;
    std::vector<std::string> words;
    for (const HeardWord& word : one.words) words.push_back(word.word);
    EXPECT_FALSE(grammar.parse("s", words).empty()) << one.sentence();
  }
}

TEST(NoiseFloor, IsAThirtiethOfTheSoundWhereItIsQuieter) {
  const auto loudness = [](Sound sound) {
    double sum = 0.0;
    for (const std::int16_t sample : sound) sum += double(sample) * sample;
    return std::sqrt(sum / double(sound.size()));
  };
  std::vector<std::int16_t> sound(3 * kSampleRate, 0);
  for (std::size_t i = 16000; i < 32000; ++i)
    sound[i] = std::int16_t(9000.0 * std::sin(2.0 * std::numbers::pi * 300.0 * double(i) / kSampleRate));
  const auto noisy = with_noise_floor(sound);
  const double wanted = loudness(sound) / 30.0;
  EXPECT_NEAR(loudness(Sound(noisy).first(16000)), wanted, 0.15 * wanted);
  EXPECT_EQ(with_noise_floor(sound), noisy);
  // Sound that is as loud in its quietest moments stays as it is.
  std::vector<std::int16_t> shouted(kSampleRate, 1000);
  EXPECT_EQ(with_noise_floor(shouted), shouted);
  EXPECT_TRUE(with_noise_floor({}).empty());
  EXPECT_EQ(with_noise_floor(std::vector<std::int16_t>(1600, 0)), std::vector<std::int16_t>(1600, 0));
}

}  // namespace
}  // namespace icome::speech
