#include "sketch/fit/stroke_fit.h"

#include <fmt/format.h>

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
constexpr double kMostAhead = 1.5;         // of the pen's way, on the curve
constexpr double kAheadAtRest = 0.5;       // of the error, further
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
    const Vector2 point = in_units_of(error, sample.place, stroke.front().place);
    if (line.empty() || point != line.back()) line.push_back(point);
  }
  return line;
}

void measure(FittedLine& fitted, const std::vector<Vector2>& line) {
  fitted.error = greatest_distance(line, fitted.curve, kErrorResolution) + kUnitRounding;
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
  fitted.error = kUnitRounding;
  return fitted;
}

FittedLine fit_line(const PenStroke& stroke, const std::vector<Vector2>& line, const FitSettings& settings) {
  if (line.size() == 1) return {{CubicBezier::line(line[0], line[0])}, kUnitRounding};
  if (settings.method == FitMethod::Thesis) return by_thesis(line, settings.shared);
  FittedLine fitted = settings.refit ? refitted(stroke, line, settings.error) : FittedLine();
  // If the way is all noise, the pen's own segments may be fewer, and a pen that is lifted must not get
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

/// Lengths along a curve, looked up between places that are close together.
class CurveLengths {
 public:
  explicit CurveLengths(const std::vector<CubicBezier>& curve) {
    for (const CubicBezier& segment : curve)
      for (int k = 0; k < kLookedUp; ++k)
        along_.push_back(along_.back() +
                         (segment.at((k + 1.0) / kLookedUp) - segment.at(k / double(kLookedUp))).norm());
  }

  /// The place that lies a length further along, or the end.
  double further(double place, double length) const {
    const auto before = std::min(std::size_t(place * kLookedUp), along_.size() - 2);
    const double part = place * kLookedUp - double(before);
    const double wanted = along_[before] + part * (along_[before + 1] - along_[before]) + length;
    const auto after = std::upper_bound(along_.begin(), along_.end(), wanted);
    return std::max(place, double(after - along_.begin()) / kLookedUp);
  }

 private:
  static constexpr int kLookedUp = 16;  // places of a segment

  std::vector<double> along_ = {0.0};
};

/// The place of the curve from `after` to `last` that is nearest to a sample.
double nearest_place(const std::vector<CubicBezier>& curve, const Vector2& point, double after, double last) {
  double place = after;
  double least = std::numeric_limits<double>::infinity();
  for (auto i = std::min(std::size_t(after), curve.size() - 1); i < curve.size() && double(i) <= last; ++i) {
    const double from = std::max(0.0, after - double(i));
    const auto near = geometry::nearest_on_curve(curve[i], point, from, std::min(1.0, last - double(i)));
    if (near.distance_squared < least) {
      least = near.distance_squared;
      place = double(i) + near.t;
    }
  }
  return place;
}

/// Each sample belongs to the nearest place that lies about as far along the curve as the pen has moved: what
/// it comes back to later may be nearer.
std::vector<WidthSegment> widths_along(const PenStroke& stroke, const std::vector<CubicBezier>& curve,
                                       const FitSettings& settings) {
  WidthFit widths(settings.width_error);
  const CurveLengths lengths(curve);
  double place = 0.0;
  Vector2 before = Vector2::Zero();
  for (const PenSample& sample : stroke) {
    const Vector2 point = in_units_of(settings.error, sample.place, stroke.front().place);
    const double last = lengths.further(place, kMostAhead * (point - before).norm() + kAheadAtRest);
    place = nearest_place(curve, point, place, std::min(last, double(curve.size())));
    widths.add(place, settings.tip.width(sample.pressure));
    before = point;
  }
  std::vector<WidthSegment> pieces = widths.widths(double(curve.size()));
  // A line of least squares may pass what a pen can draw.
  const auto [thin, wide] = std::minmax(settings.tip.thinnest, settings.tip.widest);
  for (WidthSegment& piece : pieces) {
    piece.from_width = std::clamp(piece.from_width, thin, wide);
    piece.to_width = std::clamp(piece.to_width, thin, wide);
  }
  return pieces;
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

base::Result<void> check_fit(const PenStroke& stroke, double error) {
  constexpr double kLongestStroke = 1e8;  // of the error
  constexpr double kMmOfMetre = 1e3;
  double length = 0.0;
  for (std::size_t i = 1; i < stroke.size(); ++i) length += (stroke[i].place - stroke[i - 1].place).norm();
  if (length <= kLongestStroke * error) return {};
  return base::fail(
      fmt::format("a stroke of {:.3g} m is too long for an error of {:g} mm: allow a larger one", length,
                  error * kMmOfMetre));
}

}  // namespace icome::sketch
