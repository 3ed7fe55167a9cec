#include "sketch/files/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "drawing/outline/outline.h"
#include "drawing/svg/svg_writer.h"
#include "io/file_ending.h"
#include "io/new_file.h"

namespace icome::sketch {
namespace {

charts::Colour chart_colour(const Colour& colour, double opacity) {
  return {double(colour[0]), double(colour[1]), double(colour[2]), opacity};
}

charts::CubicLoop page_loop(const std::vector<CubicBezier>& edges, const Eigen::Affine2d& page_from_paper) {
  charts::CubicLoop loop;
  if (edges.empty()) return loop;
  loop.points.reserve(3 * edges.size() + 1);
  loop.points.push_back(page_from_paper * edges.front().points[0]);
  for (const CubicBezier& edge : edges) {
    for (std::size_t i = 1; i < 4; ++i) loop.points.push_back(page_from_paper * edge.points[i]);
  }
  return loop;
}

/// The box of a stroke with its width; empty where it has no segments.
Bounds2 painted_box(const Curve& curve) {
  Bounds2 box = curve.bounds();
  const double reach = 0.5 * curve.widest();
  if (!box.isEmpty()) box = Bounds2(box.min().array() - reach, box.max().array() + reach);
  return box;
}

charts::Area page_area(const Bounds2& box, const Eigen::Affine2d& page_from_paper) {
  const Bounds2 on_page = box.transformed(page_from_paper);
  constexpr double kSoftRim = 2.0;  // page units: whole pixels around what is smoothed
  const Vector2 corner = on_page.min().array() - kSoftRim;
  const Vector2 size = on_page.sizes().array() + 2.0 * kSoftRim;
  return {corner.x(), corner.y(), size.x(), size.y()};
}

/// The box of what visible layers show.
Bounds2 visible_box(const Drawing& drawing) {
  Bounds2 box;
  for (const Layer& layer : drawing.layers) {
    if (!layer.visible) continue;
    for (const StrokePointer& stroke : layer.strokes) box.extend(painted_box(stroke->curve));
  }
  return box;
}

Bounds2 shown_box(const Drawing& drawing, const PictureOptions& options) {
  const Bounds2 paper(Vector2(0.0, 0.0), drawing.size);
  const Bounds2 box = visible_box(drawing);
  const bool fits = box.isEmpty() || paper.contains(box);
  const bool drawing_only = options.area == PictureArea::Drawing && !box.isEmpty();
  if (options.area == PictureArea::Paper || (fits && !drawing_only)) return paper;
  return {box.min().array() - options.margin, box.max().array() + options.margin};
}

constexpr double kMmPerMetre = 1000.0;
constexpr double kPixelTolerance = 0.02;  // of a pixel: less is not seen
constexpr double kPaperTolerance = 1e-6;  // m, of files that can be enlarged
constexpr double kPointsPerMetre = 72.0 / 0.0254;

Eigen::Affine2d page_from_box(const Bounds2& box, double scale) {
  Eigen::Affine2d page_from_paper = Eigen::Affine2d::Identity();
  page_from_paper.scale(scale).translate(-box.min());
  return page_from_paper;
}

base::Result<double> pixels_per_metre(const Bounds2& box, const PictureOptions& options) {
  const double longer = box.sizes().maxCoeff();
  const double scale =
      options.pixels_per_mm ? *options.pixels_per_mm * kMmPerMetre : double(options.longer_side) / longer;
  const double pixels = std::round(longer * scale);
  if (pixels >= 1.0 && pixels <= double(kLongestPictureSide)) return scale;
  return base::fail(fmt::format("a picture of {:.0f} mm cannot have {:.0f} pixels; choose 1 to {}",
                                longer * kMmPerMetre, pixels, kLongestPictureSide));
}

void paint_page(charts::Canvas& canvas, const Drawing& drawing, const PictureOptions& options,
                const Eigen::Affine2d& page_from_paper, double tolerance) {
  if (options.background) {
    canvas.fill({0.0, 0.0, canvas.width(), canvas.height()}, chart_colour(*options.background, 1.0));
  }
  paint(canvas, drawing, page_from_paper, tolerance);
}

base::Result<std::string> png_bytes(const Drawing& drawing, const PictureOptions& options) {
  const auto image = draw(drawing, options);
  if (!image) return tl::unexpected(image.error());
  const auto bytes = charts::encode_png(*image);
  if (!bytes) return tl::unexpected(bytes.error());
  return std::string(bytes->begin(), bytes->end());
}

std::string pdf_bytes(const Drawing& drawing, const PictureOptions& options) {
  const Bounds2 box = shown_box(drawing, options);
  const Vector2 size = box.sizes() * kPointsPerMetre;
  charts::Canvas canvas = charts::Canvas::of_pdf(size.x(), size.y());
  paint_page(canvas, drawing, options, page_from_box(box, kPointsPerMetre), kPaperTolerance);
  return canvas.pdf();
}

base::Result<std::string> picture_bytes(const Drawing& drawing, const PictureOptions& options,
                                        const std::filesystem::path& path) {
  const std::string ending = io::ending_of(path).type;
  if (ending == ".png") return png_bytes(drawing, options);
  if (ending == ".pdf") return pdf_bytes(drawing, options);
  if (ending == ".svg") return drawing::svg_text(drawing, drawing::SvgLines::Outlines);
  return base::fail(fmt::format("{}: a picture of a drawing ends in .png, .pdf or .svg", path.string()));
}

}  // namespace

void paint(charts::Canvas& canvas, const Stroke& stroke, const Eigen::Affine2d& page_from_paper,
           double tolerance) {
  std::vector<charts::CubicLoop> line;
  for (const drawing::OutlinePiece& piece : drawing::outline_of(stroke.curve, stroke.ends, tolerance))
    line.push_back(page_loop(piece.rim, page_from_paper));
  const bool grouped = stroke.fill && !line.empty() && stroke.opacity < 1.0;
  const double opacity = grouped ? 1.0 : stroke.opacity;
  if (grouped) canvas.begin_group(page_area(painted_box(stroke.curve), page_from_paper));
  if (stroke.fill) {
    const charts::CubicLoop within = page_loop(stroke.curve.segments, page_from_paper);
    canvas.fill_path({&within, 1}, chart_colour(*stroke.fill, opacity));
  }
  if (!line.empty()) canvas.fill_path(line, chart_colour(stroke.colour, opacity));
  if (grouped) canvas.end_group(stroke.opacity);
}

void paint(charts::Canvas& canvas, const Drawing& drawing, const Eigen::Affine2d& page_from_paper,
           double tolerance) {
  for (const Layer& layer : drawing.layers) {
    if (!layer.visible) continue;
    for (const StrokePointer& stroke : layer.strokes) paint(canvas, *stroke, page_from_paper, tolerance);
  }
}

base::Result<charts::Image> draw(const Drawing& drawing, const PictureOptions& options) {
  const Bounds2 box = shown_box(drawing, options);
  const auto scale = pixels_per_metre(box, options);
  if (!scale) return tl::unexpected(scale.error());
  const Vector2 size = box.sizes() * *scale;
  const auto pixels = [](double length) { return std::max(1, int(std::lround(length))); };
  charts::Canvas canvas = charts::Canvas::clear(pixels(size.x()), pixels(size.y()), 1.0);
  paint_page(canvas, drawing, options, page_from_box(box, *scale), kPixelTolerance / *scale);
  return canvas.snapshot();
}

base::Result<void> write_picture(const Drawing& drawing, const PictureOptions& options,
                                 const std::filesystem::path& path) {
  const auto bytes = picture_bytes(drawing, options, path);
  if (!bytes) return tl::unexpected(bytes.error());
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(*bytes);
  return file->finish();
}

}  // namespace icome::sketch
