#pragma once
#include "animation/export/frame_maker.h"
#include "animation/export/output_names.h"

namespace icome::animation {

/// Writes the frames as one file, by ffmpeg; adds to the report.
base::Result<void> write_film(FrameMaker& maker, const OutputNames& names, ExportReport& report);

}  // namespace icome::animation
