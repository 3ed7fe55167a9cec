// The only source that knows libsndfile and libsamplerate.
#include "speech/hearing/recording.h"

#include <fmt/format.h>
#include <samplerate.h>
#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "io/file_bytes.h"
#include "speech/hearing/recogniser.h"

namespace icome::speech {
namespace {

using base::fail;
using base::Result;

constexpr double kLongest = 600.0;                                        // s
constexpr auto kMostBytes = std::uint64_t(2.0 * kLongest * kSampleRate);  // of a file without a header
constexpr int kMostChannels = 64;

struct CloseSound {
  void operator()(SNDFILE* file) const { sf_close(file); }
};

std::int16_t sample_of(float value) {
  constexpr float kFull = 32767.0F;
  return std::int16_t(std::lround(std::clamp(value, -1.0F, 1.0F) * kFull));
}

std::string too_long(const std::filesystem::path& file) {
  return fmt::format("{}: lasts more than {:g} minutes; cut it into parts", file.string(), kLongest / 60.0);
}

/// One channel of floats; the mean of all where there are several.
Result<std::vector<float>> mono(SNDFILE* sound, const SF_INFO& info, const std::filesystem::path& file) {
  constexpr sf_count_t kBlock = 4096;  // frames
  std::vector<float> block(std::size_t(kBlock) * std::size_t(info.channels));
  std::vector<float> samples;
  while (const sf_count_t frames = sf_readf_float(sound, block.data(), kBlock)) {
    if (frames < 0) break;
    for (sf_count_t i = 0; i < frames; ++i) {
      float sum = 0.0F;
      for (int c = 0; c < info.channels; ++c) sum += block[std::size_t(i * info.channels + c)];
      if (!std::isfinite(sum))
        return fail(
            fmt::format("{}: is damaged: its sample {} is no number", file.string(), samples.size() + 1));
      samples.push_back(sum / float(info.channels));
    }
    if (double(samples.size()) > kLongest * info.samplerate) return fail(too_long(file));
  }
  if (sf_error(sound) != SF_ERR_NO_ERROR)
    return fail(fmt::format("{}: is damaged: {}", file.string(), sf_strerror(sound)));
  return samples;
}

Result<std::vector<std::int16_t>> resampled(std::vector<float> samples, int rate,
                                            const std::filesystem::path& file) {
  const double ratio = double(kSampleRate) / rate;
  std::vector<float> out(std::size_t(std::ceil(double(samples.size()) * ratio)) + 1);
  SRC_DATA data{};
  data.data_in = samples.data();
  data.input_frames = long(samples.size());
  data.data_out = out.data();
  data.output_frames = long(out.size());
  data.src_ratio = ratio;
  if (const int error = src_simple(&data, SRC_SINC_MEDIUM_QUALITY, 1))
    return fail(
        fmt::format("{}: its rate of {} Hz cannot be changed: {}", file.string(), rate, src_strerror(error)));
  std::vector<std::int16_t> sound(std::size_t(data.output_frames_gen));
  std::transform(out.begin(), out.begin() + data.output_frames_gen, sound.begin(), sample_of);
  return sound;
}

Result<std::vector<std::int16_t>> read_raw(const std::filesystem::path& file) {
  const auto bytes = io::read_bytes(file, kMostBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  if (double(bytes->size() / 2) > kLongest * kSampleRate) return fail(too_long(file));
  std::vector<std::int16_t> sound(bytes->size() / 2);
  for (std::size_t i = 0; i < sound.size(); ++i) {
    const auto low = static_cast<unsigned char>((*bytes)[2 * i]),
               high = static_cast<unsigned char>((*bytes)[2 * i + 1]);
    sound[i] = std::int16_t(std::uint16_t(low | (high << 8U)));
  }
  return sound;
}

}  // namespace

Result<std::vector<std::int16_t>> read_recording(const std::filesystem::path& file) {
  if (file.extension() == ".raw") return read_raw(file);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    return fail(fmt::format("{}: there is no such file", file.string()));
  SF_INFO info{};
  const std::unique_ptr<SNDFILE, CloseSound> sound(sf_open(file.c_str(), SFM_READ, &info));
  if (!sound)
    return fail(fmt::format("{}: is no sound that can be read: {}", file.string(), sf_strerror(nullptr)));
  if (info.channels < 1 || info.channels > kMostChannels || info.samplerate < 1000)
    return fail(fmt::format("{}: {} channels at {} Hz cannot be read", file.string(), info.channels,
                            info.samplerate));
  auto samples = mono(sound.get(), info, file);
  if (!samples) return tl::unexpected(samples.error());
  return resampled(std::move(*samples), info.samplerate, file);
}

}  // namespace icome::speech
