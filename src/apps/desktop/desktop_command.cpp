#include "apps/desktop/desktop_command.h"

#include <filesystem>
#include <utility>

#include "apps/terminal.h"
#include "interaction/elements/element_file.h"
#include "ui/window/desktop.h"

namespace icome::apps {

bool is_design_name(const std::string& word) {
  std::error_code error;
  return word.find_first_of("./") != std::string::npos || std::filesystem::exists(word, error);
}

int run_desktop_window(int argc, char** argv, const DesktopCommandOptions& options) {
  ui::DesktopOptions wanted;
  wanted.design = options.design;
  wanted.theme = options.theme;
  wanted.microphone = options.microphone;
  if (!options.menu.empty()) {
    auto menu = interaction::read_element_file(options.menu);
    if (!menu) {
      tell(menu.error().message);
      return 1;
    }
    wanted.menu = std::move(*menu);
  }
  auto settings = session_settings(options.devices);
  if (!settings) {
    tell(settings.error().message);
    return 1;
  }
  return ui::run_desktop(argc, argv, wanted, std::move(*settings));
}

}  // namespace icome::apps
