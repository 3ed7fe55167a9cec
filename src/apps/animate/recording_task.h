#pragma once
#include "animation/picture/cell_pictures.h"
#include "animation/script/animation_tool.h"
#include "apps/animate/animate_options.h"
#include "apps/animate/animate_report.h"

namespace icome::apps {

/// Lets triangles on a table move the cells of a project, frame by frame of the source, and takes it down as
/// one edit. Ctrl-C ends the recording, which is kept.
base::Result<RecordedHands> record_hands(const AnimateOptions& options, animation::AnimationRunner& runner,
                                         animation::CellPictures& pictures);

}  // namespace icome::apps
