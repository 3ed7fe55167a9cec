#include "apps/touch/touch_figures.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include "apps/touch/effect_options.h"

namespace icome::apps {
namespace {

constexpr double kMicrosecond = 1e3;  // ns
constexpr double kSecond = 1e9;       // ns

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

std::size_t load_bin(double load) {
  const auto& edges = TouchFigures::kLoadEdges;
  return static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), load) - edges.begin());
}

}  // namespace

realtime::Quantiles exact_quantiles(std::vector<std::uint32_t> samples, double unit) {
  if (samples.empty()) return {};
  std::sort(samples.begin(), samples.end());
  const auto quantile = [&](double share) {
    const double rank = std::ceil(share * static_cast<double>(samples.size()));
    return samples[std::max<std::size_t>(1, static_cast<std::size_t>(rank)) - 1] / unit;
  };
  return {quantile(0.5), quantile(0.99), quantile(0.999), samples.back() / unit};
}

TouchFigures figures_of(const std::vector<TouchModel>& models, double build_seconds, const TickLog& log,
                        const RunOutcome& outcome, const TouchOptions& options) {
  TouchFigures figures;
  for (const TouchModel& model : models) {
    figures.model += (figures.model.empty() ? "" : " ") + model.name;
    figures.triangles += model.triangles;
  }
  figures.build_seconds = build_seconds;
  figures.ticks = log.ticks();
  figures.rate_hz = options.rate_hz;
  figures.tick_us = exact_quantiles(log.tick_ns(), kMicrosecond);
  const double period = kSecond / options.rate_hz;
  figures.load = exact_quantiles(log.tick_ns(), period);
  for (const std::uint32_t nanoseconds : log.tick_ns()) ++figures.load_bins[load_bin(nanoseconds / period)];
  figures.overruns = outcome.overruns;
  figures.lost_ticks = outcome.lost_ticks;
  figures.max_force = log.max_force();
  if (log.ticks() > 0) {
    figures.touch_fraction = static_cast<double>(log.touching_ticks()) / static_cast<double>(log.ticks());
  }
  if (log.judge() != nullptr) {
    figures.pops = log.judge()->pops();
    figures.sticks = log.judge()->sticks();
    figures.silent = log.judge()->silent();
    figures.pulls = log.judge()->pulls();
    figures.judge_unfinished = log.judge()->unfinished();
    figures.unjudged = log.judge()->unjudged();
    figures.late = log.judge()->late();
  }
  figures.texture = options.texture;
  for (const haptics::PlacedEffect& effect : effects_of(models, options))
    figures.effects.push_back(effect.text);
  figures.capped = outcome.capped;
  figures.peak_memory_bytes = peak_memory();
  return figures;
}

}  // namespace icome::apps
