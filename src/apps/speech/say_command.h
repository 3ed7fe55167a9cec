#pragma once
#include "apps/speech/speech_options.h"

namespace icome::apps {

/// Understands sentences about a design and does what they say. Gives the exit code.
int run_say(const SayOptions& options);

}  // namespace icome::apps
