#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace icome::apps {

/// The options of `icome` without a command.
struct DesktopCommandOptions {
  std::filesystem::path design = {};      // empty: none is named
  std::vector<std::string> devices = {};  // addresses of pointers; none: the mouse is the hand
  std::string theme = {};                 // "dark" or "light"; empty: as chosen before
};

}  // namespace icome::apps
