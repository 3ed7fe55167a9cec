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

namespace {

/// Opens the pointers, the head's tracker and the device that moves the view, as the options name them.
base::Result<session::SessionSettings> settings_with_devices(const DesktopCommandOptions& options) {
  session::SessionSettings settings = desktop_settings();
  for (const std::string& name : options.devices) {
    auto device = session::open_connection(name);
    if (!device) return base::fail("--device: " + device.error().message);
    settings.connections.push_back(std::move(*device));
  }
  if (!options.head.empty()) {
    auto head = devices::open_head(options.head);
    if (!head) return base::fail("--head: " + head.error().message);
    settings.head = std::move(*head);
  }
  if (!options.navigation.empty() && options.navigation != "spacemouse") {
    auto navigation = devices::open_navigation(options.navigation);
    if (!navigation) return base::fail("--navigation: " + navigation.error().message);
    settings.navigation = std::move(*navigation);
  }
  return settings;
}

}  // namespace

int run_desktop_window(int argc, char** argv, const DesktopCommandOptions& options) {
  ui::DesktopOptions wanted;
  wanted.design = options.design;
  wanted.theme = options.theme;
  auto settings = settings_with_devices(options);
  if (!settings) {
    tell(settings.error().message);
    return 1;
  }
  return ui::run_desktop(argc, argv, wanted, std::move(*settings));
}

}  // namespace icome::apps
