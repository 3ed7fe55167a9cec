#pragma once
#include <cstdint>
#include <functional>

#include "base/clock.h"

namespace icome::files {

/// Knows how long reading a file may still go on: until its time is over or whoever waits for it says stop.
class Patience {
 public:
  using Progress = std::function<bool(double part)>;

  Patience() = default;
  /// For `seconds` from now; `progress` hears parts from `begin` to 1.
  Patience(double seconds, Progress progress, double begin)
      : end_(base::steady_nanoseconds() + std::int64_t(1e9 * seconds)),
        progress_(std::move(progress)),
        begin_(begin) {}

  /// False when time is over. Cheap enough to ask for every face.
  bool lasts() {
    if (++asked_ % kAsksForOneLook == 0) look();
    return !over_ && !stopped_;
  }
  /// The same after something that takes long, or to tell how much is done, in [0, 1].
  bool lasts(double done) {
    done_ = done;
    look();
    return !over_ && !stopped_;
  }
  bool stopped() const { return stopped_; }

 private:
  static constexpr std::uint32_t kAsksForOneLook = 256;

  void look() {
    if (end_ != 0 && base::steady_nanoseconds() > end_) over_ = true;
    if (progress_ && !stopped_) stopped_ = !progress_(begin_ + done_ * (1.0 - begin_));
  }

  std::int64_t end_ = 0;  // none
  Progress progress_;
  double begin_ = 0.0;
  double done_ = 0.0;
  std::uint32_t asked_ = 0;
  bool over_ = false;
  bool stopped_ = false;
};

}  // namespace icome::files
