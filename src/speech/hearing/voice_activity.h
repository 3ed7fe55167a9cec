#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "speech/hearing/recogniser.h"

namespace icome::speech {

/// Settings of the detection of speech.
struct VoiceSettings {
  double hang = 0.2;           // s of silence that end an utterance; 0.1 to 2
  double lead = 0.2;           // s before the first loud frame that belong to it
  double shortest = 0.08;      // s of loud frames; less is a click
  double longest = 20.0;       // s, after which it ends anyway
  double above_noise = 8.0;    // dB that speech is above the noise; 3 to 30
  double first_noise = -50.0;  // dB below full scale, until half a second was heard
};

/// An utterance that was cut out of a sound.
struct Utterance {
  double begin = 0.0;       // s, of its first sample
  double speech_end = 0.0;  // s, where its last loud frame ends
  std::vector<std::int16_t> samples = {};
};

/// Cuts utterances out of a sound as it comes: frames of 10 ms whose power is above that of the noise, which
/// is followed. One thread uses it; it owns what it has heard.
class VoiceActivity {
 public:
  explicit VoiceActivity(const VoiceSettings& settings = {}) : settings_(settings) {}

  /// Takes the next samples; gives the utterances that have ended.
  std::vector<Utterance> hear(Sound samples);
  /// The utterance that the end of the sound cuts off, if any.
  std::optional<Utterance> finish();

  /// Level of the last frame, dB below full scale, and of the noise.
  double level() const { return level_; }
  double noise_level() const { return noise_; }
  bool is_speaking() const { return speaking_; }

 private:
  void hear_frame(std::vector<Utterance>& done);
  std::optional<Utterance> end();

  VoiceSettings settings_;
  std::vector<std::int16_t> frame_;
  std::deque<std::int16_t> before_;  // the lead
  Utterance current_;
  double time_ = 0.0, level_ = -120.0, noise_ = -60.0;
  double loud_ = 0.0, quiet_ = 0.0;  // s, of the utterance: loud frames, and silence at its end
  std::vector<double> recent_;       // dB, of the last frames, for the noise
  bool speaking_ = false;
};

/// The utterances of a whole recording, whose noise is known from all of it.
std::vector<Utterance> utterances_of(Sound recording, VoiceSettings settings);

}  // namespace icome::speech
