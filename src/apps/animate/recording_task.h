#pragma once
#include <functional>

#include "animation/picture/cell_pictures.h"
#include "animation/script/animation_tool.h"
#include "apps/animate/animate_options.h"
#include "apps/animate/animate_report.h"

namespace icome::apps {

/// Called with the parts of a recording while it goes on (Recording::next_part()), so that they can be kept.
using KeepPart = std::function<void(const animation::ProjectEdit& part)>;

/// Lets triangles on a table move the cells of a project, frame by frame of the source, and takes it down as
/// one edit. Ctrl-C ends the recording, which is kept. `keep_part` is called about once a second of it.
base::Result<RecordedHands> record_hands(const AnimateOptions& options, animation::AnimationRunner& runner,
                                         animation::CellPictures& pictures, const KeepPart& keep_part);

}  // namespace icome::apps
