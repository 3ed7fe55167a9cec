#include "apps/desktop_command.h"

#include <filesystem>

#include "ui/desktop.h"

namespace icome::apps {

bool is_design_name(const std::string& word) {
  std::error_code error;
  return word.find_first_of("./") != std::string::npos || std::filesystem::exists(word, error);
}

int run_desktop_window(int argc, char** argv, const DesktopCommandOptions& options) {
  ui::DesktopOptions wanted;
  wanted.design = options.design;
  wanted.theme = options.theme;
  return ui::run_desktop(argc, argv, wanted, session::SessionSettings{});
}

}  // namespace icome::apps
