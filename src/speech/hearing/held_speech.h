#pragma once
#include <deque>
#include <optional>
#include <vector>

#include "speech/hearing/voice_activity.h"

namespace icome::speech {

/// Cuts out of a sound, as it comes, what is said while a key is held down: one utterance, whatever pauses
/// are in it. One thread uses it; it owns what it has heard.
class HeldSpeech {
 public:
  explicit HeldSpeech(const VoiceSettings& settings = {}) : settings_(settings) {}

  /// Takes the next samples, and whether the key is held now; gives the utterance, once it has ended.
  std::optional<Utterance> hear(Sound samples, bool is_held);
  /// Is the key held, or was it let go so shortly ago that the last word still comes?
  bool is_taking() const { return taking_; }

  /// People press a key as they begin to speak, and let it go as they end.
  static constexpr double kBefore = 0.25, kAfter = 0.25;  // s, that belong to it

 private:
  std::optional<Utterance> end();

  VoiceSettings settings_;
  std::vector<std::int16_t> taken_;
  std::deque<std::int16_t> before_;
  double time_ = 0.0;   // s, of all that was heard
  double after_ = 0.0;  // s, since the key was let go
  bool taking_ = false;
};

}  // namespace icome::speech
