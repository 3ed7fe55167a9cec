#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "sketch/fit/pen_sample.h"

namespace icome::sketch {

/// The content of a recording of a pen.
struct StrokesRead {
  std::vector<PenStroke> strokes;  ///< at least one, each of at least one sample, in the file's order
  std::vector<std::string> notes;  ///< what was taken otherwise than the file says, or skipped: a line each
  bool has_pressure = true;        ///< else the pen felt none, and every sample has 1
};

/// Reads the strokes of a pen: CSV with the header t,x,y,pressure, InkML, .svc (SVC 2004), .scap
/// (StrokeStrip), .dat (MyPaint) or .events (evemu, with ranges from a .desc beside it). The ending of the
/// name tells the format; the content, where the ending tells none. Fails with file and line on what is no
/// such recording, and where there is no stroke in it.
base::Result<StrokesRead> read_strokes(const std::filesystem::path& file);

}  // namespace icome::sketch
