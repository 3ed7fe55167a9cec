#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "sketch/fit/running_fit.h"
#include "sketch_figures.h"

namespace icome::benchmarks {
namespace {

constexpr double kBoundOfSamples = 1e-4;        // m
constexpr double kUnitsOfPeer = 20.0;           // Paper.js units in a mm: 2 for the bound
constexpr double kToleranceOfPeer = 2.0 * 2.0;  // squares, as it compares
constexpr Quantiles kAimOfSample = {1.0, 5.0};

/// ns of each sample of some strokes.
std::vector<std::int32_t> time_samples(const std::vector<std::vector<Vector2>>& lines) {
  std::vector<std::int32_t> times;
  for (const std::vector<Vector2>& line : lines) {
    sketch::RunningFit fit(line.front());
    for (std::size_t i = 1; i < line.size(); ++i) {
      const std::int64_t begin = base::steady_nanoseconds();
      fit.add(line[i]);
      times.push_back(std::int32_t(base::steady_nanoseconds() - begin));
    }
  }
  return times;
}

std::vector<double> in_us(std::span<const std::int32_t> nanoseconds) {
  std::vector<double> us;
  for (const std::int32_t time : nanoseconds) us.push_back(1e-3 * time);
  return us;
}

/// The run with the best p99.9.
std::vector<std::int32_t> best_times(const std::vector<std::vector<Vector2>>& lines, int repeats) {
  std::vector<std::vector<std::int32_t>> runs;
  for (int i = 0; i < repeats; ++i) runs.push_back(time_samples(lines));
  return runs[best_run(runs).index];
}

SketchRow sample_row(const std::string& figure, std::span<const std::int32_t> times, bool is_aim) {
  const Quantiles us = quantiles_us({times.begin(), times.end()});
  return {.figure = figure,
          .unit = "us",
          .ours = spread_us(in_us(times)),
          .to_reach = is_aim ? reached_of(us, kAimOfSample) : ""};
}

double mean(std::span<const std::int32_t> times) {
  double sum = 0.0;
  for (const std::int32_t time : times) sum += time;
  return sum / double(times.size());
}

void add_long(SketchSection& section, const std::vector<BenchStroke>& strokes, const SketchExtent& extent) {
  const PenStroke stroke = long_stroke(strokes, extent.long_samples);
  std::vector<Vector2> line;
  for (const sketch::PenSample& sample : stroke) line.push_back(sample.place / kBoundOfSamples);
  const std::vector<std::int32_t> times = best_times({line}, std::max(1, extent.repeats / 2 + 1));
  const std::span<const std::int32_t> all = times;
  const std::size_t tenth = all.size() / 10;
  section.rows.push_back(sample_row(fmt::format("a stroke of {} samples at 1 kHz", line.size()), all, true));
  section.rows.push_back(sample_row("  its first tenth", all.first(tenth), false));
  section.rows.push_back(sample_row("  its last tenth", all.last(tenth), false));
  section.rows.push_back({.figure = "  last tenth of the first, mean",
                          .unit = "times",
                          .ours = short_number(mean(all.last(tenth)) / mean(all.first(tenth)))});
}

/// Refits of at least so many samples and less than twice as many.
void add_peer(SketchSection& section, const std::vector<std::int32_t>& ours, const PeerRun& peers) {
  const std::vector<PeerRun::Line> lines = peers.refits(kUnitsOfPeer, kToleranceOfPeer);
  if (lines.empty()) return;
  const double our_median = quantiles_us(ours).median;
  const auto add = [&](const std::string& figure, double least, double most) {
    std::vector<double> us;
    for (const PeerRun::Line& line : lines)
      if (line.count >= least && line.count < most) us.push_back(line.us);
    if (us.empty()) return;
    section.rows.push_back({.figure = figure,
                            .unit = "us",
                            .other = spread_us(us),
                            .ratio = fmt::format("{:.1e}", our_median / median(us))});
  };
  add("Paper.js refits all samples so far, all strokes", 0.0, 1e9);
  for (double least = 16.0; least <= 256.0; least *= 4.0)
    add(fmt::format("  {:g} to {:g} samples", least, 2.0 * least - 1.0), least, 2.0 * least);
}

}  // namespace

SketchSection sample_figures(const std::vector<BenchStroke>& strokes, const PeerRun* peers,
                             const SketchExtent& extent) {
  SketchSection section{"cost of a sample, 0.1 mm: median / p99 / p99.9 / most", {}, {}};
  std::vector<std::vector<Vector2>> lines;
  for (const BenchStroke& named : strokes) lines.push_back(line_of(named.stroke, kBoundOfSamples));
  const std::vector<std::int32_t> times = best_times(lines, 2 * extent.repeats);
  section.rows.push_back(sample_row(fmt::format("all strokes, {} samples", times.size()), times, true));
  add_long(section, strokes, extent);
  if (peers) add_peer(section, times, *peers);
  section.notes.push_back(
      "Each call of RunningFit::add is timed by itself, which adds some 0.03 us. The long stroke is the "
      "shared "
      "ones end to end,\nwith their speed, until it is long enough. Of the runs that with the best p99.9.");
  return section;
}

}  // namespace icome::benchmarks
