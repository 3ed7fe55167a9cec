// Compares the pen's curves with Paper.js (segments, time, scale), perfect-freehand (outlines), dynamic
// programming (segments) and asking each curve in turn (nearest place), on the shared strokes, in one run.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "sketch_figures.h"

namespace icome::benchmarks {
namespace {

std::vector<BenchStroke> spread_over(const std::vector<BenchStroke>& all, std::size_t count) {
  if (all.size() <= count) return all;
  std::vector<BenchStroke> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
  return some;
}

void print_inputs(const std::vector<BenchStroke>& strokes) {
  std::size_t samples = 0;
  std::set<std::string> files;
  for (const BenchStroke& named : strokes) {
    samples += named.stroke.size();
    files.insert(named.file);
  }
  fmt::print("{} strokes of {} shared recordings, {} samples\n", strokes.size(), files.size(), samples);
}

void print_figures(const std::vector<BenchStroke>& strokes, const PeerRun* peers, const SketchExtent& extent,
                   const std::set<std::string>& parts) {
  const auto asked = [&](const char* part) { return parts.empty() || parts.contains(part); };
  if (asked("segments")) print_section(segment_figures(strokes, peers));
  if (asked("samples")) print_section(sample_figures(strokes, peers, extent));
  if (asked("nearest")) print_section(nearest_figures(strokes, extent));
  if (asked("scale")) print_section(scale_figures(strokes, peers));
  if (asked("pictures")) print_section(picture_figures(strokes, peers, extent));
  if (asked("optimum")) print_section(optimum_figures(strokes, extent));
}

}  // namespace
}  // namespace icome::benchmarks

int main(int argc, char** argv) {
  using namespace icome::benchmarks;
  CLI::App app("Measures the pen's curves. Takes some minutes.");
  bool is_quick = false;
  bool without_peers = false;
  std::vector<std::string> parts;
  app.add_flag("--quick", is_quick, "A few strokes: does it work at all?");
  app.add_flag("--no-peers", without_peers, "Leave out what npm fetches");
  app.add_option("--parts", parts, "Of segments,samples,nearest,scale,pictures,optimum")->delimiter(',');
  SketchExtent extent;
  app.add_option("--smooth-every", extent.smooth_every,
                 "One of so many strokes is also searched for the optimum without breaks")
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  if (is_quick)
    extent = {.strokes = 8,
              .smooth_every = 8,
              .most_points = 30,
              .long_samples = 20'000,
              .curves = 200,
              .points = 500,
              .naive_points = 50,
              .repeats = 1};
  const std::vector<BenchStroke> strokes = spread_over(shared_strokes(), extent.strokes);
  if (strokes.empty()) {
    fmt::print("Nothing was measured, as the shared strokes are not beside the project.\n");
    return 0;
  }
  print_inputs(strokes);
  std::unique_ptr<PeerRun> peers;
  if (!without_peers)
    peers = std::make_unique<PeerRun>(ICOME_PEERS_FOLDER, std::filesystem::temp_directory_path(), strokes);
  const bool has_peers = peers && peers->is_there();
  if (peers && !has_peers) fmt::print("Peers are left out, as npm is not here or cannot fetch them.\n");
  print_figures(strokes, has_peers ? peers.get() : nullptr, extent, {parts.begin(), parts.end()});
  fmt::print("\nOther programs on the machine disturb times: only ratios within one run count.\n");
  return 0;
}
