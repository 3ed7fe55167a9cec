#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace icome::apps {

/// The options of `icome` without a command.
struct DesktopCommandOptions {
  std::filesystem::path design = {};      // empty: none is named
  std::vector<std::string> devices = {};  // addresses of pointers; none: the mouse is the hand
  std::string head = {};                  // address of a tracker on the user's head; empty: none
  std::string navigation =
      {};                  // address of a device that moves the view; empty: a 3D mouse, once there is one
  std::string theme = {};  // "dark" or "light"; empty: as chosen before
};

}  // namespace icome::apps
