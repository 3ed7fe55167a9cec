#include "speech/hearing/held_speech.h"

#include <algorithm>

namespace icome::speech {

std::optional<Utterance> HeldSpeech::hear(Sound samples, bool is_held) {
  const double seconds = double(samples.size()) / kSampleRate;
  time_ += seconds;
  if (is_held && !taking_) {
    taking_ = true;
    taken_.assign(before_.begin(), before_.end());
    before_.clear();
  }
  if (!taking_) {
    before_.insert(before_.end(), samples.begin(), samples.end());
    constexpr auto kMost = std::size_t(kBefore * kSampleRate);
    if (before_.size() > kMost) before_.erase(before_.begin(), before_.end() - std::ptrdiff_t(kMost));
    return std::nullopt;
  }
  taken_.insert(taken_.end(), samples.begin(), samples.end());
  after_ = is_held ? 0.0 : after_ + seconds;
  const bool is_long = double(taken_.size()) > settings_.longest * kSampleRate;
  return after_ >= kAfter || is_long ? end() : std::nullopt;
}

/// All from the first sound of speech to the last one.
std::optional<Utterance> HeldSpeech::end() {
  taking_ = false;
  after_ = 0.0;
  const double begin = time_ - double(taken_.size()) / kSampleRate;
  const std::vector<Utterance> parts = utterances_of(taken_, settings_);
  if (parts.empty()) return std::nullopt;
  const auto index = [&](double time) {
    return std::clamp(std::ptrdiff_t(time * kSampleRate), std::ptrdiff_t(0), std::ptrdiff_t(taken_.size()));
  };
  const double last = parts.back().begin + double(parts.back().samples.size()) / kSampleRate;
  Utterance all{begin + parts.front().begin, begin + parts.back().speech_end};
  all.samples.assign(taken_.begin() + index(parts.front().begin), taken_.begin() + index(last));
  return all;
}

}  // namespace icome::speech
