#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "base/result.h"

namespace icome::ui {

/// The tone of 880 Hz and 150 ms that starts a trial, with `rate` samples a second (mono, 16 bits). It swells
/// and fades within 5 ms, so that it does not click.
std::vector<std::int16_t> start_tone(unsigned rate);

/// Plays the tone through ALSA, which PipeWire and PulseAudio support, too. Has a thread of its own.
class StudyBeep {
 public:
  /// Opens the system's default sound output. Fails where there is none.
  static base::Result<std::unique_ptr<StudyBeep>> create();
  ~StudyBeep();

  /// Plays the tone at once; returns without waiting.
  void play();

 private:
  struct Parts;
  explicit StudyBeep(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::ui
