#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

#include "animation/picture/project_file.h"
#include "animation/project/project.h"
#include "sound/sound_file.h"

namespace icome::animation {

/// Bounds of the sound of an animation: an hour, two channels; 1.4 GB at 48 kHz.
inline constexpr sound::SoundLimits kTrackLimits = {3600, 2};

/// The sound of a project, at its own rate, or at `rate` (Hz) unless that is 0. Fails, naming the file:
/// missing, outside of the folder, damaged, too long.
base::Result<sound::Samples> read_track(const std::filesystem::path& folder, const Sound& sound, int rate = 0,
                                        Reach reach = Reach::Folder);

/// Least and greatest value of a piece of sound, over all channels.
struct Peak {
  float least = 0, greatest = 0;

  bool operator==(const Peak&) const = default;
};

/// The peaks of columns for drawing, `rate` of them a second: column i is the time of the animation from
/// (first + i) / rate on. Start and gain of the sound count; where it is not, peaks are 0.
std::vector<Peak> waveform(const sound::Samples& samples, const Sound& sound, double rate, int first,
                           int count);

/// The samples from a time of the animation (s) on, so many moments at their own rate, interleaved, by start
/// and gain of the sound, bounded to -1 ... 1; silence where it is not.
std::vector<float> sound_of(const sound::Samples& samples, const Sound& sound, double from,
                            std::size_t moments);

}  // namespace icome::animation
