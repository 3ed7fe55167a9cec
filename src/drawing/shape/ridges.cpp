#include "drawing/shape/ridges.h"

#include <fmt/format.h>

#include <cmath>

#include "drawing/outline/outline.h"
#include "drawing/shape/paper_grid.h"
#include "fonts/outline_union.h"

namespace icome::drawing {
namespace {

constexpr double kRingTolerance = 2e-5;  // m, by which the rims of ridges are off the true outline
constexpr double kFillShare = 0.3;       // of a line's height, that its fill has

template <typename Visit>
void for_each_seen(const Drawing& drawing, const Visit& visit) {
  for (const Layer& layer : drawing.layers) {
    if (!layer.visible) continue;
    for (const StrokePointer& stroke : layer.strokes) visit(stroke);
  }
}

Bounds2 box_of(const Stroke& stroke) {
  const Vector2 beside = Vector2::Constant(0.5 * stroke.curve.widest() + kRingTolerance);
  const Bounds2 line = stroke.curve.bounds();
  return {line.min() - beside, line.max() + beside};
}

base::Result<geometry::TriangleMesh> solid_of_rings(const fonts::Rings& rings, const PaperGrid& grid) {
  if (fonts::cross_often(rings, fonts::kMostCrossings))
    return base::fail(fmt::format("it crosses itself more than {} times", fonts::kMostCrossings));
  const std::vector<geometry::Outline> pieces = fonts::united(rings);
  if (pieces.empty()) return geometry::TriangleMesh{};
  auto mesh = geometry::solid_of_outlines(pieces, 1.0);
  if (mesh) grid.to_design(*mesh);
  return mesh;
}

base::Result<StrokeRidgePointer> ridge_of(const Stroke& stroke, const Vector2& paper) {
  const PaperGrid grid(paper, box_of(stroke));
  fonts::Rings rings;
  for (const OutlinePiece& piece : outline_of(stroke.curve, stroke.ends, kRingTolerance))
    rings.push_back(grid.line_along(piece.rim, true, kRingTolerance));
  auto line = solid_of_rings(rings, grid);
  auto fill = stroke.fill
                  ? solid_of_rings({grid.line_along(stroke.curve.segments, true, kRingTolerance)}, grid)
                  : geometry::TriangleMesh{};
  for (const auto* made : {&line, &fill})
    if (!*made) return base::fail(fmt::format("stroke {}: {}", stroke.id.value, made->error().message));
  return std::make_shared<const StrokeRidge>(StrokeRidge{std::move(*line), std::move(*fill)});
}

geometry::Outline in_design(geometry::Outline outline, const PaperGrid& grid) {
  for (Vector2& at : outline.rim) at = grid.to_design(at);
  for (std::vector<Vector2>& hole : outline.holes)
    for (Vector2& at : hole) at = grid.to_design(at);
  return outline;
}

}  // namespace

std::string complaint(const RidgeHeights& heights) {
  constexpr double kLeast = 0.00005, kMost = 0.1;  // m
  constexpr double kMostByWidth = 10.0;
  if (!(heights.height >= kLeast && heights.height <= kMost))
    return fmt::format("the height of a drawing's lines is from {} to {} m", kLeast, kMost);
  if (!(heights.height_by_width >= 0.0 && heights.height_by_width <= kMostByWidth))
    return fmt::format("the height of a drawing's lines by their width is from 0 to {}", kMostByWidth);
  return {};
}

base::Result<std::vector<Ridge>> ridges_of(const Drawing& drawing, const RidgeHeights& heights,
                                           StrokeRidges& known) {
  std::vector<Ridge> ridges;
  std::string error;
  double rise = 1.0;
  for_each_seen(drawing, [&](const StrokePointer& stroke) {
    if (!error.empty()) return;
    StrokeRidgePointer& areas = known[stroke];
    if (!areas) {
      auto made = ridge_of(*stroke, drawing.size);
      if (!made) {
        error = made.error().message;
        return;
      }
      areas = std::move(*made);
    }
    const double height = rise * (heights.height + heights.height_by_width * stroke->curve.widest());
    ridges.push_back({stroke, areas, height, kFillShare * height});
    rise += kRiseOfStroke;
  });
  if (!error.empty()) return base::fail(error);
  return ridges;
}

base::Result<std::vector<geometry::Outline>> enclosed_areas(const Drawing& drawing, double tolerance) {
  const PaperGrid grid(drawing.size, drawing.bounds());
  fonts::Rings rings;
  for_each_seen(drawing, [&](const StrokePointer& stroke) {
    if (stroke->curve.closed) rings.push_back(grid.line_along(stroke->curve.segments, true, tolerance));
  });
  if (fonts::cross_often(rings, fonts::kMostCrossings))
    return base::fail(fmt::format("its closed curves cross more than {} times", fonts::kMostCrossings));
  std::vector<geometry::Outline> areas;
  for (geometry::Outline& piece : fonts::united(rings)) areas.push_back(in_design(std::move(piece), grid));
  return areas;
}

std::vector<std::vector<Vector2>> open_lines(const Drawing& drawing, double tolerance) {
  const PaperGrid grid(drawing.size, drawing.bounds());
  std::vector<std::vector<Vector2>> lines;
  for_each_seen(drawing, [&](const StrokePointer& stroke) {
    if (stroke->curve.closed) return;
    std::vector<Vector2> line = grid.line_along(stroke->curve.segments, false, tolerance);
    for (Vector2& at : line) at = grid.to_design(at);
    lines.push_back(std::move(line));
  });
  return lines;
}

}  // namespace icome::drawing
