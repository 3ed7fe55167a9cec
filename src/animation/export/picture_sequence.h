#pragma once
#include "animation/export/frame_maker.h"
#include "animation/export/output_names.h"

namespace icome::animation {

/// Writes a PNG or SVG file for each frame, over files of these names and no others; adds to the report.
base::Result<void> write_sequence(FrameMaker& maker, const OutputNames& names, ExportReport& report);

}  // namespace icome::animation
