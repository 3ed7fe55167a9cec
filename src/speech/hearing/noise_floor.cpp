#include "speech/hearing/noise_floor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/random.h"

namespace icome::speech {
namespace {

/// Noise whose power falls by 3 dB an octave: white noise through the filter of Paul Kellet, which is within
/// 0.05 dB above 9 Hz at 44.1 kHz.
class PinkNoise {
 public:
  double next() {
    static constexpr std::array<std::pair<double, double>, 6> kPoles{{{0.99886, 0.0555179},
                                                                      {0.99332, 0.0750759},
                                                                      {0.96900, 0.1538520},
                                                                      {0.86650, 0.3104856},
                                                                      {0.55000, 0.5329522},
                                                                      {-0.7616, -0.0168980}}};
    const double white = random_.uniform(-1.0, 1.0);
    double sum = last_ + 0.5362 * white;
    for (std::size_t i = 0; i < kPoles.size(); ++i)
      sum += state_[i] = kPoles[i].first * state_[i] + kPoles[i].second * white;
    last_ = 0.115926 * white;
    return sum;
  }

 private:
  base::Random random_{1};
  std::array<double, 6> state_{};
  double last_ = 0.0;
};

double loudness(Sound sound) {
  double sum = 0.0;
  for (const std::int16_t sample : sound) sum += double(sample) * sample;
  return sound.empty() ? 0.0 : std::sqrt(sum / double(sound.size()));
}

/// The loudness that a tenth of the frames of 10 ms are below.
double quietest(Sound sound) {
  constexpr std::size_t kTenMs = kSampleRate / 100;
  std::vector<double> frames;
  for (std::size_t at = 0; at + kTenMs <= sound.size(); at += kTenMs)
    frames.push_back(loudness(sound.subspan(at, kTenMs)));
  if (frames.empty()) return 0.0;
  const auto tenth = frames.begin() + std::ptrdiff_t(frames.size() / 10);
  std::ranges::nth_element(frames, tenth);
  return *tenth;
}

}  // namespace

std::vector<std::int16_t> with_noise_floor(Sound sound) {
  constexpr double kShare = 1.0 / 30.0;
  std::vector<std::int16_t> all(sound.begin(), sound.end());
  const double wanted = kShare * loudness(sound), own = quietest(sound);
  if (own >= wanted) return all;
  std::vector<double> noise(sound.size());
  PinkNoise pink;
  double power = 0.0;
  for (double& value : noise) {
    value = pink.next();
    power += value * value;
  }
  const double factor = std::sqrt((wanted * wanted - own * own) * double(noise.size()) / power);
  for (std::size_t i = 0; i < all.size(); ++i) {
    using Limits = std::numeric_limits<std::int16_t>;
    all[i] = std::int16_t(
        std::clamp(std::round(all[i] + factor * noise[i]), double(Limits::min()), double(Limits::max())));
  }
  return all;
}

}  // namespace icome::speech
