#include "apps/sketch/sketch_work.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/status_line.h"
#include "apps/terminal.h"

namespace icome::apps {

int sketch_failed(const base::Error& error) {
  tell(error.message);
  return kFailed;
}

double in_mm(double metres) { return std::round(metres * kMillimetresOfMetre * 1e9) / 1e9; }

drawing::SvgLines svg_lines(const SketchOptions& options) {
  return options.centre_lines ? drawing::SvgLines::CentreLines : drawing::SvgLines::Outlines;
}

sketch::PictureOptions picture_options(const SketchOptions& options) {
  sketch::PictureOptions picture;
  picture.longer_side = options.size;
  if (options.background == "none") picture.background.reset();
  if (options.page == "paper") picture.area = sketch::PictureArea::Paper;
  if (options.page == "drawing") picture.area = sketch::PictureArea::Drawing;
  return picture;
}

std::size_t count_segments(const drawing::Drawing& drawing) {
  std::size_t segments = 0;
  for (const drawing::Layer& layer : drawing.layers)
    for (const drawing::StrokePointer& stroke : layer.strokes) segments += stroke->curve.segments.size();
  return segments;
}

std::vector<std::string> notes_of(const DesignDrawing& read) {
  std::vector<std::string> notes;
  for (const files::Remark& remark : read.design.remarks) notes.push_back(remark.text);
  return notes;
}

base::Result<drawing::DrawingRead> read_for_sketch(const SketchOptions& options) {
  if (options.in == "new") {
    drawing::DrawingRead empty;
    empty.drawing.layers.push_back({.id = empty.drawing.next_layer_id(), .name = "Layer 1", .strokes = {}});
    return empty;
  }
  StatusLine status;
  status.say("Reading " + options.in.string());
  if (names_design(options.in)) {
    const auto read = read_design_drawing(options.in, options.object);
    if (!read) return tl::unexpected(read.error());
    return drawing::DrawingRead{read->drawing(), notes_of(*read)};
  }
  return sketch::read_drawing(options.in, options.fit.settings());
}

}  // namespace icome::apps
