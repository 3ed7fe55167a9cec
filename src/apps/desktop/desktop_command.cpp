#include "apps/desktop/desktop_command.h"

#include <filesystem>
#include <utility>

#include "devices/spacemouse/space_mouse.h"
#include "ui/window/desktop.h"

namespace icome::apps {

/// A 3D mouse may be plugged in at any time. Without a force-feedback device, the mouse is the hand.
session::SessionSettings desktop_settings() {
  session::SessionSettings settings;
  if (auto mouse = devices::SpaceMouse::create({.wait = true})) settings.navigation = std::move(*mouse);
  return settings;
}

bool is_design_name(const std::string& word) {
  std::error_code error;
  return word.find_first_of("./") != std::string::npos || std::filesystem::exists(word, error);
}

int run_desktop_window(int argc, char** argv, const DesktopCommandOptions& options) {
  ui::DesktopOptions wanted;
  wanted.design = options.design;
  wanted.theme = options.theme;
  return ui::run_desktop(argc, argv, wanted, desktop_settings());
}

}  // namespace icome::apps
