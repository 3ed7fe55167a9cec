#pragma once
#include "apps/speech/speech_options.h"

namespace icome::apps {

/// Runs the command of speech that was given. Gives the exit code.
int run_speech(const SpeechOptions& options);

}  // namespace icome::apps
