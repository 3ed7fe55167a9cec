#pragma once
// How long followers rest after they have made things anew that change with time.
#include <algorithm>

namespace icome::session {

/// Pause (s) after work of `worked` s on the clock, so that such work takes at most a quarter of the time of
/// one core; `shortest` at least. Work of over two thirds of a second takes more than that quarter: as a rule
/// other programs have held it up, which is no reason to stand still for long.
inline double pause_after_work(double worked, double shortest) {
  constexpr double kPauseOfWork = 3.0;
  constexpr double kLongestPause = 2.0;  // s
  return std::clamp(kPauseOfWork * worked, shortest, kLongestPause);
}

}  // namespace icome::session
