#pragma once
#include "apps/speech/speech_options.h"

namespace icome::apps {

/// Lists what can be said, or checks a vocabulary. Gives the exit code.
int run_voice(const VoiceOptions& options);

}  // namespace icome::apps
