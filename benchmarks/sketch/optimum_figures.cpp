#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "dense_distance.h"
#include "sketch/fit/refit.h"
#include "sketch_figures.h"
#include "strong_fit.h"

namespace icome::benchmarks {
namespace {

constexpr double kBoundOfOptimum = 1e-4;  // m
constexpr int kFarther = 8;               // points beyond those that were reached, which are tried too
constexpr double kTangentReach = 2.0;     // of the bound, on either side
constexpr double kTurns[] = {0.0, 0.07, -0.07, 0.17, -0.17, 0.35, -0.35, 0.6, -0.6};  // rad from the tangent
constexpr double kSharp = 0.87;  // rad, as fit_stroke() takes it for a corner, over kSharpReach
constexpr double kSharpReach = 3.0;
constexpr std::size_t kNotYet = std::numeric_limits<std::size_t>::max();

/// The fewest cubics from the first point of a line to the last, each from point to point, by asking for all
/// pairs of points in order of the number of cubics to the first of them.
class Optimum {
 public:
  explicit Optimum(const std::vector<Vector2>& line)
      : line_(line), known_(line.size() * line.size(), Known::No), count_(line.size(), kNotYet) {}

  std::size_t breaking() {
    count_[0] = 0;
    for (std::size_t i = 0; i + 1 < line_.size(); ++i) reach_from(i);  // all ways to i come from before it
    return count_.back();
  }

  /// The fewest with one direction for both cubics of a joint, one of several there, between points where it
  /// may break. Zero: no such curve was found.
  std::size_t smooth(std::size_t first, std::size_t last);

  /// The greatest distance that the dense judge finds in a cubic that was taken.
  double worst() const { return worst_; }

  /// Is there a cubic between two points? Searched for once.
  bool fits(std::size_t from, std::size_t to) {
    if (known_[from * line_.size() + to] == Known::No) search(from, to, nullptr);
    return known_[from * line_.size() + to] == Known::Fits;
  }

 private:
  enum class Known : std::uint8_t { No, Fits, Fails };

  std::span<const Vector2> part(std::size_t from, std::size_t to) const {
    return {line_.data() + from, to - from + 1};
  }

  std::optional<CubicBezier> search(std::size_t from, std::size_t to, const CubicBezier* start) {
    auto cubic = StrongFit(part(from, to)).within({}, {}, start);
    if (cubic) {
      const std::vector<Vector2> points(line_.begin() + std::ptrdiff_t(from),
                                        line_.begin() + std::ptrdiff_t(to) + 1);
      const DenseDistance dense = dense_distance(points, {*cubic});
      worst_ = std::max(worst_, dense.greatest - dense.error);
    }
    known_[from * line_.size() + to] = cubic ? Known::Fits : Known::Fails;
    return cubic;
  }

  void reach_from(std::size_t i) {
    int failures = 0;
    std::optional<CubicBezier> last;
    double last_length = 0.0;
    double length = 0.0;
    for (std::size_t j = i + 1; j < line_.size() && failures < kFarther; ++j) {
      length += (line_[j] - line_[j - 1]).norm();
      if (count_[j] <= count_[i] + 1) continue;
      const auto longer = last ? std::optional(last->part(0.0, length / last_length)) : std::nullopt;
      const auto found = search(i, j, longer ? &*longer : nullptr);
      if (!found) {
        ++failures;
        continue;
      }
      count_[j] = count_[i] + 1;
      failures = 0;
      last = found;
      last_length = length;
    }
  }

