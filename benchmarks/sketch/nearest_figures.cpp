#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/random.h"
#include "drawn_sheet.h"
#include "geometry/curve/curve_index.h"
#include "sketch_figures.h"

namespace icome::benchmarks {
namespace {

constexpr Quantiles kAimOfNearest = {2.0, 10.0};
constexpr double kBesideCurve = 0.002;  // m
constexpr double kEverywhere = std::numeric_limits<double>::infinity();

std::vector<Vector2> points_near(const std::vector<CubicBezier>& curves, std::size_t count) {
  base::Random random(24);
  std::vector<Vector2> points;
  for (std::size_t i = 0; i < count; ++i) {
    const CubicBezier& curve = curves[random.index(curves.size())];
    const Vector2 away(random.uniform(-kBesideCurve, kBesideCurve),
                       random.uniform(-kBesideCurve, kBesideCurve));
    points.push_back(curve.at(random.uniform()) + away);
  }
  return points;
}

std::vector<Vector2> points_anywhere(std::size_t count) {
  base::Random random(25);
  std::vector<Vector2> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back({random.uniform(-0.5, 1.5) * kSheetWidth, random.uniform(-0.5, 1.5) * kSheetHeight});
  }
  return points;
}

double nearest_in_turn(const std::vector<CubicBezier>& curves, const Vector2& point) {
  double least = kEverywhere;
  for (const CubicBezier& curve : curves)
    least = std::min(least, geometry::nearest_on_curve(curve, point).distance_squared);
  return std::sqrt(least);
}

double nearest_by(const geometry::CurveIndex& index, const Vector2& point) {
  geometry::CurveIndex::Nearest found;
  index.nearest(point, kEverywhere, found);
  return std::sqrt(found.on_curve.distance_squared);
}

void add_points(SketchSection& section, const std::string& figure, const std::vector<CubicBezier>& curves,
                const std::vector<Vector2>& points, const SketchExtent& extent) {
  const geometry::CurveIndex index(curves);
  std::vector<double> by_index(points.size());
  const BestRun ours = time_queries(extent.repeats, points.size(),
                                    [&](std::size_t i) { by_index[i] = nearest_by(index, points[i]); });
  double differs = 0.0;
  const std::size_t naive_points = std::min(points.size(), extent.naive_points);
  const BestRun naive = time_queries(1, naive_points, [&](std::size_t i) {
    differs = std::max(differs, std::abs(nearest_in_turn(curves, points[i]) - by_index[i]));
  });
  section.rows.push_back({.figure = figure,
                          .unit = "us",
                          .ours = median_and_p999(ours.us),
                          .other = median_and_p999(naive.us),
                          .ratio = fmt::format("{:.1e}", ours.us.median / naive.us.median),
                          .to_reach = reached_of(ours.us, kAimOfNearest)});
  section.notes.push_back(
      fmt::format("{}: distances of {} points differ by {:.1e} m at most; worst of {} "
                  "runs {:.2f} of the best's p99.9",
                  figure, naive_points, differs, extent.repeats, ours.noise));
}

}  // namespace

SketchSection nearest_figures(const std::vector<BenchStroke>& strokes, const SketchExtent& extent) {
  std::vector<CubicBezier> curves;
  for (const drawing::Curve& curve : drawn_sheet(strokes, extent.curves))
    for (const CubicBezier& segment : curve.segments)
      if (curves.size() < extent.curves) curves.push_back(segment);
  SketchSection section{
      fmt::format("nearest of {} segments; other: each segment in turn", curves.size()), {}, {}};
  add_points(section, "points within 2 mm of a curve", curves, points_near(curves, extent.points), extent);
  add_points(section, "points anywhere, 3 of 4 off the paper", curves, points_anywhere(extent.points),
             extent);
  return section;
}

}  // namespace icome::benchmarks
