#pragma once
#include "apps/head/head_command.h"

namespace icome::apps {

/// `icome head --calibrate` and `--record`: what a camera sees of a head. Give the exit code.
int run_head_calibration(const HeadOptions& options);
int run_head_recording(const HeadOptions& options);

}  // namespace icome::apps