  const std::vector<Vector2>& line_;
  double worst_ = 0.0;
  std::vector<Known> known_;
  std::vector<std::size_t> count_;
};

/// A point of the line and one of the directions there.
struct JointState {
  std::size_t point;
  std::size_t turn;
  auto operator<=>(const JointState&) const = default;
};

Vector2 place_along(const std::vector<Vector2>& line, std::size_t from, double reach, bool ahead) {
  std::size_t i = from;
  double left = reach;
  while (ahead ? i + 1 < line.size() : i > 0) {
    const std::size_t next = ahead ? i + 1 : i - 1;
    const double length = (line[next] - line[i]).norm();
    if (length >= left) return line[i] + left / length * (line[next] - line[i]);
    left -= length;
    i = next;
  }
  return line[i];
}

double turning_at(const std::vector<Vector2>& line, std::size_t i, double reach) {
  const Vector2 before = line[i] - place_along(line, i, reach, false);
  const Vector2 behind = place_along(line, i, reach, true) - line[i];
  return std::abs(std::atan2(before.x() * behind.y() - before.y() * behind.x(), before.dot(behind)));
}

/// Points where the curve may break, with the ends: the sharpest of neighbours.
std::vector<std::size_t> breaks_of(const std::vector<Vector2>& line) {
  std::vector<std::size_t> breaks = {0};
  double sharpest = 0.0;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const double turning = turning_at(line, i, kSharpReach);
    if (turning <= kSharp) {
      sharpest = 0.0;
    } else if (sharpest == 0.0) {
      breaks.push_back(i);
      sharpest = turning;
    } else if (turning > sharpest) {
      breaks.back() = i;
      sharpest = turning;
    }
  }
  breaks.push_back(line.size() - 1);
  return breaks;
}

std::size_t Optimum::smooth(std::size_t first, std::size_t last) {
  const auto direction = [&](const JointState& state) -> std::optional<Vector2> {
    if (state.point == first || state.point == last) return {};
    const Vector2 along = place_along(line_, state.point, kTangentReach, true) -
                          place_along(line_, state.point, kTangentReach, false);
    return Eigen::Rotation2Dd(kTurns[state.turn]) * along.stableNormalized();
  };
  const auto turns_at = [&](std::size_t point) {
    return point == last || point == first ? 1 : std::size(kTurns);
  };
  std::map<JointState, std::size_t> seen = {{{first, 0}, 0}};
  std::vector<JointState> front = {{first, 0}};
  for (std::size_t count = 1; !front.empty(); ++count) {
    std::vector<JointState> next;
    for (const JointState& from : front) {
      int failures = 0;
      for (std::size_t j = from.point + 1; j <= last && failures < kFarther; ++j) {
        // Where no cubic fits that may break, none does that may not.
        if (!fits(from.point, j)) {
          ++failures;
          continue;
        }
        for (std::size_t turn = 0; turn < turns_at(j); ++turn) {
          const JointState to = {j, turn};
          if (seen.contains(to)) continue;
          StrongFit fit(part(from.point, j));
          if (!fit.within(direction(from), direction(to), nullptr)) continue;
          if (j == last) return count;
          seen[to] = count;
          next.push_back(to);
        }
      }
    }
    front = std::move(next);
  }
  return 0;
}

std::size_t smooth_with_breaks(Optimum& optimum, const std::vector<Vector2>& line) {
  const std::vector<std::size_t> breaks = breaks_of(line);
  std::size_t sum = 0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const std::size_t count = optimum.smooth(breaks[i], breaks[i + 1]);
    if (count == 0) return 0;
    sum += count;
  }
  return sum;
}

/// The program's own cubics that may break, along the whole stroke.
std::size_t own_breaking(const PenStroke& stroke) {
  const sketch::StrokePath path = sketch::path_of(stroke, kBoundOfOptimum, 0.0);
  return sketch::fewest_breaking_cubics(path, 0, path.points.size() - 1, 1.0).size();
}

struct Counts {
  std::size_t strokes = 0;
  std::size_t ours = 0;
  std::size_t own_breaking = 0;
  std::size_t breaking = 0;
  double worst = 0.0;  // of the bound, in a cubic of the optimum
  std::size_t smooth_strokes = 0;
  std::size_t smooth = 0;
  std::size_t ours_beside_smooth = 0;
  std::size_t breaking_beside_smooth = 0;
};

