#pragma once
#include <filesystem>
#include <string>

namespace icome::apps {

/// What `icome` without a command is asked for.
struct DesktopCommandOptions {
  std::filesystem::path design = {};  // empty: none is named
  std::string theme = {};             // "dark" or "light"; empty: as chosen before
};

}  // namespace icome::apps
