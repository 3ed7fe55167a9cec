#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "sound/sound_file.h"
#include "speech/hearing/recogniser.h"
#include "speech/speaking/speaker.h"

namespace icome::speech {

/// The sentence in the synthetic voice, as a microphone hears it.
inline std::vector<std::int16_t> said_aloud(const std::string& sentence) {
  const SpokenSentence spoken = spoken_sentence(sentence).value();
  sound::Samples samples{.rate = spoken.rate, .values = {}};
  for (const std::int16_t sample : spoken.samples) samples.values.push_back(float(sample) / 32768.0F);
  const sound::Samples heard = sound::resampled(std::move(samples), kSampleRate, "").value();
  std::vector<std::int16_t> said;
  for (const float value : heard.values)
    said.push_back(std::int16_t(std::clamp(value, -1.0F, 0.99F) * 32768.0F));
  return said;
}

}  // namespace icome::speech
