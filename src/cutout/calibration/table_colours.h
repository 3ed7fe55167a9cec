#pragma once
#include "base/result.h"
#include "cutout/tracker/frame.h"
#include "cutout/tracker/table_view.h"

namespace icome::cutout {

/// Measures the colours of the table and of the triangle that lies on it, which are shown with nothing else:
/// the commonest colour of the table's part of the frame, and the commonest of those that are much bluer.
/// Fails, saying why, where there is no such second colour, or the tracker could not tell the two apart.
base::Result<TableColours> measure_colours(const FrameView& frame, const TableView& view);

/// The mean of several measurements. At least one.
TableColours mean_of(const std::vector<TableColours>& measured);

}  // namespace icome::cutout
