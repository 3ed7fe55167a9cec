#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "sketch_figures.h"

namespace icome::benchmarks {
namespace {

constexpr double kThousand = 1000.0;
constexpr double kBoundOfScale = 1e-4;  // m
constexpr double kRounding = 1e-9;      // of the extent

/// The difference between curves of the same strokes in two sizes.
struct ScaleDifference {
  std::size_t strokes = 0;
  std::size_t other_counts = 0;
  std::size_t segments = 0;
  std::size_t large_segments = 0;
  std::size_t moved = 0;  // strokes with the same count whose points differ by more than rounding
  double points = 0.0;    // of the stroke's extent, where the counts agree

  void add(const PenStroke& stroke, const std::vector<CubicBezier>& small,
           const std::vector<CubicBezier>& large) {
    ++strokes;
    segments += small.size();
    large_segments += large.size();
    if (small.size() != large.size()) {
      ++other_counts;
      return;
    }
    double farthest = 0.0;
    for (std::size_t i = 0; i < small.size(); ++i)
      for (std::size_t k = 0; k < small[i].points.size(); ++k) {
        const Vector2 away = large[i].points[k] / kThousand - small[i].points[k];
        farthest = std::max(farthest, away.norm() / extent_of(stroke));
      }
    moved += farthest > kRounding ? 1 : 0;
    points = std::max(points, farthest);
  }
};

PenStroke times(const PenStroke& stroke, double factor) {
  PenStroke larger = stroke;
  for (sketch::PenSample& sample : larger) sample.place *= factor;
  return larger;
}

ScaleDifference our_difference(const std::vector<BenchStroke>& strokes, bool refit) {
  ScaleDifference difference;
  for (const BenchStroke& named : strokes) {
    const auto small = fit_within(named.stroke, kBoundOfScale, refit);
    const auto large = fit_within(times(named.stroke, kThousand), kThousand * kBoundOfScale, refit);
    difference.add(named.stroke, small.curve.segments, large.curve.segments);
  }
  return difference;
}

/// With a tolerance that grows with some power of the size.
std::optional<ScaleDifference> peer_difference(const std::vector<BenchStroke>& strokes, const PeerRun& peers,
                                               double tolerance_times) {
  std::vector<PeerRun::Request> requests;
  const double bound = 1000.0 * kBoundOfScale;  // mm
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    requests.push_back({i, 1.0, bound * bound});
    requests.push_back({i, kThousand, tolerance_times * bound * bound});
  }
  const auto answers = peers.curves(requests);
  if (!answers) return {};
  ScaleDifference difference;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    std::vector<CubicBezier> large = (*answers)[2 * i + 1];  // it comes back in mm
    for (CubicBezier& segment : large)
      for (Vector2& point : segment.points) point *= kThousand;
    difference.add(strokes[i].stroke, (*answers)[2 * i], large);
  }
  return difference;
}

SketchRow difference_row(const std::string& figure, const ScaleDifference& difference, bool is_ours) {
  const std::string counts = fmt::format("{} -> {}", difference.segments, difference.large_segments);
  return {.figure = figure,
          .unit = "count",
          .ours = is_ours ? counts : "",
          .other = is_ours ? "" : counts,
          .to_reach =
              fmt::format("{} of {} strokes have another count, {} other points; these differ by {:.1e}",
                          difference.other_counts, difference.strokes, difference.moved, difference.points)};
}

}  // namespace

SketchSection scale_figures(const std::vector<BenchStroke>& strokes, const PeerRun* peers) {
  SketchSection section{"the same drawing a thousand times as large; to reach: the same to rounding", {}, {}};
  section.rows.push_back(difference_row("as drawn", our_difference(strokes, false), true));
  section.rows.push_back(difference_row("refitted", our_difference(strokes, true), true));
  if (peers) {
    if (const auto squares = peer_difference(strokes, *peers, kThousand * kThousand))
      section.rows.push_back(difference_row("Paper.js, tolerance x1000000", *squares, false));
    if (const auto lengths = peer_difference(strokes, *peers, kThousand))
      section.rows.push_back(difference_row("Paper.js, tolerance x1000", *lengths, false));
  }
  section.notes.push_back("Differences of control points are parts of the stroke's longer side.");
  return section;
}

}  // namespace icome::benchmarks
