#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "interaction/elements/element.h"
#include "session/session.h"

namespace icome::ui {

struct DesktopOptions {
  std::filesystem::path design = {};  // to open; empty: work left unsaved by a crash, or an empty design
  std::string theme = {};             // "dark", "light"; empty: as chosen before, or as the system has it
  std::optional<interaction::Element> menu = {};  // the haptic menu; none: as chosen before
  std::string microphone = {};  // by name, or a recording that is heard instead; empty: the usual one
};

/// Opens the window on a session with these settings (apps chooses the devices) and runs until it is closed;
/// returns the program's exit code. Where there is no display, it prints an error to standard error that
/// names `icome touch` and `icome shot` as the way on, and returns 1.
int run_desktop(int argc, char** argv, const DesktopOptions& options, session::SessionSettings settings);

}  // namespace icome::ui
