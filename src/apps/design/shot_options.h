#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "apps/design/design_options.h"
#include "base/result.h"
#include "interaction/screen_view.h"

namespace icome::apps {

/// The options of `icome shot`, as the command line gives them.
struct ShotOptions {
  std::filesystem::path file;
  std::filesystem::path out;
  ReadingOptions reading;
  int width = 1280;                    // pixels
  int height = 960;                    // pixels
  std::string view;                    // a direction or a viewpoint; empty: the first viewpoint, or iso
  std::string scene;                   // empty: all objects
  std::optional<double> time;          // s, of the design's motions; none: at rest
  bool studio = false;                 // light it as a studio does even if the design has lights
  bool clear = false;                  // no background
  std::optional<unsigned> background;  // 0xrrggbb; none: a soft gradient
  interaction::StereoSettings stereo;
  std::optional<base::Vector2> screen;  // m; none: as large as the view is wide, 0.6 m off
  std::optional<base::Vector3> eye;     // m, from the middle of the screen; none: 0.6 m straight before it
  bool json = false;
};

/// "1280x960", sides of 1 to 16384 pixels.
base::Result<void> parse_size(const std::string& text, ShotOptions& options);

/// "none", "white", "black" or "#rrggbb".
base::Result<void> parse_background(const std::string& text, ShotOptions& options);

}  // namespace icome::apps
