#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <optional>

#include "realtime/recorder.h"

namespace icome::ui {

using LoadCounts = std::array<std::uint64_t, realtime::LoopRecorder::kLoadBins>;

/// The haptic load of the last seconds, out of counts since the start of the servo.
class LoadWindow {
 public:
  /// s: how far back it looks.
  explicit LoadWindow(double seconds = 10.0) : span_(std::int64_t(seconds * 1e9)) {}

  /// The counts at a time (ns, steady clock, never going back). Counts that are less than before are those of
  /// another servo: what was before is forgotten.
  void add(std::int64_t time, const LoadCounts& counts);

  /// Ticks by load within the last seconds.
  const LoadCounts& recent() const { return recent_; }
  std::uint64_t ticks() const { return ticks_; }
  /// The load, in percent, that the share of the ticks stayed within, to half a bin; 100 stands for that and
  /// more. Nothing without ticks.
  std::optional<double> quantile(double share) const;

 private:
  struct Sample {
    std::int64_t time;
    LoadCounts counts;
  };

  std::int64_t span_;
  std::deque<Sample> samples_;  // the first is the last one that is too old, or the first of all
  LoadCounts recent_ = {};
  std::uint64_t ticks_ = 0;
};

}  // namespace icome::ui
