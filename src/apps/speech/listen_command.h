#pragma once
#include "apps/speech/speech_options.h"

namespace icome::apps {

/// Understands recordings of speech. Gives the exit code.
int run_listen(const ListenOptions& options);

}  // namespace icome::apps
