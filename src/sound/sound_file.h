#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace icome::sound {

/// Sound as numbers, of which -1 to 1 can be played; those of one moment stand together (interleaved).
struct Samples {
  int rate = 48000;  ///< moments a second
  int channels = 1;
  std::vector<float> values;  ///< finite

  std::size_t moments() const { return values.size() / std::size_t(channels); }
  double seconds() const { return double(moments()) / rate; }
};

/// Bounds of what is read.
struct SoundLimits {
  double seconds = 600;
  int channels = 1;  ///< 1 or 2; a file with more has their means: of all, or of each second one
};

/// The sound of a file in WAV, FLAC, OGG and what else libsndfile reads, at its own rate. Fails, naming the
/// file, for what is none, is damaged, or lasts longer than the limits say.
base::Result<Samples> read_sound(const std::filesystem::path& file, const SoundLimits& limits);

/// The sound at another rate; itself at its own. `name` is for the error: a ratio beyond 256 cannot be made.
base::Result<Samples> resampled(Samples sound, int rate, const std::string& name);

}  // namespace icome::sound
