#pragma once
#include <optional>

#include "apps/animate/animate_options.h"
#include "apps/csg/csg_options.h"
#include "apps/design/design_options.h"
#include "apps/design/shot_options.h"
#include "apps/desktop/desktop_options.h"
#include "apps/devices/devices_options.h"
#include "apps/head/head_command.h"
#include "apps/menu/menu_command.h"
#include "apps/remote/keep_command.h"
#include "apps/serving/serving_options.h"
#include "apps/sketch/sketch_options.h"
#include "apps/speech/speech_options.h"
#include "apps/stats/stats_options.h"
#include "apps/study/study_options.h"
#include "apps/techniques/techniques_options.h"
#include "apps/touch/touch_options.h"
#include "apps/track/track_options.h"

namespace icome::apps {

/// The options given on the command line.
struct CommandLine {
  // The subcommand that is to run, or the window that is to open.
  std::optional<TouchOptions> touch;
  std::optional<CsgOptions> csg;
  std::optional<InfoOptions> info;
  std::optional<ConvertOptions> convert;
  std::optional<EditOptions> edit;
  std::optional<ShotOptions> shot;
  std::optional<StatsOptions> stats;
  std::optional<StudyOptions> study;
  std::optional<TechniquesOptions> techniques;
  std::optional<DevicesOptions> devices;
  std::optional<ServingOptions> serving;
  std::optional<KeepOptions> keep;
  std::optional<HeadOptions> head;
  std::optional<MenuOptions> menu;
  std::optional<SpeechOptions> speech;
  std::optional<SketchOptions> sketch;
  std::optional<TrackOptions> track;
  std::optional<AnimateOptions> animate;
  std::optional<DesktopCommandOptions> desktop;
  int exit_code = 0;  // to return when none is set: help or version were printed, or an error
};

/// Reads the command line. Help and version go to standard output; an error is reported in a sentence
/// on standard error, with exit code 2.
CommandLine parse_command_line(int argc, char** argv);

}  // namespace icome::apps
