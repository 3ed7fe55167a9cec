#include "speech/hearing/voice_activity.h"

#include <algorithm>
#include <cmath>

namespace icome::speech {
namespace {

constexpr double kFrame = 0.01;  // s
constexpr std::size_t kFrameSamples = std::size_t(kSampleRate * kFrame);
constexpr double kQuietest = -75.0;        // dB: below is no microphone, only rounding
constexpr std::size_t kNoiseFrames = 150;  // that the noise is estimated from
constexpr std::size_t kFirstFrames = 50;   // before the noise is known
constexpr double kNoiseShare = 0.1;        // of them are quieter than the noise
constexpr double kSpeechRange = 25.0;      // dB from the loudest frame of speech to its noise, at least

/// Power of the frame without its mean, dB below full scale.
double level_of(Sound frame) {
  double sum = 0.0, squares = 0.0;
  for (const std::int16_t sample : frame) {
    sum += sample;
    squares += double(sample) * sample;
  }
  const double count = double(frame.size()), mean = sum / count;
  constexpr double kFull = 32768.0;
  const double power = std::max(0.0, squares / count - mean * mean) / (kFull * kFull);
  return 10.0 * std::log10(power + 1e-12);
}

}  // namespace

std::vector<Utterance> VoiceActivity::hear(Sound samples) {
  std::vector<Utterance> done;
  for (const std::int16_t sample : samples) {
    frame_.push_back(sample);
    if (frame_.size() == kFrameSamples) hear_frame(done);
  }
  return done;
}

void VoiceActivity::hear_frame(std::vector<Utterance>& done) {
  const double level = level_ = level_of(frame_);
  recent_.push_back(level);
  if (recent_.size() > kNoiseFrames) recent_.erase(recent_.begin());
  std::vector<double> sorted = recent_;
  const auto place = sorted.begin() + std::ptrdiff_t(kNoiseShare * double(sorted.size() - 1));
  std::ranges::nth_element(sorted, place);
  noise_ = std::max(kQuietest, *place);
  if (recent_.size() < kFirstFrames) noise_ = std::min(noise_, settings_.first_noise);
  const bool is_loud = level > noise_ + settings_.above_noise && level > kQuietest + settings_.above_noise;
  if (is_loud && !speaking_) {
    speaking_ = true;
    current_ = {time_ - double(before_.size()) / kSampleRate, 0.0, {before_.begin(), before_.end()}};
    loud_ = quiet_ = 0.0;
    before_.clear();
  }
  time_ += kFrame;
  if (speaking_) {
    current_.samples.insert(current_.samples.end(), frame_.begin(), frame_.end());
    if (is_loud) {
      loud_ += kFrame;
      quiet_ = 0.0;
      current_.speech_end = time_;
    } else {
      quiet_ += kFrame;
    }
    if (quiet_ >= settings_.hang || time_ - current_.begin > settings_.longest)
      if (auto utterance = end()) done.push_back(std::move(*utterance));
  } else {
    before_.insert(before_.end(), frame_.begin(), frame_.end());
    const auto most = std::size_t(settings_.lead * kSampleRate);
    while (before_.size() > most) before_.pop_front();
  }
  frame_.clear();
}

std::optional<Utterance> VoiceActivity::end() {
  speaking_ = false;
  Utterance utterance = std::move(current_);
  current_ = {};
  if (loud_ < settings_.shortest) return std::nullopt;
  return utterance;
}

std::vector<Utterance> utterances_of(Sound recording, VoiceSettings settings) {
  std::vector<double> levels;
  for (std::size_t at = 0; at + kFrameSamples <= recording.size(); at += kFrameSamples)
    levels.push_back(level_of(recording.subspan(at, kFrameSamples)));
  if (levels.empty()) return {};
  std::ranges::sort(levels);
  // What begins with speech and ends with it has no frames of noise alone.
  settings.first_noise =
      std::min(levels[std::size_t(kNoiseShare * double(levels.size() - 1))], levels.back() - kSpeechRange);
  VoiceActivity activity(settings);
  std::vector<Utterance> utterances = activity.hear(recording);
  if (auto last = activity.finish()) utterances.push_back(std::move(*last));
  return utterances;
}

std::optional<Utterance> VoiceActivity::finish() { return speaking_ ? end() : std::nullopt; }

}  // namespace icome::speech
