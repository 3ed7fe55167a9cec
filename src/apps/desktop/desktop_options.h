#pragma once
#include <filesystem>
#include <string>

namespace icome::apps {

/// The options of `icome` without a command.
struct DesktopCommandOptions {
  std::filesystem::path design = {};  // empty: none is named
  std::string theme = {};             // "dark" or "light"; empty: as chosen before
};

}  // namespace icome::apps
