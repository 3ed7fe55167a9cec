#pragma once
#include <span>

#include "drawing/svg/svg_reader.h"
#include "drawing/svg/svg_writer.h"
#include "sketch/files/picture.h"
#include "sketch/fit/stroke_fit.h"

namespace icome::sketch {

/// A drawing of one layer with the curves of a pen, on A4 paper or, where that is too small, on a larger one.
Drawing drawing_of(std::span<const FittedStroke> strokes);

/// Reads an SVG file, or a recording of a pen (stroke_files.h), whose strokes become curves. Fails as the
/// reader of the format does.
base::Result<drawing::DrawingRead> read_drawing(const std::filesystem::path& file,
                                                const FitSettings& settings);

/// Can write_drawing() write files with this ending? Fails with the endings that it can write.
base::Result<void> check_can_write_drawing(const std::filesystem::path& path);

/// Writes a drawing by the path's ending: .svg, which keeps all; .png and .pdf, which are pictures. The file
/// appears whole or not at all.
base::Result<void> write_drawing(const Drawing& drawing, const std::filesystem::path& path,
                                 const PictureOptions& options, drawing::SvgLines lines);

}  // namespace icome::sketch
