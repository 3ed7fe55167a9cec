#pragma once
#include <optional>
#include <string>

#include "base/result.h"
#include "interaction/screen_view.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace icome::apps {

/// The options that say where eyes and screen are.
struct EyeOptions {
  std::string stereo;             // a name of interaction::stereo_of(); empty: as chosen before, or off
  double eye_distance_mm = 63.0;  // between the eyes
  std::string screen;             // "520x320", mm; empty: as the display tells it, or as the view has it
  bool fish_tank = false;
  bool squeezed = false;

  bool is_default() const { return stereo.empty() && screen.empty() && !fish_tank && !squeezed; }
};

/// Adds --stereo, --eye-distance-mm and --screen; `screen_help` says what the screen is.
void add_eye_options(CLI::App& app, EyeOptions& options, const std::string& screen_help);
/// Adds --fish-tank and --squeezed, which are for windows.
void add_fish_tank_options(CLI::App& app, EyeOptions& options);

/// Precondition: the options were read by CLI11, which has checked them.
interaction::StereoSettings stereo_settings(const EyeOptions& options);

/// "520x320", mm, as m; sides of 10 mm to 100 m.
base::Result<base::Vector2> parse_screen(const std::string& text);

/// "X,Y,Z", mm from the middle of the screen to the right, up and towards the user, as m. At least 50 mm
/// before the screen, and at most 100 m off.
base::Result<base::Vector3> parse_eye(const std::string& text);

}  // namespace icome::apps
