#include "sketch/files/drawing_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/file_ending.h"
#include "io/new_file.h"
#include "sketch/files/stroke_files.h"

namespace icome::sketch {
namespace {

constexpr double kBesideStrokes = 0.01;  // m, of paper beyond what lies farthest

}  // namespace

Drawing drawing_of(std::span<const FittedStroke> strokes) {
  Drawing drawing;
  Layer layer;
  layer.id = drawing.next_layer_id();
  layer.name = "Strokes";
  for (const FittedStroke& fitted : strokes) {
    auto stroke = std::make_shared<Stroke>();
    stroke->id = drawing.next_stroke_id();
    stroke->curve = fitted.curve;
    layer.strokes.push_back(std::move(stroke));
  }
  drawing.layers.push_back(std::move(layer));
  const Bounds2 box = drawing.bounds();
  if (!box.isEmpty() && (box.max().array() > drawing.size.array()).any())
    drawing.size = box.max() + Vector2::Constant(kBesideStrokes);
  return drawing;
}

base::Result<drawing::DrawingRead> read_drawing(const std::filesystem::path& file,
                                                const FitSettings& settings) {
  if (io::ending_of(file).type == ".svg") return drawing::read_svg_drawing(file);
  auto read = read_strokes(file);
  if (!read) return tl::unexpected(read.error());
  std::vector<FittedStroke> fitted;
  for (const PenStroke& stroke : read->strokes) {
    if (const auto good = check_fit(stroke, settings.error); !good)
      return base::fail(
          fmt::format("{}: stroke {}: {}", file.string(), fitted.size() + 1, good.error().message));
    fitted.push_back(fit_stroke(stroke, settings));
  }
  return drawing::DrawingRead{drawing_of(fitted), std::move(read->notes)};
}

base::Result<void> check_can_write_drawing(const std::filesystem::path& path) {
  const std::string ending = io::ending_of(path).type;
  if (ending == ".svg" || ending == ".png" || ending == ".pdf") return {};
  return base::fail(fmt::format("{}: drawings are written as .svg, .png or .pdf", path.string()));
}

base::Result<void> write_drawing(const Drawing& drawing, const std::filesystem::path& path,
                                 const PictureOptions& options, drawing::SvgLines lines) {
  if (io::ending_of(path).type != ".svg") return write_picture(drawing, options, path);
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(drawing::svg_text(drawing, lines));
  return file->finish();
}

}  // namespace icome::sketch
