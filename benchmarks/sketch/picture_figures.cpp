#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "drawing/outline/outline.h"
#include "drawn_sheet.h"
#include "sketch/files/picture.h"
#include "sketch_figures.h"

namespace icome::benchmarks {
namespace {

constexpr int kPixels = 1280;                 // of the longer side; the sheet gives 800 for the other
constexpr double kOutlineTolerance = 2.5e-5;  // m
constexpr double kAimOfRedraw = 16.0;         // ms
// perfect-freehand's width at pressure p is size (1 - thinning) + 2 size thinning p: that of our PenTip, in
// mm.
constexpr double kSizeOfPeer = 0.6;
constexpr double kThinningOfPeer = 2.0 / 3.0;

drawing::Drawing drawing_of(std::vector<drawing::Curve> curves) {
  drawing::Drawing drawing;
  drawing.size = Vector2(kSheetWidth, kSheetHeight);
  drawing::Layer layer;
  layer.id = drawing.next_layer_id();
  for (drawing::Curve& curve : curves) {
    drawing::Stroke stroke;
    stroke.id = drawing.next_stroke_id();
    stroke.curve = std::move(curve);
    layer.strokes.push_back(std::make_shared<const drawing::Stroke>(std::move(stroke)));
  }
  drawing.layers.push_back(std::move(layer));
  return drawing;
}

template <typename Work>
double least_us(int repeats, const Work& work) {
  double least = 1e18;
  for (int i = 0; i < repeats; ++i) least = std::min(least, 1e6 * median_seconds(1, work));
  return least;
}

void add_redraw(SketchSection& section, const std::vector<BenchStroke>& strokes, const SketchExtent& extent) {
  const drawing::Drawing drawing = drawing_of(drawn_sheet(strokes, extent.curves));
  sketch::PictureOptions options;
  options.longer_side = kPixels;
  options.area = sketch::PictureArea::Paper;
  const double ms = 1e-3 * least_us(extent.repeats, [&] { static_cast<void>(draw(drawing, options)); });
  section.rows.push_back({.figure = fmt::format("{} strokes drawn anew by draw(), 1280x800", extent.curves),
                          .unit = "ms",
                          .ours = short_number(ms),
                          .to_reach = reached_of(ms, kAimOfRedraw)});
}

/// Outlines of all strokes: time and size.
struct OutlineCost {
  double fit_us = 0.0;
  double outline_us = 0.0;
  std::size_t cubics = 0;
};

OutlineCost our_outlines(const std::vector<BenchStroke>& strokes, int repeats) {
  OutlineCost cost;
  for (const BenchStroke& named : strokes) {
    sketch::FittedStroke fitted;
    cost.fit_us += least_us(repeats, [&] { fitted = sketch::fit_stroke(named.stroke, {}); });
    std::vector<drawing::OutlinePiece> pieces;
    cost.outline_us += least_us(repeats, [&] {
      pieces = drawing::outline_of(fitted.curve, drawing::CurveEnds::Round, kOutlineTolerance);
    });
    for (const drawing::OutlinePiece& piece : pieces) cost.cubics += piece.rim.size();
  }
  return cost;
}

SketchRow outline_row(const std::string& figure, const std::string& unit, double ours, double peer) {
  SketchRow row{.figure = figure, .unit = unit, .ours = short_number(ours)};
  if (peer > 0.0) {
    row.other = short_number(peer);
    row.ratio = short_number(ours / peer);
  }
  return row;
}

void add_outlines(SketchSection& section, const std::vector<BenchStroke>& strokes, const PeerRun* peers,
                  int repeats) {
  const OutlineCost ours = our_outlines(strokes, repeats);
  double points = 0.0;
  double us = 0.0;
  for (const PeerRun::Line& line :
       peers ? peers->outlines(kSizeOfPeer, kThinningOfPeer) : std::vector<PeerRun::Line>{}) {
    points += line.count;
    us += line.us;
  }
  const auto count = double(strokes.size());
  section.rows.push_back(
      outline_row("outline of a stroke, mean: from its curve", "us", ours.outline_us / count, us / count));
  section.rows.push_back(outline_row("  from its samples, with the fit", "us",
                                     (ours.fit_us + ours.outline_us) / count, us / count));
  section.rows.push_back(outline_row("  numbers to keep for all: 6 a cubic, 2 a point", "count",
                                     6.0 * double(ours.cubics), 2.0 * points));
  section.rows.push_back(outline_row("  cubics beside points", "count", double(ours.cubics), points));
}

}  // namespace

SketchSection picture_figures(const std::vector<BenchStroke>& strokes, const PeerRun* peers,
                              const SketchExtent& extent) {
  SketchSection section{"outlines and pictures; other: perfect-freehand's polygons", {}, {}};
  add_redraw(section, strokes, extent);
  add_outlines(section, strokes, peers, extent.repeats);
  section.notes.push_back(
      "perfect-freehand (size and thinning for the widths of our pen, streamline 0) makes no curve: its "
      "polygon "
      "follows an\naverage of samples and pressures with no bound, and leaves out points by a distance of "
      "its "
      "own. Ours is within 0.1 mm\nof the samples and 0.025 mm of the exact outline, which theirs has "
      "nothing "
      "to be held against.");
  return section;
}

}  // namespace icome::benchmarks
