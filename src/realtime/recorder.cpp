#include "realtime/recorder.h"

#include <algorithm>
#include <cassert>

namespace icome::realtime {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;

// For counters that one thread alone changes: no locked instruction is needed.
void add_to(std::atomic<std::uint64_t>& counter, std::uint64_t amount) {
  counter.store(counter.load(std::memory_order_relaxed) + amount, std::memory_order_relaxed);
}

Quantiles quantiles_of(const DurationHistogram& histogram, double unit) {
  return {histogram.quantile(0.5) * unit, histogram.quantile(0.99) * unit, histogram.quantile(0.999) * unit,
          static_cast<double>(histogram.max()) * unit};
}

}  // namespace

LoopRecorder::LoopRecorder(double nominal_period) : nominal_period_(nominal_period * 1e9) {
  assert(nominal_period > 0.0);
}

void LoopRecorder::record(const TickTimes& times) {
  if (has_started_) period_.add(times.started - last_started_);
  has_started_ = true;
  last_started_ = times.started;
  lateness_.add(times.started - times.scheduled);
  if (static_cast<double>(times.finished - times.scheduled) > nominal_period_) add_to(overruns_, 1);
  add_to(skipped_, times.skipped);
  add_busy(times.finished - times.started);
}

void LoopRecorder::record_busy(std::int64_t nanoseconds) {
  if (static_cast<double>(nanoseconds) > nominal_period_) add_to(overruns_, 1);
  add_busy(nanoseconds);
}

void LoopRecorder::add_busy(std::int64_t nanoseconds) {
  busy_.add(nanoseconds);
  const double percent = 100.0 * static_cast<double>(nanoseconds) / nominal_period_;
  const double bin = std::clamp(percent, 0.0, static_cast<double>(kLoadBins - 1));
  add_to(load_bins_[static_cast<std::size_t>(bin)], 1);
}

LoopSummary LoopRecorder::summary() const {
  LoopSummary summary;
  summary.ticks = busy_.count();
  summary.overruns = overruns_.load(std::memory_order_relaxed);
  summary.skipped = skipped_.load(std::memory_order_relaxed);
  summary.busy = quantiles_of(busy_, kSecondsPerNanosecond);
  summary.load = quantiles_of(busy_, 1.0 / nominal_period_);
  summary.mean_load = busy_.mean() / nominal_period_;
  summary.period = quantiles_of(period_, kSecondsPerNanosecond);
  summary.lateness = quantiles_of(lateness_, kSecondsPerNanosecond);
  return summary;
}

std::array<std::uint64_t, LoopRecorder::kLoadBins> LoopRecorder::load_histogram() const {
  std::array<std::uint64_t, kLoadBins> bins{};
  for (std::size_t i = 0; i < kLoadBins; ++i) bins[i] = load_bins_[i].load(std::memory_order_relaxed);
  return bins;
}

}  // namespace icome::realtime
