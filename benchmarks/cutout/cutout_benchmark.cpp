// Measures trackers of triangles on computed frames with their truth: the thesis's pipeline, ours from
// nothing and ours following, and beside them packaged trackers of markers on frames of the same camera,
// where a marker of the same area lies in place of each triangle. One thread. The frames are no camera's.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "base/clock.h"
#include "crossing_pairs.h"
#include "cutout/synth/synthetic_table.h"
#include "marker_peers.h"
#include "marker_table.h"
#include "tracker_score.h"

namespace icome::benchmarks {
namespace {

struct CutoutExtent {
  int frames = 300;
  int hand_frames = 1000;
  int large_frames = 60;
  std::size_t crossing_frames = 10'000;
  std::uint64_t seed = 1;
};

void score_frame(cutout::Tracker& tracker, const cutout::Frame& frame, const cutout::FrameTruth& truth,
                 const cutout::TableView& view, TrackerScore& score) {
  const std::int64_t begin = base::steady_nanoseconds();
  const auto seen = tracker.see(frame.view(), truth.time);
  const double milliseconds = double(base::steady_nanoseconds() - begin) * 1e-6;
  if (!seen) std::abort();  // frames have the view's size
  score.add(*seen, truth.poses, view, milliseconds);
}

void print_figure(const std::string& title, const cutout::SyntheticOptions& options, bool with_markers) {
  const cutout::SyntheticTable table(options);
  const cutout::TableView view = table.view();
  const std::size_t count = options.known.triangles.size();
  const auto thesis = cutout::make_thesis_tracker(options.known, view);
  const auto cold = cutout::make_pose_tracker(options.known, view, false);
  const auto tracked = cutout::make_pose_tracker(options.known, view, true);
  const auto aruco = make_aruco(view, count), apriltag = make_apriltag(view, count);
  constexpr double kTurn = 2 * std::numbers::pi;
  TrackerScore thesis_score(kTurn), cold_score(kTurn), tracked_score(kTurn);
  TrackerScore aruco_score(kTurn / 4), apriltag_score(kTurn / 4);
  // One frame after the other, so that all of them are measured in the same minutes.
  for (int number = 0; number < options.frames; ++number) {
    const cutout::SyntheticTable::Made made = table.make(number);
    score_frame(*thesis, made.frame, made.truth, view, thesis_score);
    score_frame(*cold, made.frame, made.truth, view, cold_score);
    if (options.moving) score_frame(*tracked, made.frame, made.truth, view, tracked_score);
    if (!with_markers) continue;
    const cutout::Frame markers = marker_frame(options, view, made.truth, number);
    score_frame(*aruco, markers, made.truth, view, aruco_score);
    score_frame(*apriltag, markers, made.truth, view, apriltag_score);
  }
  print_score_heading(fmt::format("{}, {} triangles, {} frames of {} x {}", title, count, options.frames,
                                  options.width, options.height));
  print_score("thesis", thesis_score);
  print_score("pose, from nothing", cold_score);
  if (options.moving) print_score("pose, following", tracked_score);
  if (with_markers) {
    print_score("ArUco (36h11), markers", aruco_score);
    print_score("AprilTag (36h11), markers", apriltag_score);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

void print_figures(const CutoutExtent& extent) {
  cutout::SyntheticOptions usual;
  usual.known = cutout::usual_triangles(12);
  usual.frames = extent.frames;
  usual.seed = extent.seed;
  print_figure("moving", usual, true);
  cutout::SyntheticOptions scattered = usual;
  scattered.moving = false;
  print_figure("new places in every frame", scattered, true);
  cutout::SyntheticOptions covered = usual;
  covered.occlude = 0.5;
  print_figure("moving, half of each edge hidden", covered, true);
  covered.moving = false;
  print_figure("new places, half of each edge hidden", covered, true);
  cutout::SyntheticOptions hands = usual;
  hands.hands = true;
  hands.frames = extent.hand_frames;
  print_figure("moved by hands, which hide some altogether", hands, false);
  cutout::SyntheticOptions large = usual;
  large.width = 1920;
  large.height = 1080;
  large.table_height = 360;
  large.frames = extent.large_frames;
  print_figure("moving", large, true);
  const CrossingFigures crossing = follow_crossing_pairs(extent.crossing_frames, extent.seed);
  fmt::print("-- pairs of nearly one shape that cross, following, {} frames\n", crossing.frames);
  fmt::print("swaps {}, ghosts {}, found {:.2f} %, those that lie below the other among them\n",
             crossing.swaps, crossing.ghosts, crossing.found_percent);
}

}  // namespace
}  // namespace icome::benchmarks

int main(int argc, char** argv) {
  using namespace icome::benchmarks;
  CutoutExtent extent;
  CLI::App app("Measures trackers of triangles and of markers on computed frames");
  bool quick = false;
  app.add_flag("--quick", quick, "Few frames, to see that it runs");
  app.add_option("--frames", extent.frames, "Of most figures")->check(CLI::PositiveNumber);
  app.add_option("--hand-frames", extent.hand_frames, "With hands")->check(CLI::PositiveNumber);
  app.add_option("--crossing-frames", extent.crossing_frames, "Of pairs that cross")
      ->check(CLI::PositiveNumber);
  app.add_option("--seed", extent.seed, "Of places, motion and noise");
  CLI11_PARSE(app, argc, argv);
  if (quick)
    extent = {.frames = 4, .hand_frames = 4, .large_frames = 2, .crossing_frames = 50, .seed = extent.seed};
  print_figures(extent);
  return 0;
}
