#include "ui/study/start_tone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace icome::ui {

std::vector<std::int16_t> start_tone(int rate) {
  constexpr double kPitch = 880.0;  // Hz
  constexpr double kLength = 0.15;  // s
  constexpr double kSwell = 0.005;  // s
  constexpr double kLoudness = 0.5;
  std::vector<std::int16_t> samples(std::size_t(std::lround(kLength * rate)));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double time = double(i) / rate;
    const double strength = std::min({1.0, time / kSwell, (kLength - time) / kSwell});
    const double wave = std::sin(2.0 * std::numbers::pi * kPitch * time);
    samples[i] = std::int16_t(std::lround(32767.0 * kLoudness * strength * wave));
  }
  return samples;
}

}  // namespace icome::ui
