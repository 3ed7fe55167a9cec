#include "speech/speaking/espeak.h"

#include <espeak-ng/speak_lib.h>

namespace icome::speech {
namespace {

std::mutex& mutex_of_library() {
  static std::mutex mutex;
  return mutex;
}

/// The rate of what it speaks; 0 where the voice is missing.
int begin() {
  const int rate = espeak_Initialize(AUDIO_OUTPUT_SYNCHRONOUS, 0, nullptr, espeakINITIALIZE_DONT_EXIT);
  return rate > 0 && espeak_SetVoiceByName("en-us") == EE_OK ? rate : 0;
}

}  // namespace

Espeak::Espeak() : lock_(mutex_of_library()) { (void)rate(); }

int Espeak::rate() const {
  static const int kRate = begin();
  return kRate;
}

}  // namespace icome::speech
