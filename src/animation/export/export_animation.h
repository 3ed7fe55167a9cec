#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "animation/picture/stage_picture.h"

namespace icome::animation {

/// Frames of an animation, both ends with them.
struct FrameRange {
  int first = 0, last = 0;

  int count() const { return last - first + 1; }
};

struct ExportOptions {
  std::optional<FrameRange> range = {};  ///< none: all
  int width = 0, height = 0;             ///< px; 0: the stage's
  bool through_camera = true;
  /// Without, what no cell covers is clear; MP4 knows no such thing, and keeps it.
  bool background = true;
  bool sound = true;  ///< goes with MP4 and WebM
  /// Is called with the part that is done, 0 to 1, every tenth of a second at least while the export waits;
  /// false stops it. May be empty.
  std::function<bool(double part)> progress = {};
};

struct ExportReport {
  std::string format;  ///< for people: "MP4", "PNG" ...
  int frames = 0;
  int width = 0, height = 0;         ///< px
  double seconds = 0;                ///< of the animation
  std::vector<std::string> files;    ///< that were written
  std::vector<std::string> remarks;  ///< sentences on what came out otherwise, such as missing pictures
  bool is_whole = true;              ///< neither a picture nor the sound was missing
};

/// The states of all cells at a frame.
using StatesAt = std::function<CellStates(int frame)>;

/// Writes frames of an animation by the ending of the name (output_names.h): sequences of PNG and SVG by the
/// program itself, MP4, WebM, GIF and APNG by the program ffmpeg. The same project gives the same bytes each
/// time, with the same ffmpeg. Everything appears whole or not at all: until all is done, it is written
/// beside and under other names, which a stop and a failure take away. Pictures that are missing are crossed
/// frames, a sound that is missing is silence, and remarks tell. Fails with a sentence that names the file or
/// says what to install.
base::Result<ExportReport> export_animation(const Project& project, const StatesAt& states_at,
                                            CellPictures& pictures, const std::string& out,
                                            const ExportOptions& options = {});

}  // namespace icome::animation
