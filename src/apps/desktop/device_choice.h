#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "apps/eye_options.h"
#include "base/result.h"
#include "session/session.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace icome::apps {

/// The devices that a command line chooses for a window.
struct DeviceChoice {
  std::vector<std::string> pointers;  // addresses; none: the mouse is the hand
  std::string head;                   // address of a tracker on the user's head; empty: none
  std::filesystem::path head_table;   // of the head's transfer function; empty: table 5.4 of the thesis
  std::string head_filter = "mean";   // a name of interaction::head_filter_of()
  double head_predict_ms = 0.0;
  EyeOptions eyes;
  std::string navigation;  // address of a device that moves the view; empty: a 3D mouse, once there is one

  bool is_default() const {
    return pointers.empty() && head.empty() && navigation.empty() && eyes.is_default();
  }
};

/// Adds the options --device, --head and those that go with it, --navigation and those of eyes and screen.
void add_device_options(CLI::App& app, DeviceChoice& choice);

/// The settings of a session with these devices, which are opened; that may take seconds. The mouse's hand is
/// beside them, and a 3D mouse may be plugged in at any time. The error names the option and says what is
/// missing.
base::Result<session::SessionSettings> session_settings(const DeviceChoice& choice);

}  // namespace icome::apps
