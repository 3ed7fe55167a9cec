#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

#include "base/clock.h"

namespace icome::io {

/// Knows how long reading a file may still go on: until its time is over or whoever waits for it says stop.
class TimeBudget {
 public:
  using Progress = std::function<bool(double part)>;

  TimeBudget() = default;
  /// As long as it takes.
  explicit TimeBudget(Progress progress) : progress_(std::move(progress)) {}
  /// For `seconds` from now; `progress` hears parts from `begin` to 1.
  TimeBudget(double seconds, Progress progress, double begin)
      : end_(base::steady_nanoseconds() + std::int64_t(1e9 * seconds)),
        progress_(std::move(progress)),
        begin_(begin) {}

  /// From now on the work is in the step that makes this part of the whole.
  void step(double begin, double end) {
    begin_ = begin;
    step_end_ = end;
    done_ = 0.0;
  }

  /// False when time is over. Cheap enough to ask for every face.
  bool lasts() {
    if (++asked_ % kAsksForOneLook == 0) look();
    return !over_ && !stopped_;
  }
  /// The same after something that takes long, or to tell how much is done of this step, in [0, 1].
  bool lasts(double done) {
    done_ = done;
    return lasts_now();
  }
  /// The same before something that takes long.
  bool lasts_now() {
    look();
    return !over_ && !stopped_;
  }
  /// The same before a polygon is cut, which takes longer the more corners it has.
  bool lasts_for_polygon(std::size_t corners) { return corners > kManyCorners ? lasts_now() : lasts(); }
  bool stopped() const { return stopped_; }

 private:
  static constexpr std::uint32_t kAsksForOneLook = 256;
  static constexpr std::size_t kManyCorners = 100;

  void look() {
    if (end_ != 0 && base::steady_nanoseconds() > end_) over_ = true;
    if (progress_ && !stopped_) stopped_ = !progress_(begin_ + done_ * (step_end_ - begin_));
  }

  std::int64_t end_ = 0;  // none
  Progress progress_;
  double begin_ = 0.0, step_end_ = 1.0;  // of the step
  double done_ = 0.0;
  std::uint32_t asked_ = 0;
  bool over_ = false;
  bool stopped_ = false;
};

}  // namespace icome::io
