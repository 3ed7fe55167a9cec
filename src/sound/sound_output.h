#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "base/result.h"

namespace icome::sound {

/// Keeps ALSA from writing its own account of every failure to standard error.
void quieten_alsa();

/// Plays sounds through ALSA, which PipeWire and PulseAudio support, too. Has a thread of its own.
class SoundOutput {
 public:
  /// Opens the system's default sound output for one channel of so many samples a second. Fails where there
  /// is none, saying what to do.
  static base::Result<std::unique_ptr<SoundOutput>> open(int rate);
  ~SoundOutput();

  /// Plays the samples at once, in place of what is played now; returns without waiting.
  void play(std::vector<std::int16_t> samples);
  /// Ends what is played.
  void stop();
  /// Is something played, or about to be?
  bool is_playing() const;
  /// Was the last sound not heard to its end, as the output is lost or suspended? Then open another.
  bool is_lost() const;

 private:
  struct Parts;
  explicit SoundOutput(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::sound
