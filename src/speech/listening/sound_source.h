#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"

namespace icome::speech {

/// Sound as it comes, at kSampleRate. One thread uses it.
class SoundSource {
 public:
  virtual ~SoundSource() = default;
  /// The samples since the last call; does not wait. Fails where the source is lost.
  virtual base::Result<std::vector<std::int16_t>> read() = 0;
};

/// Opens a source, also again after it was lost.
using OpenSource = std::function<base::Result<std::unique_ptr<SoundSource>>()>;

/// The microphone of this name, or the usual one. Fails, naming those that there are.
base::Result<std::unique_ptr<SoundSource>> open_microphone(const std::string& name = {});
/// Names of microphones; none where there is no sound device.
std::vector<std::string> microphones();

/// A recording that is heard as a microphone would hear it, as fast as it was spoken, then silence. Fails as
/// read_recording().
base::Result<std::unique_ptr<SoundSource>> open_recording(const std::string& file);

/// Opens the microphone of that name (of none: the usual one), or where it is the path of a file, that
/// recording.
OpenSource source_of(const std::string& name);

}  // namespace icome::speech
