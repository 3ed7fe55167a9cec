#include "sketch/fit/refit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sketch/fit/fit_error.h"
#include "sketch/fit/running_fit.h"

namespace icome::sketch {
namespace {

constexpr double kTooFew = 6.0;  // one splitting to begin with is for so many times the distance
constexpr double kAimOfFit = 0.95;
constexpr double kHopeOfFit = 10.0;  // times the distance, from which more rounds may bring a cubic near
constexpr double kResolutionOfFit = 0.02;  // of the distance allowed
constexpr SmoothSpline::Effort kEffortForAll = {.most_rounds = 30, .rounds_of_hope = 30};
constexpr SmoothSpline::Effort kEffortForFew = {.most_rounds = 25, .rounds_of_hope = 4};
constexpr std::size_t kBeside = 2;  // segments on either side that move when there is to be one less
constexpr std::size_t kLongestRow = 6;
constexpr int kMostCuttings = 40;
constexpr double kTooMany = 1.2;  // of the cubics that may break: a beginning that needs more leads nowhere
constexpr std::size_t kPointsOfASegment = 24;  // at least, that it is held against
constexpr std::size_t kManySamples = 12;       // for one segment

/// The certified distance between a cubic and the part of the path that it stands for.
double error_of(const StrokePath& path, std::size_t first, std::size_t last, const CubicBezier& curve,
                double within) {
  const std::span<const Vector2> line(path.points.data() + first, last - first + 1);
  return certified_distance(line, curve, kResolutionOfFit * within);
}

/// The points of the path from one to another, and points between them, so that a segment has enough where
/// there will be so many.
std::vector<Vector2> close_points(const StrokePath& path, std::size_t first, std::size_t last,
                                  std::size_t segments) {
  const double apart = (path.along[last] - path.along[first]) / double(kPointsOfASegment * segments);
  // Few samples are uneven: where the pen was slow, as it turned, they must not be taken for enough.
  const std::size_t least = last - first < kManySamples * segments ? 3 : 1;
  std::vector<Vector2> points;
  for (std::size_t i = first; i < last; ++i) {
    const double length = path.along[i + 1] - path.along[i];
    const auto pieces = std::max(least, std::size_t(std::ceil(length / apart)));
    for (std::size_t k = 0; k < pieces; ++k)
      points.push_back(path.points[i] + double(k) / double(pieces) * (path.points[i + 1] - path.points[i]));
  }
  points.push_back(path.points[last]);
  return points;
}

/// A cubic within the distance of the path between two of its points.
std::optional<CubicBezier> cubic_within(const StrokePath& path, std::size_t first, std::size_t last,
                                        double within) {
  const CubicFit fit = fit_cubic(path, path.along[first], path.along[last], kAimOfFit * within);
  if (fit.error <= within && error_of(path, first, last, fit.curve, within) <= within) return fit.curve;
  if (fit.error > kHopeOfFit * within) return {};
  SmoothSpline one = SmoothSpline::through({&fit.curve, 1});
  const std::vector<Vector2> points = close_points(path, first, last, 1);
  if (one.bring_near(points, {}, within, kEffortForAll) > within) return {};
  return one.segment(0);
}

/// The reach of a cubic from `first`: the last point of the path up to which it comes within the distance.
std::size_t farthest_reach(const StrokePath& path, std::size_t first, std::size_t last, double within,
                           std::size_t guess, CubicBezier& curve) {
  std::size_t good = first + 1;
  curve = CubicBezier::line(path.points[first], path.points[good]);
  std::size_t step = std::max<std::size_t>(1, guess);
  std::size_t bad = last + 1;
  while (bad > good + 1) {
    const std::size_t to = bad == last + 1 ? std::min(last, good + step) : good + (bad - good) / 2;
    if (const auto longer = cubic_within(path, first, to, within)) {
      curve = *longer;
      good = to;
      step *= 2;
      if (good == last) break;
    } else {
      bad = to;
    }
  }
  return good;
}

/// A run of the path between corners while its spline is being improved.
class Refit {
 public:
  Refit(std::vector<Vector2> points, SmoothSpline spline, double within)
      : points_(std::move(points)), spline_(std::move(spline)), within_(within) {}

  /// Cuts segments until all points are near enough. False if that takes more than `most`.
  bool cut_until_near(std::size_t most) {
    for (int cutting = 0; cutting < kMostCuttings; ++cutting) {
      if (spline_.bring_near(points_, {}, within_, kEffortForAll) <= within_) return true;
      if (spline_.segments() > most) return false;
      cut_worst();
    }
    return false;
  }

  /// Takes out joints as long as one can be spared.
  void take_out_joints() {
    bool taken = true;
    while (taken) {
      taken = false;
      for (std::size_t joint = 1; joint < spline_.segments(); ++joint) {
        if (!take_out(joint)) continue;
        taken = true;
        --joint;
      }
    }
  }

