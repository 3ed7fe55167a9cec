// The sound output of a machine that has none: ALSA writes into a file.
#include "sound/sound_output.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "own_folder.h"

namespace icome::sound {
namespace {

class SoundOutputTest : public testing::Test {
 protected:
  SoundOutputTest() {
    std::filesystem::create_directories(folder_);
    configure("pcm.!default { type file slave.pcm { type null } file \"" + played_.string() +
              "\" format \"raw\" }\n");
  }
  ~SoundOutputTest() override {
    unsetenv("ALSA_CONFIG_PATH");
    std::filesystem::remove_all(folder_);
  }

  void configure(const std::string& text) {
    const std::filesystem::path file = folder_ / "asound.conf";
    std::ofstream(file) << text;
    setenv("ALSA_CONFIG_PATH", file.c_str(), 1);
  }
  std::vector<std::int16_t> played() const {
    std::ifstream file(played_, std::ios::binary);
    std::vector<std::int16_t> samples(std::filesystem::file_size(played_) / 2);
    file.read(reinterpret_cast<char*>(samples.data()), std::streamsize(2 * samples.size()));
    return samples;
  }
  static void wait(const SoundOutput& output) {
    while (output.is_playing()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  std::filesystem::path folder_ = own_folder("sound-output");
  std::filesystem::path played_ = folder_ / "played.raw";
};

TEST_F(SoundOutputTest, PlaysWholeSoundsOneAfterTheOther) {
  std::vector<std::int16_t> rising;
  for (int i = 0; i < 40000; ++i) rising.push_back(std::int16_t(i - 20000));  // nearly two seconds
  {
    auto output = SoundOutput::open(22050);
    ASSERT_TRUE(output) << output.error().message;
    EXPECT_FALSE((*output)->is_playing());
    (*output)->play(rising);
    EXPECT_TRUE((*output)->is_playing());
    wait(**output);
    (*output)->play({1, 2, 3});  // shorter than any buffer
    wait(**output);
    (*output)->stop();
  }
  std::vector<std::int16_t> all = rising;
  all.insert(all.end(), {1, 2, 3});
  EXPECT_EQ(played(), all);
}

TEST_F(SoundOutputTest, TellsWhatToDoWithoutAnOutput) {
  configure("# nothing\n");
  const auto output = SoundOutput::open(22050);
  ASSERT_FALSE(output);
  EXPECT_NE(output.error().message.find("speaker-test"), std::string::npos) << output.error().message;
}

}  // namespace
}  // namespace icome::sound
