#pragma once
#include <string>

#include "apps/desktop/desktop_options.h"

namespace icome::apps {

/// Could the word be meant as a design's file, rather than as a command that does not exist?
bool is_design_name(const std::string& word);

/// Opens the desktop window, and gives the process's exit code when it is closed.
int run_desktop_window(int argc, char** argv, const DesktopCommandOptions& options);

}  // namespace icome::apps
