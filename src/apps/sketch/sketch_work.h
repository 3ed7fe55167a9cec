#pragma once
#include <string>
#include <vector>

#include "apps/sketch/design_drawing.h"
#include "apps/sketch/sketch_options.h"
#include "base/result.h"
#include "sketch/files/drawing_files.h"

namespace icome::apps {

// Functions that the commands of icome sketch have in common.

constexpr double kMillimetresOfMetre = 1000.0;
constexpr int kSketchInterrupted = 130;  // what shells report for Ctrl-C

/// Tells why, and gives the exit code.
int sketch_failed(const base::Error& error);

/// A length in mm, without the digits that turning m into mm makes.
double in_mm(double metres);

drawing::SvgLines svg_lines(const SketchOptions& options);
sketch::PictureOptions picture_options(const SketchOptions& options);

std::size_t count_segments(const drawing::Drawing& drawing);

/// The remarks of the reader of the design.
std::vector<std::string> notes_of(const DesignDrawing& read);

/// The drawing to begin with: an empty page for "new", an SVG file, a drawing in a design, or the curves of a
/// recording.
base::Result<drawing::DrawingRead> read_for_sketch(const SketchOptions& options);

}  // namespace icome::apps
