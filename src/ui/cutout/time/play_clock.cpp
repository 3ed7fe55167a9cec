#include "ui/cutout/time/play_clock.h"

#include <algorithm>
#include <cmath>

namespace icome::ui {
namespace {

/// A frame is due a little early rather than once more the one before it, where a clock is not quite even.
constexpr double kEarly = 1e-6;  // frames

}  // namespace

double count_in_seconds(const PlayPlan& plan) { return plan.count_in * plan.beat; }

double film_time(const PlayPlan& plan, double seconds) {
  const double time = plan.from / plan.rate + seconds;
  if (!plan.again) return time;
  const double begin = plan.first / plan.rate, length = (plan.last + 1 - plan.first) / plan.rate;
  const double past_end = time - begin - length;
  return past_end < 0.0 ? time : begin + std::fmod(past_end, length);
}

PlayMoment moment_at(const PlayPlan& plan, double seconds) {
  if (seconds < 0.0)
    return {.beats = std::clamp(int(std::ceil(-seconds / plan.beat)), 1, std::max(1, plan.count_in)),
            .frame = plan.from};
  const int frame = int(std::floor(film_time(plan, seconds) * plan.rate + kEarly));
  if (plan.again) {
    const int length = plan.last + 1 - plan.first;
    return {.frame = frame > plan.last ? plan.first + (frame - plan.last - 1) % length : frame};
  }
  return {.frame = std::min(frame, plan.last), .ended = frame > plan.last};
}

}  // namespace icome::ui
