#pragma once
#include <filesystem>
#include <string>

#include "apps/desktop/device_choice.h"

namespace icome::apps {

/// The options of `icome` without a command.
struct DesktopCommandOptions {
  std::filesystem::path design = {};  // empty: none is named
  DeviceChoice devices = {};
  std::string theme = {};           // "dark" or "light"; empty: as chosen before
  std::filesystem::path menu = {};  // of the haptic menu; empty: as chosen before
  std::string microphone;           // or a recording; empty: the usual one
};

}  // namespace icome::apps
