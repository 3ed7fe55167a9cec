#pragma once
#include <string>

#include "apps/desktop/desktop_options.h"
#include "session/session.h"

namespace icome::apps {

/// May the word on the command line be meant as a design's file, and not as a command that there is not?
bool is_design_name(const std::string& word);

/// A session with what devices there are.
session::SessionSettings desktop_settings();

/// Opens the desktop window, and gives the process's exit code when it is closed.
int run_desktop_window(int argc, char** argv, const DesktopCommandOptions& options);

}  // namespace icome::apps
