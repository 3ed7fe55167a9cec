#pragma once
#include <functional>

#include "animation/picture/cell_pictures.h"
#include "animation/script/animation_tool.h"
#include "apps/animate/animate_options.h"
#include "apps/animate/animate_report.h"

namespace icome::apps {

/// Keeps a recording while it goes on.
struct RecordingKeeper {
  /// Called when the first frame has come; where it fails nothing is recorded.
  std::function<base::Result<void>()> begin;
  /// Called with what came since, about once a second of it (Recording::next_part()).
  std::function<void(const animation::ProjectEdit& part)> keep;
};

/// Lets triangles on a table move the cells of a project, frame by frame of the source, and takes it down as
/// one edit. Ctrl-C ends the recording, which is kept.
base::Result<RecordedHands> record_hands(const AnimateOptions& options, animation::AnimationRunner& runner,
                                         animation::CellPictures& pictures, const RecordingKeeper& keeper);

}  // namespace icome::apps