  /// Lets rows of segments have one less, spread anew, where they can: what taking out joints does not find.
  void shorten_rows() {
    for (std::size_t row = 2; row <= kLongestRow; ++row)
      for (std::size_t first = 0; first + row <= spline_.segments();)
        if (!shorten(first, row)) ++first;
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

  bool take_out(std::size_t joint) {
    std::vector<SmoothSpline::Joint> ends = {spline_.joints()[joint - 1], spline_.joints()[joint + 1]};
    // The handles on both sides grow as the segment does.
    const double left = (spline_.joints()[joint].place - ends[0].place).norm();
    const double right = (ends[1].place - spline_.joints()[joint].place).norm();
    ends[0].after *= (left + right) / left;
    ends[1].before *= (left + right) / right;
    return put_instead(joint - 1, joint + 1, ends);
  }

  /// One segment less from joint `first` on, the others longer by the same part.
  bool shorten(std::size_t first, std::size_t row) {
    const double longer = double(row) / double(row - 1);
    std::vector<SmoothSpline::Joint> joints = {spline_.joints()[first]};
    joints.front().after *= longer;
    for (std::size_t i = 1; i + 1 < row; ++i) {
      const double along = double(i) * longer;
      const CubicBezier segment = spline_.segment(first + std::size_t(along));
      const double t = along - std::floor(along);
      const Vector2 speed = segment.derivative(t);
      const double handle = std::max(SmoothSpline::kShortestHandle, longer / 3.0 * speed.norm());
      joints.push_back({segment.at(t), std::atan2(speed.y(), speed.x()), handle, handle});
    }
    joints.push_back(spline_.joints()[first + row]);
    joints.back().before *= longer;
    return put_instead(first, first + row, joints);
  }

  /// Puts joints in the place of those from one to another, and brings them and a few segments beside them
  /// near. False, and nothing is changed, where they do not come near enough.
  bool put_instead(std::size_t from, std::size_t to, const std::vector<SmoothSpline::Joint>& joints) {
    const std::size_t first = from > kBeside ? from - kBeside : 0;
    const std::size_t last = std::min(spline_.segments(), to + kBeside);
    const auto old = spline_.joints().begin();
    std::vector<SmoothSpline::Joint> all(old + std::ptrdiff_t(first), old + std::ptrdiff_t(from));
    all.insert(all.end(), joints.begin(), joints.end());
    all.insert(all.end(), old + std::ptrdiff_t(to) + 1, old + std::ptrdiff_t(last) + 1);
    SmoothSpline window(std::move(all));
    const auto& before = spline_.points_before();
    const std::span<const Vector2> points(points_.data() + before[first], before[last] - before[first]);
    if (points.size() < 2) return false;
    SmoothSpline::Beyond beyond;
    if (first > 0) beyond.first = spline_.place_of_way(points_, first);
    if (last < spline_.segments()) beyond.last = spline_.place_of_way(points_, last);
    if (window.bring_near(points, beyond, within_, kEffortForFew) > within_) return false;
    spline_.replace(first, last, window);
    return true;
  }

  std::vector<Vector2> points_;
  SmoothSpline spline_;
  double within_;
};

/// The cubics without breaks, and as few as it takes; empty if more than `most` are needed at first.
std::vector<CubicBezier> smooth_refit(const std::vector<Vector2>& points,
                                      const std::vector<CubicBezier>& start, double within,
                                      std::size_t most) {
  Refit refit(points, SmoothSpline::through(start), within);
  if (!refit.cut_until_near(most)) return {};
  refit.take_out_joints();
  refit.shorten_rows();
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

std::vector<CubicBezier> fewest_breaking_cubics(const StrokePath& path, std::size_t first, std::size_t last,
                                                double within) {
  std::vector<CubicBezier> cubics;
  std::size_t guess = 8;
  while (first < last) {
    CubicBezier cubic;
    const std::size_t end = farthest_reach(path, first, last, within, guess, cubic);
    cubics.push_back(cubic);
    guess = std::max<std::size_t>(1, (end - first) / 2);
    first = end;
  }
  return cubics;
}

std::vector<CubicBezier> few_cubics(const StrokePath& path, std::size_t first, std::size_t last,
                                    double within) {
  const double length = path.along[last] - path.along[first];
  // A stroke that is much smaller than the distance has no length.
  if (!(length > 0.0)) return {CubicBezier::line(path.points[first], path.points[last])};
  const std::vector<CubicBezier> breaking = fewest_breaking_cubics(path, first, last, within);
  const std::vector<Vector2> points = close_points(path, first, last, breaking.size());
  // Beginning with too few leaves the fewest, mostly; where it does not, beginning with enough does.
  const auto most = std::size_t(kTooMany * double(breaking.size())) + 2;
  std::vector<CubicBezier> best;
  for (const std::vector<CubicBezier>& start :
       {fewest_breaking_cubics(path, first, last, kTooFew * within), breaking}) {
    const std::vector<CubicBezier> other = smooth_refit(points, start, within, most);
    if (best.empty() || (!other.empty() && other.size() < best.size())) best = other;
  }
  // Sharp turns that no corner was made for may need cubics that break, if the pen's own do not help.
  if (best.empty())
    best = smooth_refit(points, segments_while_drawn(path, first, last), within, points.size());
  return best.empty() ? breaking : best;
}

}  // namespace icome::sketch
