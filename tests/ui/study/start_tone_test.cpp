#include "ui/study/start_tone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace icome::ui {
namespace {

TEST(StartTone, Is150MillisecondsOf880Hertz) {
  const auto tone = start_tone(48000);
  ASSERT_EQ(tone.size(), 7200U);
  int rising = 0;
  for (std::size_t i = 1; i < tone.size(); ++i) rising += tone[i - 1] < 0 && tone[i] >= 0 ? 1 : 0;
  EXPECT_NEAR(rising, 132, 1);  // 880 Hz for 0.15 s
}

TEST(StartTone, SwellsAndFadesSoThatItDoesNotClick) {
  const auto tone = start_tone(48000);
  const auto loudest = [&](std::size_t begin, std::size_t end) {
    int most = 0;
    for (std::size_t i = begin; i < end; ++i) most = std::max(most, std::abs(int(tone[i])));
    return most;
  };
  EXPECT_NEAR(loudest(1000, 6000), 16384, 20);  // half of what 16 bits hold
  EXPECT_LT(loudest(0, 24), 0.1 * 16384);       // the first and the last tenth of 5 ms
  EXPECT_LT(loudest(7176, 7200), 0.1 * 16384);
}

}  // namespace
}  // namespace icome::ui
