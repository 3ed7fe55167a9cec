#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

#include "base/clock.h"

namespace icome::io {

/// Limits how long the reading of a file may go on: until its time is over or its progress callback stops it.
class TimeBudget {
 public:
  using Progress = std::function<bool(double part)>;

  TimeBudget() = default;
  /// Without a time limit.
  explicit TimeBudget(Progress progress) : progress_(std::move(progress)) {}
  /// Ends `seconds` from now; `progress` is called with parts from `begin` to 1.
  TimeBudget(double seconds, Progress progress, double begin)
      : end_(base::steady_nanoseconds() + std::int64_t(1e9 * seconds)),
        progress_(std::move(progress)),
        begin_(begin) {}

  /// Begins the step that makes the part from `begin` to `end` of the whole work.
  void step(double begin, double end) {
    begin_ = begin;
    step_end_ = end;
    done_ = 0.0;
  }

  /// False when time is over or the work was stopped. Cheap enough to ask for every face.
  bool lasts() {
    if (++asked_ % kAsksForOneLook == 0) look();
    return !over_ && !stopped_;
  }
  /// As lasts(), after something that takes long, or to report how much of this step is done, in [0, 1].
  bool lasts(double done) {
    done_ = done;
    return lasts_now();
  }
  /// As lasts(), before something that takes long.
  bool lasts_now() {
    look();
    return !over_ && !stopped_;
  }
  /// As lasts(), before a polygon is cut, which takes longer the more corners it has.
  bool lasts_for_polygon(std::size_t corners) { return corners > kManyCorners ? lasts_now() : lasts(); }
  bool stopped() const { return stopped_; }

 private:
  static constexpr std::uint32_t kAsksForOneLook = 256;
  static constexpr std::size_t kManyCorners = 100;

  void look() {
    if (end_ != 0 && base::steady_nanoseconds() > end_) over_ = true;
    if (progress_ && !stopped_) stopped_ = !progress_(begin_ + done_ * (step_end_ - begin_));
  }

  std::int64_t end_ = 0;  // 0: none
  Progress progress_;
  double begin_ = 0.0, step_end_ = 1.0;  // of the step
  double done_ = 0.0;
  std::uint32_t asked_ = 0;
  bool over_ = false;
  bool stopped_ = false;
};

}  // namespace icome::io
