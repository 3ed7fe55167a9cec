#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "realtime/histogram.h"

namespace icome::realtime {

/// Times at which one tick of a loop was due and ran, ns, steady clock (base::steady_nanoseconds).
struct TickTimes {
  std::int64_t scheduled = 0;  // the deadline that it was started for
  std::int64_t started = 0;
  std::int64_t finished = 0;
  std::uint64_t skipped = 0;  // deadlines passed over since the tick before
};

/// Bounds that half, 99 %, 99.9 % and all of the ticks stayed within.
struct Quantiles {
  double median = 0.0;
  double p99 = 0.0;
  double p999 = 0.0;
  double max = 0.0;
};

/// Statistics of a loop's run. Times are right to 0.2 % (exact below 256 ns), maxima and means are exact.
struct LoopSummary {
  std::uint64_t ticks = 0;
  std::uint64_t overruns = 0;  // ticks that ended after the next one was due
  std::uint64_t skipped = 0;   // deadlines for which no tick ran
  Quantiles busy;              // s spent in a tick
  Quantiles load;              // haptic load: busy over the nominal period; 1 is all of it
  double mean_load = 0.0;      // haptic load over the whole run
  Quantiles period;            // s from start to start
  Quantiles lateness;          // s from deadline to start
};

/// The diary of one loop: period, lateness, busy time and overruns of its ticks, and its haptic load,
/// the share of the nominal period that a tick takes (thesis section 5.5.6 read it off a driver's
/// gauge). Memory is taken at construction. One thread records; any thread may read meanwhile, and
/// nobody waits: a reader may then miss the newest ticks.
class LoopRecorder {
 public:
  static constexpr std::size_t kLoadBins = 101;  // 1 % each up to 100 %, then all above

  /// For a loop of the given nominal period, s, > 0.
  explicit LoopRecorder(double nominal_period);

  /// Records one tick of a loop on the wall clock. Real-time safe.
  void record(const TickTimes& times);

  /// Records one tick of a loop that runs without a clock (as fast as it can): busy time, ns, and
  /// load; it overran when it took longer than the nominal period. Real-time safe.
  void record_busy(std::int64_t nanoseconds);

  /// Figures of all ticks so far, from any thread.
  LoopSummary summary() const;

  /// Ticks by haptic load, from any thread: bin i counts loads in [i, i + 1) %, the last those of
  /// 100 % and more.
  std::array<std::uint64_t, kLoadBins> load_histogram() const;

 private:
  void add_busy(std::int64_t nanoseconds);

  const double nominal_period_;    // ns
  bool has_started_ = false;       // used by the recording thread only
  std::int64_t last_started_ = 0;  // ns; used by the recording thread only
  std::atomic<std::uint64_t> overruns_ = 0;
  std::atomic<std::uint64_t> skipped_ = 0;
  DurationHistogram busy_;
  DurationHistogram period_;
  DurationHistogram lateness_;
  std::array<std::atomic<std::uint64_t>, kLoadBins> load_bins_{};
};

}  // namespace icome::realtime
