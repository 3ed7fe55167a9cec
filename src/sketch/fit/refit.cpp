#include "sketch/fit/refit.h"

#include <algorithm>
#include <cmath>

#include "sketch/fit/fit_error.h"
#include "sketch/fit/running_fit.h"

namespace icome::sketch {
namespace {

constexpr double kTooFew = 6.0;  // the first splitting is for so many times the distance
constexpr double kAimOfFit = 0.95;
constexpr double kResolutionOfFit = 0.02;  // of the distance allowed
constexpr int kRoundsForAll = 30;          // of bringing near
constexpr int kRoundsForFew = 25;
constexpr std::size_t kBeside = 8;  // segments on either side that move when a joint is taken out
constexpr int kMostCuttings = 40;
constexpr double kPointsOfASegment = 24.0;  // that a segment of the fewest is held against

/// The certified distance between a cubic and the part of the path that it stands for.
double error_of(const StrokePath& path, std::size_t first, std::size_t last, const CubicBezier& curve,
                double within) {
  const std::span<const Vector2> line(path.points.data() + first, last - first + 1);
  return certified_distance(line, curve, kResolutionOfFit * within);
}

/// The reach of a cubic from `first`: the last point of the path up to which it comes within the distance.
std::size_t farthest_reach(const StrokePath& path, std::size_t first, std::size_t last, double within,
                           std::size_t guess, CubicFit& fit) {
  const auto fits = [&](std::size_t to) {
    CubicFit tried = fit_cubic(path, path.along[first], path.along[to], kAimOfFit * within);
    const bool good = tried.error <= within && error_of(path, first, to, tried.curve, within) <= within;
    if (good) fit = tried;
    return good;
  };
  std::size_t good = first + 1;
  fit = {CubicBezier::line(path.points[first], path.points[good]), 0.0};
  std::size_t step = std::max<std::size_t>(1, guess);
  std::size_t bad = last + 1;
  while (bad > good + 1) {
    const std::size_t to = bad == last + 1 ? std::min(last, good + step) : good + (bad - good) / 2;
    if (fits(to)) {
      good = to;
      step *= 2;
      if (good == last) break;
    } else {
      bad = to;
    }
  }
  return good;
}

/// The points of the path from one to another, and points between those that lie far apart.
std::vector<Vector2> close_points(const StrokePath& path, std::size_t first, std::size_t last, double apart) {
  std::vector<Vector2> points;
  for (std::size_t i = first; i < last; ++i) {
    const double length = path.along[i + 1] - path.along[i];
    const auto pieces = std::size_t(std::ceil(length / apart));
    for (std::size_t k = 0; k < std::max<std::size_t>(1, pieces); ++k) {
      points.push_back(path.points[i] + double(k) / double(std::max<std::size_t>(1, pieces)) *
                                            (path.points[i + 1] - path.points[i]));
    }
  }
  points.push_back(path.points[last]);
  return points;
}

/// A run of the path between corners while its spline is being improved.
class Refit {
 public:
  Refit(std::vector<Vector2> points, SmoothSpline spline, double within)
      : points_(std::move(points)), spline_(std::move(spline)), within_(within) {}

  /// Cuts segments until all points are near enough. False if that does not come to an end.
  bool cut_until_near() {
    for (int cutting = 0; cutting < kMostCuttings; ++cutting) {
      if (spline_.bring_near(points_, {}, within_, kRoundsForAll) <= within_) return true;
      if (4 * spline_.segments() > 4 * points_.size()) return false;
      cut_worst();
    }
    return false;
  }

  /// Takes out joints as long as one can be spared.
  void join_where_possible() {
    bool joined = true;
    while (joined) {
      joined = false;
      for (std::size_t j = 1; j < spline_.segments(); ++j) {
        if (!join_at(j)) continue;
        joined = true;
        --j;
      }
    }
  }

  const SmoothSpline& spline() const { return spline_; }

 private:
  /// Cuts each segment that is too far away in two, but only the worse of two neighbours.
  void cut_worst() {
    const std::vector<double>& errors = spline_.errors();
    std::vector<CubicBezier> pieces;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const CubicBezier segment = spline_.segment(i);
      const bool worst = errors[i] > within_ && (i == 0 || errors[i] >= errors[i - 1]) &&
                         (i + 1 == errors.size() || errors[i] > errors[i + 1]);
      if (!worst) {
        pieces.push_back(segment);
        continue;
      }
      const auto [left, right] = segment.split(0.5);
      pieces.push_back(left);
      pieces.push_back(right);
    }
    spline_ = SmoothSpline::through(pieces);
  }

