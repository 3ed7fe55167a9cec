#include "animation/sound/sound_track.h"

#include <gtest/gtest.h>

#include "animation/picture/small_project.h"
#include "own_folder.h"
#include "sound/wav_file.h"

namespace icome::animation {
namespace {

/// A stereo sound whose values are their places: 0, -0, 1, -1, 2, -2 thousandths ...
sound::Samples ramp(int rate, int moments) {
  sound::Samples samples{rate, 2, {}};
  for (int i = 0; i < moments; ++i) {
    samples.values.push_back(0.001F * float(i));
    samples.values.push_back(-0.001F * float(i));
  }
  return samples;
}

TEST(SoundTrack, CutsByStartAndGain) {
  const sound::Samples samples = ramp(100, 50);
  // It begins at 0.2 s: moment 20 of the animation is its first.
  const std::vector<float> cut = sound_of(samples, {"a", 0.2, 2}, 0.15, 10);
  ASSERT_EQ(cut.size(), 20U);
  for (int i = 0; i < 10; ++i) {
    EXPECT_FLOAT_EQ(cut[std::size_t(2 * i)], i < 5 ? 0.0F : 0.002F * float(i - 5)) << i;
    EXPECT_FLOAT_EQ(cut[std::size_t(2 * i + 1)], i < 5 ? 0.0F : -0.002F * float(i - 5)) << i;
  }
  // Its beginning is cut off.
  EXPECT_FLOAT_EQ(sound_of(samples, {"a", -0.1, 1}, 0, 1)[0], 0.010F);
  // Behind its end is silence, and nothing is louder than 1.
  const std::vector<float> end = sound_of(samples, {"a", 0, 1000}, 0.48, 4);
  EXPECT_EQ(end, (std::vector<float>{1, -1, 1, -1, 0, 0, 0, 0}));
  EXPECT_EQ(sound_of(samples, {"a", 1e300, 1}, 0, 2), std::vector<float>(4, 0.0F));
}

TEST(SoundTrack, PartsMakeTheWhole) {
  const sound::Samples samples = ramp(100, 50);
  const Sound sound{"a", 0.033, 1};
  const std::vector<float> whole = sound_of(samples, sound, 0, 60);
  std::vector<float> parts;
  for (int i = 0; i < 60; i += 4) {
    const std::vector<float> part = sound_of(samples, sound, i / 100.0, 4);
    parts.insert(parts.end(), part.begin(), part.end());
  }
  EXPECT_EQ(whole, parts);
}

TEST(SoundTrack, PeaksAreThoseOfEveryColumn) {
  const sound::Samples samples = ramp(100, 50);
  const Sound sound{"a", 0.1, 2};
  const std::vector<Peak> peaks = waveform(samples, sound, 10, 0, 8);
  ASSERT_EQ(peaks.size(), 8U);
  EXPECT_EQ(peaks[0], (Peak{0, 0}));
  for (int i = 1; i < 6; ++i) {
    EXPECT_FLOAT_EQ(peaks[std::size_t(i)].greatest, 0.002F * float(10 * i - 1));
    EXPECT_FLOAT_EQ(peaks[std::size_t(i)].least, -0.002F * float(10 * i - 1));
  }
  EXPECT_EQ(peaks[6], (Peak{0, 0}));
  EXPECT_EQ(waveform(samples, sound, 10, 3, 2), (std::vector<Peak>{peaks[3], peaks[4]}));
}

TEST(SoundTrack, IsReadFromTheFolderAtARate) {
  const TestFolder folder(own_folder("track"));
  write_wav(folder / "a.wav", 22050, 1, sine(22050, 300, 1, 0.5));
  EXPECT_EQ(read_track(folder.path(), {"a.wav", 0, 1}).value().rate, 22050);
  const auto track = read_track(folder.path(), {"a.wav", 0, 1}, 48000);
  ASSERT_TRUE(track);
  EXPECT_NEAR(track->seconds(), 1, 1e-3);
  EXPECT_EQ(read_track(folder.path(), {"gone.wav", 0, 1}).error().message, "gone.wav: there is no such file");
  EXPECT_NE(read_track(folder.path(), {"../a.wav", 0, 1}).error().message.find("outside"), std::string::npos);
}

}  // namespace
}  // namespace icome::animation
