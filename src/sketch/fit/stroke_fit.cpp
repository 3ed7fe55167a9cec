#include "sketch/fit/stroke_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/curve/nearest_on_curve.h"
#include "sketch/fit/fit_error.h"
#include "sketch/fit/refit.h"
#include "sketch/fit/running_fit.h"
#include "sketch/fit/thesis_fit.h"
#include "sketch/fit/width_fit.h"

namespace icome::sketch {
namespace {

constexpr double kPathTolerance = 0.03;  // of the error: what leaving samples out may cost
constexpr double kCornerTurn = 0.87;     // rad
constexpr double kCornerWithin = 3.0;    // of the error, on either side
constexpr double kFirstAim = 0.96;       // of the error, for the path without those samples
constexpr double kNextAim = 0.85;        // of the last aim, where the whole was not near enough
constexpr int kMostAims = 5;
constexpr double kErrorResolution = 0.01;  // of the error, by which what is stated may be too much
constexpr double kBreaks = 1e-6;           // rad: directions that differ by more break

/// The curve in the units of its path, and what it costs.
struct FittedLine {
  std::vector<CubicBezier> curve;
  double error = std::numeric_limits<double>::infinity();
};

/// The samples as a line from the first one, in units of the error; a pen that stays is one point.
std::vector<Vector2> line_of(const PenStroke& stroke, double error) {
  std::vector<Vector2> line;
  for (const PenSample& sample : stroke) {
    const Vector2 point = (sample.place - stroke.front().place) / error;
    if (line.empty() || point != line.back()) line.push_back(point);
  }
  return line;
}

void measure(FittedLine& fitted, const std::vector<Vector2>& line) {
  fitted.error = greatest_distance(line, fitted.curve, kErrorResolution);
}

FittedLine refitted(const PenStroke& stroke, const std::vector<Vector2>& line, double error) {
  const StrokePath path = path_of(stroke, error, kPathTolerance);
  std::vector<std::size_t> ends = corners_of(path, kCornerTurn, kCornerWithin);
  ends.insert(ends.begin(), 0);
  ends.push_back(path.points.size() - 1);
  FittedLine fitted;
  double aim = kFirstAim;
  for (int attempt = 0; attempt < kMostAims && fitted.error > 1.0; ++attempt, aim *= kNextAim) {
    fitted.curve.clear();
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const std::vector<CubicBezier> run = few_cubics(path, ends[i], ends[i + 1], aim);
      fitted.curve.insert(fitted.curve.end(), run.begin(), run.end());
    }
    measure(fitted, line);
  }
  return fitted;
}

/// The segments as the pen makes them while it moves, not measured yet.
std::vector<CubicBezier> drawn_segments(const std::vector<Vector2>& line, double aim) {
  RunningFit running(line.front() / aim);
  for (const Vector2& point : line) running.add(point / aim);
  std::vector<CubicBezier> curve;
  for (const RunningFit::Finished& segment : running.finished()) curve.push_back(segment.curve);
  curve.push_back(running.current().curve);
  for (CubicBezier& segment : curve)
    for (Vector2& point : segment.points) point *= aim;
  return curve;
}

/// As it was drawn; what the bound allows is lessened where the whole is not near enough. Without a result
/// where that leads to `most` segments or more.
FittedLine as_drawn(const std::vector<Vector2>& line, std::size_t most) {
  FittedLine fitted;
  double aim = 1.0;
  for (int attempt = 0; attempt < kMostAims && fitted.error > 1.0; ++attempt, aim *= kNextAim) {
    fitted.curve = drawn_segments(line, aim);
    if (fitted.curve.size() >= most) return {};
    measure(fitted, line);
  }
  return fitted;
}

FittedLine by_thesis(const std::vector<Vector2>& line, unsigned shared) {
  ThesisFit running(1.0, shared);
  for (const Vector2& point : line) running.add(point);
  FittedLine fitted;
  for (const ThesisFit::Finished& segment : running.finished()) fitted.curve.push_back(segment.curve);
  fitted.curve.push_back(running.current().curve);
  measure(fitted, line);
  return fitted;
}

/// Straight from sample to sample: what is left where nothing else comes near enough.
FittedLine straight(const std::vector<Vector2>& line) {
  FittedLine fitted;
  for (std::size_t i = 1; i < line.size(); ++i)
    fitted.curve.push_back(CubicBezier::line(line[i - 1], line[i]));
  fitted.error = 0.0;
  return fitted;
}

FittedLine fit_line(const PenStroke& stroke, const std::vector<Vector2>& line, const FitSettings& settings) {
  if (line.size() == 1) return {{CubicBezier::line(line[0], line[0])}, 0.0};
  if (settings.method == FitMethod::Thesis) return by_thesis(line, settings.shared);
  FittedLine fitted = settings.refit ? refitted(stroke, line, settings.error) : FittedLine();
  // Of a way that is all noise the pen's own segments may be fewer, and a pen that is lifted must not get
  // more.
  const std::size_t most =
      fitted.error <= 1.0 ? fitted.curve.size() : std::numeric_limits<std::size_t>::max();
  if (FittedLine drawn = as_drawn(line, most); drawn.error <= 1.0) fitted = std::move(drawn);
  return fitted.error <= 1.0 ? fitted : straight(line);
}

std::size_t count_breaks(const std::vector<CubicBezier>& curve) {
  std::size_t breaks = 0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const Vector2 arrives = curve[i - 1].end_direction();
    const Vector2 leaves = curve[i].start_direction();
    const double turn = std::atan2(arrives.x() * leaves.y() - arrives.y() * leaves.x(), arrives.dot(leaves));
    breaks += std::abs(turn) > kBreaks ? 1 : 0;
  }
  return breaks;
}

/// The place of the curve, not before `after`, that a sample belongs to: the nearest of this segment and the
/// next two.
double place_on_curve(const std::vector<CubicBezier>& curve, const Vector2& point, double after) {
  const auto first = std::min(std::size_t(after), curve.size() - 1);
  double place = after;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = first; i < std::min(first + 3, curve.size()); ++i) {
    const double from = i == first ? after - double(first) : 0.0;
    const auto near = geometry::nearest_on_curve(curve[i], point, from, 1.0);
    if (near.distance_squared < least) {
      least = near.distance_squared;
      place = double(i) + near.t;
    }
  }
  return place;
}

std::vector<WidthSegment> widths_along(const PenStroke& stroke, const std::vector<CubicBezier>& curve,
                                       const FitSettings& settings) {
  WidthFit widths(settings.width_error);
  double place = 0.0;
  for (const PenSample& sample : stroke) {
    place = place_on_curve(curve, (sample.place - stroke.front().place) / settings.error, place);
    widths.add(place, settings.tip.width(sample.pressure));
  }
  return widths.widths(double(curve.size()));
}

}  // namespace

FittedStroke fit_stroke(const PenStroke& stroke, const FitSettings& settings) {
  const std::vector<Vector2> line = line_of(stroke, settings.error);
  const FittedLine fitted = fit_line(stroke, line, settings);
  FittedStroke result;
  result.curve.segments = fitted.curve;
  result.curve.widths = widths_along(stroke, fitted.curve, settings);
  result.error = fitted.error * settings.error;
  result.samples = stroke.size();
  result.corners = count_breaks(fitted.curve);
  for (CubicBezier& segment : result.curve.segments)
    for (Vector2& point : segment.points) point = stroke.front().place + settings.error * point;
  return result;
}

}  // namespace icome::sketch
