#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>

#include "speech/hearing/recogniser.h"

namespace icome::speech {

/// Tells when the samples of a source were heard. They come late, in lumps of any size, and now and then some
/// are lost: those that came soonest in the last second or two count.
class SampleClock {
 public:
  /// So many samples in all have come by `now`, s.
  void came(std::size_t samples, double now) {
    if (now - since_ > kSpan) {
      soonest_before_ = soonest_;
      soonest_ = kNever;
      since_ = now;
    }
    soonest_ = std::min(soonest_, now - double(samples) / kSampleRate);
  }

  /// The moment of the first sample, s, by which those that came last are told: later than it was, where
  /// some were lost since.
  double first() const { return std::min(soonest_, soonest_before_); }

  static constexpr double kSpan = 1.0;  // s

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  double since_ = -kNever;  // s, when the present span began
  double soonest_ = kNever, soonest_before_ = kNever;
};

}  // namespace icome::speech
