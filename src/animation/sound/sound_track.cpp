#include "animation/sound/sound_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace icome::animation {
namespace {

/// The moment of the samples at a time of the animation, maybe before their first or behind their last.
std::int64_t moment_at(const sound::Samples& samples, const Sound& sound, double time) {
  constexpr double kFarOff = 1e15;
  return std::llround(std::clamp((time - sound.start) * samples.rate, -kFarOff, kFarOff));
}

}  // namespace

base::Result<sound::Samples> read_track(const std::filesystem::path& folder, const Sound& sound, int rate,
                                        Reach reach) {
  const auto file = file_of_project(folder, sound.file, sound.file, reach);
  if (!file) return tl::unexpected(file.error());
  auto samples = sound::read_sound(*file, kTrackLimits);
  if (!samples || rate == 0) return samples;
  return sound::resampled(std::move(*samples), rate, file->string());
}

std::vector<Peak> waveform(const sound::Samples& samples, const Sound& sound, double rate, int first,
                           int count) {
  const auto all = std::int64_t(samples.moments());
  std::vector<Peak> peaks(std::size_t(std::max(0, count)));
  for (int i = 0; i < count; ++i) {
    const auto bounded = [&](double column) {
      return std::clamp(moment_at(samples, sound, column / rate), std::int64_t{0}, all);
    };
    const std::int64_t begin = bounded(double(first) + i), end = bounded(double(first) + i + 1);
    if (begin >= end) continue;
    const auto [least, greatest] = std::minmax_element(samples.values.begin() + begin * samples.channels,
                                                       samples.values.begin() + end * samples.channels);
    peaks[std::size_t(i)] = {float(sound.gain * *least), float(sound.gain * *greatest)};
  }
  return peaks;
}

std::vector<float> sound_of(const sound::Samples& samples, const Sound& sound, double from,
                            std::size_t moments) {
  std::vector<float> out(moments * std::size_t(samples.channels), 0.0F);
  const std::int64_t begin = moment_at(samples, sound, from);
  const auto all = std::int64_t(samples.moments());
  const std::int64_t first = std::clamp(begin, std::int64_t{0}, all);
  const std::int64_t last = std::clamp(begin + std::int64_t(moments), first, all);
  const auto gain = float(sound.gain);
  for (std::int64_t i = first * samples.channels; i < last * samples.channels; ++i)
    out[std::size_t(i - begin * samples.channels)] =
        std::clamp(gain * samples.values[std::size_t(i)], -1.0F, 1.0F);
  return out;
}

}  // namespace icome::animation