void count(const BenchStroke& named, bool also_smooth, const SketchExtent& extent, Counts& counts) {
  const std::vector<Vector2> line = line_of(named.stroke, kBoundOfOptimum);
  const std::size_t ours = fit_within(named.stroke, kBoundOfOptimum).curve.segments.size();
  Optimum optimum(line);
  const std::size_t breaking = optimum.breaking();
  ++counts.strokes;
  counts.ours += ours;
  counts.own_breaking += own_breaking(named.stroke);
  counts.breaking += breaking;
  counts.worst = std::max(counts.worst, optimum.worst());
  if (!also_smooth || line.size() > extent.most_points) return;
  const std::size_t smooth = smooth_with_breaks(optimum, line);
  if (smooth == 0) return;
  ++counts.smooth_strokes;
  counts.smooth += smooth;
  counts.ours_beside_smooth += ours;
  counts.breaking_beside_smooth += breaking;
}

SketchRow optimum_row(const std::string& figure, std::size_t ours, std::size_t optimum, bool is_aim) {
  const double ratio = double(ours) / double(optimum);
  return {.figure = figure,
          .unit = "count",
          .ours = fmt::format("{}", ours),
          .other = fmt::format("{}", optimum),
          .ratio = fmt::format("{:.3f}", ratio),
          .to_reach = is_aim ? reached_of(ratio, 1.05) : ""};
}

void add_rows(SketchSection& section, const std::string& name, const Counts& counts, bool is_all) {
  const std::string which = fmt::format("{} ({})", name, counts.strokes);
  section.rows.push_back(optimum_row(which + ": may break", counts.ours, counts.breaking, false));
  section.rows.push_back(
      optimum_row("  our first stage, may break", counts.own_breaking, counts.breaking, false));
  if (counts.smooth_strokes == 0) return;
  section.rows.push_back(optimum_row(fmt::format("  {} of them: smooth", counts.smooth_strokes),
                                     counts.ours_beside_smooth, counts.smooth, is_all));
  section.rows.push_back(optimum_row("  the same: smooth, beside may break (both DP)", counts.smooth,
                                     counts.breaking_beside_smooth, false));
}

void add_to(Counts& all, const Counts& one) {
  all.strokes += one.strokes;
  all.ours += one.ours;
  all.own_breaking += one.own_breaking;
  all.breaking += one.breaking;
  all.worst = std::max(all.worst, one.worst);
  all.smooth_strokes += one.smooth_strokes;
  all.smooth += one.smooth;
  all.ours_beside_smooth += one.ours_beside_smooth;
  all.breaking_beside_smooth += one.breaking_beside_smooth;
}

}  // namespace

SketchSection optimum_figures(const std::vector<BenchStroke>& strokes, const SketchExtent& extent) {
  std::map<std::string, Counts> by_file;
  for (std::size_t i = 0; i < strokes.size(); ++i)
    count(strokes[i], i % extent.smooth_every == 0, extent, by_file[strokes[i].file]);
  SketchSection section{"segments beside the optimum of dynamic programming, 0.1 mm", {}, {}};
  Counts all;
  for (const auto& [file, counts] : by_file) {
    add_rows(section, file, counts, false);
    add_to(all, counts);
  }
  add_rows(section, "all strokes", all, true);
  section.notes.push_back(fmt::format(
      "The dense judge finds a cubic of the optimum certainly {:.4f} of the bound away at most.", all.worst));
  section.notes.push_back(
      "The optimum: all pairs of samples, each pair with a cubic from sample to sample, found by "
      "reparametrised "
      "least squares\nfrom four starts in up to 60 rounds. \"May break\": joints have no common direction, "
      "as "
      "ours have. \"Smooth\": nine\ndirections at each sample, breaks at turns of 50 degrees; our joints "
      "need "
      "not lie on samples, so it can have more.");
  return section;
}

}  // namespace icome::benchmarks
