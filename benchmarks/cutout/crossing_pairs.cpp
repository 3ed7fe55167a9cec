#include "crossing_pairs.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "cutout/drawn_table.h"
#include "cutout/tracker/tracker.h"

namespace icome::benchmarks {
namespace {

using base::Vector2;

constexpr int kFramesOfACrossing = 50;
constexpr double kFrameTime = 1.0 / 30;  // s
constexpr double kCrossingDegree = std::numbers::pi / 180;

/// Two triangles on their ways, in an own frame.
struct CrossingPair {
  cutout::KnownTriangles known;
  Vector2 starts[2], ways[2];  // mm, mm/s
  double angles[2], spins[2];  // rad, rad/s

  cutout::TrianglePose at(std::size_t i, double time) const {
    return {starts[i] + time * ways[i], std::remainder(angles[i] + time * spins[i], 2 * std::numbers::pi)};
  }
};

CrossingPair random_pair(base::Random& random, const cutout::TableView& view) {
  CrossingPair pair;
  const double base_angle = random.uniform(38, 56) * kCrossingDegree, height = random.uniform(42, 56);
  pair.known.triangles = {{"one", base_angle, height, ""},
                          {"other", base_angle + kCrossingDegree, height + 1, ""}};
  const Vector2 middle(view.table_width() / 2, view.table_height() / 2);
  const double whole = kFramesOfACrossing * kFrameTime;
  const double heading = random.uniform(-0.25, 0.25);
  for (std::size_t i = 0; i < 2; ++i) {
    const double sense = i == 0 ? 1 : -1, turn = heading + random.uniform(-0.15, 0.15);
    const Vector2 along(sense * std::cos(turn), std::sin(turn));
    const Vector2 beside(0, random.uniform(-15, 15));
    pair.starts[i] = middle + beside - random.uniform(75, 90) * along;
    pair.ways[i] = random.uniform(150, 175) / whole * along;
    pair.angles[i] = random.uniform(-3, 3);
    pair.spins[i] = random.uniform(-1, 1);
  }
  return pair;
}

}  // namespace

CrossingFigures follow_crossing_pairs(std::size_t frames, std::uint64_t seed) {
  const cutout::TableView view = cutout::TableView::whole_frame(320, 180, 320, 180);
  CrossingFigures figures;
  std::size_t wanted = 0, found = 0;
  base::Random random(76 + seed);
  while (figures.frames < frames) {
    const CrossingPair pair = random_pair(random, view);
    const auto tracker = cutout::make_pose_tracker(pair.known, view);
    for (int number = 0; number < kFramesOfACrossing; ++number, ++figures.frames) {
      const double time = number * kFrameTime;
      cutout::DrawnTable table(view);
      for (std::size_t i = 0; i < 2; ++i) table.triangle(pair.known.triangles[i], pair.at(i, time));
      const cutout::Frame frame = table.frame(3, figures.frames);
      const auto seen = tracker->see(frame.view(), time);
      wanted += 2;
      if (!seen) continue;
      for (const cutout::Sighting& sighting : *seen) {
        const auto off = [&](std::size_t i) {
          const cutout::TrianglePose truth = pair.at(i, time);
          const double turn =
              std::abs(std::remainder(sighting.pose.angle - truth.angle, 2 * std::numbers::pi));
          return std::pair((sighting.pose.centroid - truth.centroid).norm(), turn);
        };
        const auto [own, own_turn] = off(sighting.triangle);
        const auto [other, other_turn] = off(1 - sighting.triangle);
        const bool good = own <= 4 && own_turn <= 0.1;
        found += good;
        figures.ghosts += !good;
        figures.swaps += !good && other <= 4 && other_turn <= 0.1;
      }
    }
  }
  figures.found_percent = 100.0 * double(found) / double(wanted);
  return figures;
}

}  // namespace icome::benchmarks
