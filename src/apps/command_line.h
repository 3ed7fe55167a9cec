#pragma once
#include <optional>

#include "apps/touch_options.h"

namespace icome::apps {

/// What the command line asks for.
struct CommandLine {
  std::optional<TouchOptions> touch;  // set when a subcommand is to run
  int exit_code = 0;                  // else what to return: help and version were printed, or an error
};

/// Reads the command line. Help and version go to standard output; what is wrong is said in a sentence
/// on standard error, with exit code 2.
CommandLine parse_command_line(int argc, char** argv);

}  // namespace icome::apps
