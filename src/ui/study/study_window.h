#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "session/session.h"
#include "study/run/session_run.h"

namespace icome::ui {

struct StudyWindowOptions {
  bool full_screen = true;
  std::string theme = {};                   // "dark", "light"; empty: light
  speech::OpenSource microphone = nullptr;  // for trials that need speech; none: the usual one
  /// Was the program asked to end (Ctrl-C)? It is called often; the session can be resumed then.
  std::function<bool()> interrupted = [] { return false; };
};

/// Runs one person's session in a window, to its end; trials take place in a session of these settings.
/// `begin` makes the run once the window can be opened and the devices work; its error is told on standard
/// error. `folder` is that of the study file. Returns the program's exit code: 0 the person has finished; 1
/// it could not begin, and standard error tells why (also where there is no display); 3 it ended before that:
/// it can be resumed.
int run_study_window(int argc, char** argv, const StudyWindowOptions& options,
                     const std::filesystem::path& folder, session::SessionSettings settings,
                     const std::function<base::Result<study::SessionRun>()>& begin);

}  // namespace icome::ui
