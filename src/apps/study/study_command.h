#pragma once
#include "apps/study/study_options.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace icome::apps {

/// The options of `icome study` and its subcommands, which set `options`.
void add_study_options(CLI::App& study, StudyOptions& options);

/// Runs a subcommand of `icome study`: new, check, run, resume or report. Returns the program's exit code: 1
/// also where a study cannot be run as it is.
int run_study(int argc, char** argv, const StudyOptions& options);

}  // namespace icome::apps
