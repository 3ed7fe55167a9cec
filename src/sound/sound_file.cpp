// The only source that knows libsndfile and libsamplerate.
#include "sound/sound_file.h"

#include <fmt/format.h>
#include <samplerate.h>
#include <sndfile.h>

#include <cmath>
#include <memory>

namespace icome::sound {
namespace {

using base::fail;
using base::Result;

constexpr int kMostChannels = 64;
constexpr int kLeastRate = 1000;
constexpr int kMostRate = 768'000;

struct CloseSound {
  void operator()(SNDFILE* file) const { sf_close(file); }
};

/// Adds the moments of a block, of `from` channels each, as `to` channels: the means of each to-th one.
void append_mixed(const std::vector<float>& block, sf_count_t moments, int from, int to,
                  std::vector<float>& values) {
  for (sf_count_t i = 0; i < moments; ++i)
    for (int c = 0; c < to; ++c) {
      float sum = 0.0F;
      int count = 0;
      for (int k = c; k < from; k += to, ++count) sum += block[std::size_t(i * from + k)];
      values.push_back(sum / float(count));
    }
}

Result<std::vector<float>> mixed(SNDFILE* sound, const SF_INFO& info, int channels, double seconds,
                                 const std::string& name) {
  constexpr sf_count_t kBlock = 4096;  // moments
  std::vector<float> block(std::size_t(kBlock) * std::size_t(info.channels));
  std::vector<float> values;
  while (true) {
    const sf_count_t moments = sf_readf_float(sound, block.data(), kBlock);
    if (moments <= 0) break;
    const std::size_t before = values.size();
    append_mixed(block, moments, info.channels, channels, values);
    for (std::size_t i = before; i < values.size(); ++i)
      if (!std::isfinite(values[i]))
        return fail(
            fmt::format("{}: is damaged: its sample {} is no number", name, i / std::size_t(channels) + 1));
    if (double(values.size() / std::size_t(channels)) > seconds * info.samplerate)
      return fail(fmt::format("{}: lasts more than {:g} minutes; cut it into parts", name, seconds / 60.0));
  }
  if (sf_error(sound) != SF_ERR_NO_ERROR)
    return fail(fmt::format("{}: is damaged: {}", name, sf_strerror(sound)));
  return values;
}

}  // namespace

Result<Samples> read_sound(const std::filesystem::path& file, const SoundLimits& limits) {
  const std::string name = file.string();
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    return fail(fmt::format("{}: {}", name,
                            std::filesystem::exists(file, error) ? "is no file" : "there is no such file"));
  SF_INFO info{};
  const std::unique_ptr<SNDFILE, CloseSound> sound(sf_open(file.c_str(), SFM_READ, &info));
  if (!sound) return fail(fmt::format("{}: is no sound that can be read: {}", name, sf_strerror(nullptr)));
  if (info.channels < 1 || info.channels > kMostChannels || info.samplerate < kLeastRate ||
      info.samplerate > kMostRate)
    return fail(fmt::format("{}: {} channels at {} Hz cannot be read", name, info.channels, info.samplerate));
  const int channels = info.channels < limits.channels ? info.channels : limits.channels;
  auto values = mixed(sound.get(), info, channels, limits.seconds, name);
  if (!values) return tl::unexpected(values.error());
  return Samples{info.samplerate, channels, std::move(*values)};
}

Result<Samples> resampled(Samples sound, int rate, const std::string& name) {
  if (sound.rate == rate || sound.values.empty()) {
    sound.rate = rate;
    return sound;
  }
  const double ratio = double(rate) / sound.rate;
  std::vector<float> out((std::size_t(std::ceil(double(sound.moments()) * ratio)) + 1) *
                         std::size_t(sound.channels));
  SRC_DATA data{};
  data.data_in = sound.values.data();
  data.input_frames = long(sound.moments());
  data.data_out = out.data();
  data.output_frames = long(out.size() / std::size_t(sound.channels));
  data.src_ratio = ratio;
  if (const int error = src_simple(&data, SRC_SINC_MEDIUM_QUALITY, sound.channels))
    return fail(
        fmt::format("{}: its rate of {} Hz cannot be changed: {}", name, sound.rate, src_strerror(error)));
  out.resize(std::size_t(data.output_frames_gen) * std::size_t(sound.channels));
  return Samples{rate, sound.channels, std::move(out)};
}

}  // namespace icome::sound
