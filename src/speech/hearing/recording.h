#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/result.h"

namespace icome::speech {

/// The sound of a file at kSampleRate, its channels as one: WAV, FLAC, OGG and others that libsndfile reads,
/// and .raw, which is 16 kHz, one channel of 16 bits, little endian. Fails, naming the file, for what is
/// none, is damaged, or lasts more than ten minutes.
base::Result<std::vector<std::int16_t>> read_recording(const std::filesystem::path& file);

}  // namespace icome::speech
