#include "speech/hearing/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/file_bytes.h"
#include "sound/sound_file.h"
#include "speech/hearing/recogniser.h"

namespace icome::speech {
namespace {

using base::fail;
using base::Result;

constexpr double kLongest = 600.0;                                        // s
constexpr auto kMostBytes = std::uint64_t(2.0 * kLongest * kSampleRate);  // of a file without a header

std::int16_t sample_of(float value) {
  constexpr float kFull = 32767.0F;
  return std::int16_t(std::lround(std::clamp(value, -1.0F, 1.0F) * kFull));
}

std::string too_long(const std::filesystem::path& file) {
  return fmt::format("{}: lasts more than {:g} minutes; cut it into parts", file.string(), kLongest / 60.0);
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
  auto read = sound::read_sound(file, {kLongest, 1});
  if (!read) return tl::unexpected(read.error());
  const auto heard = sound::resampled(std::move(*read), kSampleRate, file.string());
  if (!heard) return tl::unexpected(heard.error());
  std::vector<std::int16_t> samples(heard->values.size());
  std::transform(heard->values.begin(), heard->values.end(), samples.begin(), sample_of);
  return samples;
}

}  // namespace icome::speech
