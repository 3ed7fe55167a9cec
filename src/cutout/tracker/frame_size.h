#pragma once
#include "base/result.h"
#include "cutout/tracker/frame.h"
#include "cutout/tracker/table_view.h"

namespace icome::cutout {

/// Fails, saying so, when the frame has not the size of those that the view was calibrated with.
base::Result<void> check_frame_size(const FrameView& frame, const TableView& view);

}  // namespace icome::cutout
