#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <optional>

#include "realtime/recorder.h"

namespace icome::ui {

using LoadCounts = std::array<std::uint64_t, realtime::LoopRecorder::kLoadBins>;

/// The haptic load of the last seconds, computed from counts since the start of the servo.
class LoadWindow {
 public:
  /// `seconds` is the length of the window.
  explicit LoadWindow(double seconds = 10.0) : span_(std::int64_t(seconds * 1e9)) {}

  /// Adds the counts at a time (ns, steady clock, never going back). Counts that are less than before come
  /// from another servo: the earlier ones are forgotten.
  void add(std::int64_t time, const LoadCounts& counts);

  /// Ticks by load within the last seconds.
  const LoadCounts& recent() const { return recent_; }
  std::uint64_t ticks() const { return ticks_; }
  /// The load, in percent, that this share of the ticks stayed within, to half a bin; 100 stands for 100 and
  /// more. Nothing without ticks.
  std::optional<double> quantile(double share) const;

 private:
  struct Sample {
    std::int64_t time;
    LoadCounts counts;
  };

  std::int64_t span_;
  std::deque<Sample> samples_;  // the first is the newest that is too old, or the oldest of all
  LoadCounts recent_ = {};
  std::uint64_t ticks_ = 0;
};

}  // namespace icome::ui