  bool join_at(std::size_t joint) {
    const std::size_t first = joint > kBeside + 1 ? joint - kBeside - 1 : 0;
    const std::size_t last = std::min(spline_.segments(), joint + kBeside + 1);
    std::vector<SmoothSpline::Joint> joints(spline_.joints().begin() + std::ptrdiff_t(first),
                                            spline_.joints().begin() + std::ptrdiff_t(last) + 1);
    const std::size_t out = joint - first;
    // The handles on both sides grow as the segment does.
    const double left = (joints[out].place - joints[out - 1].place).norm();
    const double right = (joints[out + 1].place - joints[out].place).norm();
    joints[out - 1].after *= (left + right) / left;
    joints[out + 1].before *= (left + right) / right;
    joints.erase(joints.begin() + std::ptrdiff_t(out));
    SmoothSpline window(std::move(joints));
    const auto& before = spline_.points_before();
    const std::span<const Vector2> points(points_.data() + before[first], before[last] - before[first]);
    if (points.size() < 2) return false;
    const SmoothSpline::Freedom freedom = {first == 0, last == spline_.segments()};
    if (window.bring_near(points, freedom, within_, kRoundsForFew) > within_) return false;
    spline_.replace(first, last, window);
    return true;
  }

  std::vector<Vector2> points_;
  SmoothSpline spline_;
  double within_;
};

std::vector<CubicBezier> curves_of(const std::vector<CubicFit>& fits) {
  std::vector<CubicBezier> curves;
  for (const CubicFit& fit : fits) curves.push_back(fit.curve);
  return curves;
}

/// The cubics without breaks, and as few as it takes; empty if that fails.
std::vector<CubicBezier> smooth_refit(const std::vector<Vector2>& points,
                                      const std::vector<CubicBezier>& start, double within) {
  Refit refit(points, SmoothSpline::through(start), within);
  if (!refit.cut_until_near()) return {};
  refit.join_where_possible();
  return refit.spline().curve();
}

/// The segments that the pen would have made between two points of the path.
std::vector<CubicBezier> segments_while_drawn(const StrokePath& path, std::size_t first, std::size_t last) {
  RunningFit running(path.points[first]);
  for (std::size_t i = first + 1; i <= last; ++i) running.add(path.points[i]);
  std::vector<CubicBezier> segments;
  for (const RunningFit::Finished& segment : running.finished()) segments.push_back(segment.curve);
  segments.push_back(running.current().curve);
  return segments;
}

}  // namespace

std::vector<CubicFit> fewest_breaking_cubics(const StrokePath& path, std::size_t first, std::size_t last,
                                             double within) {
  std::vector<CubicFit> fits;
  std::size_t guess = 8;
  while (first < last) {
    CubicFit fit;
    const std::size_t end = farthest_reach(path, first, last, within, guess, fit);
    fits.push_back(fit);
    guess = std::max<std::size_t>(1, (end - first) / 2);
    first = end;
  }
  return fits;
}

std::vector<CubicBezier> few_cubics(const StrokePath& path, std::size_t first, std::size_t last,
                                    double within) {
  const double length = path.along[last] - path.along[first];
  // A stroke that is much smaller than the distance has no length.
  if (!(length > 0.0)) return {CubicBezier::line(path.points[first], path.points[last])};
  const std::vector<CubicBezier> breaking = curves_of(fewest_breaking_cubics(path, first, last, within));
  const double apart = length / (kPointsOfASegment * double(breaking.size()));
  const std::vector<Vector2> points = close_points(path, first, last, apart);
  // Beginning with too few leaves the fewest, mostly; where it does not, beginning with enough may.
  std::vector<CubicBezier> best =
      smooth_refit(points, curves_of(fewest_breaking_cubics(path, first, last, kTooFew * within)), within);
  if (best.empty() || best.size() > breaking.size()) {
    const std::vector<CubicBezier> other = smooth_refit(points, breaking, within);
    if (best.empty() || (!other.empty() && other.size() < best.size())) best = other;
  }
  // Sharp turns that no corner was made for may need cubics that break, if the pen's own do not help.
  if (best.empty()) best = smooth_refit(points, segments_while_drawn(path, first, last), within);
  return best.empty() ? breaking : best;
}

}  // namespace icome::sketch
