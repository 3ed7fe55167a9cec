#include "sound/sound_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "own_folder.h"
#include "sound/wav_file.h"

namespace icome::sound {
namespace {

class SoundFile : public testing::Test {
 protected:
  SoundFile() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~SoundFile() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_ = own_folder("sound");
};

TEST_F(SoundFile, KeepsTwoChannelsOrMixesThem) {
  const std::vector<double> values = {0.5, -0.5, 0.25, 0.75};
  write_wav(folder_ / "two.wav", 44100, 2, values);
  const auto two = read_sound(folder_ / "two.wav", {10, 2});
  ASSERT_TRUE(two) << two.error().message;
  EXPECT_EQ(two->rate, 44100);
  ASSERT_EQ(two->channels, 2);
  ASSERT_EQ(two->values.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(two->values[i], values[i], 1e-4);
  const auto one = read_sound(folder_ / "two.wav", {10, 1});
  ASSERT_EQ(one.value().values.size(), 2U);
  EXPECT_NEAR(one->values[0], 0, 1e-4);
  EXPECT_NEAR(one->values[1], 0.5, 1e-4);
}

TEST_F(SoundFile, MixesManyChannelsToTwo) {
  write_wav(folder_ / "four.wav", 8000, 4, {0.1, 0.2, 0.3, 0.4});
  const auto two = read_sound(folder_ / "four.wav", {10, 2});
  ASSERT_EQ(two.value().channels, 2);
  EXPECT_NEAR(two->values[0], 0.2, 1e-4);
  EXPECT_NEAR(two->values[1], 0.3, 1e-4);
}

TEST_F(SoundFile, ChangesTheRateOfASine) {
  write_wav(folder_ / "a.wav", 44100, 1, sine(44100, 440, 0.5, 0.8));
  const auto changed = resampled(read_sound(folder_ / "a.wav", {10, 2}).value(), 48000, "a.wav");
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->rate, 48000);
  EXPECT_NEAR(changed->seconds(), 0.5, 1e-3);
  for (std::size_t i = 2000; i < 20000; ++i)
    ASSERT_NEAR(changed->values[i], 0.8 * std::sin(2 * M_PI * 440 * double(i) / 48000), 2e-3) << i;
}

TEST_F(SoundFile, TellsWhatIsWrong) {
  const auto fault = [&](const std::string& name, double seconds = 10) {
    const auto read = read_sound(folder_ / name, {seconds, 2});
    return read ? "" : read.error().message.substr(folder_.string().size() + 1);
  };
  write_wav(folder_ / "long.wav", 8000, 1, std::vector<double>(16001));
  std::ofstream(folder_ / "text.wav") << "no sound";
  std::ofstream(folder_ / "empty.ogg") << "";
  EXPECT_EQ(fault("gone.wav"), "gone.wav: there is no such file");
  EXPECT_EQ(fault("long.wav", 2), "long.wav: lasts more than 0.0333333 minutes; cut it into parts");
  EXPECT_TRUE(fault("text.wav").starts_with("text.wav: is no sound that can be read")) << fault("text.wav");
  EXPECT_TRUE(fault("empty.ogg").starts_with("empty.ogg: ")) << fault("empty.ogg");
  EXPECT_FALSE(resampled({8000, 1, {0.0F, 0.0F}}, 8000 * 300, "a").has_value());
}

}  // namespace
}  // namespace icome::sound
