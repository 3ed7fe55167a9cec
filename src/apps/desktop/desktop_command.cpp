#include "apps/desktop/desktop_command.h"

#include <filesystem>
#include <utility>

#include "apps/terminal.h"
#include "devices/catalogue.h"
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
  session::SessionSettings settings = desktop_settings();
  for (const std::string& name : options.devices) {
    auto device = devices::open_device(name);
    if (!device) {
      tell("--device: " + device.error().message);
      return 1;
    }
    settings.pointers.push_back(std::move(*device));
  }
  return ui::run_desktop(argc, argv, wanted, std::move(settings));
}

}  // namespace icome::apps
