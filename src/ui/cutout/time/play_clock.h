#pragma once
#include <cstdint>

namespace icome::ui {

/// The frames that are played, from when on, and what comes before. A plain value.
struct PlayPlan {
  double rate = 25;         // frames/s
  int first = 0, last = 0;  // frames; the round of a loop
  int from = 0;             // the frame to begin with
  bool again = false;       // after the last frame comes the first one
  int count_in = 0;         // beats before it begins
  double beat = 0.5;        // s
};

/// The moment of a film that is played: which frame is due, and how many beats of the count-in are left.
struct PlayMoment {
  int beats = 0;  // left; 0: it plays
  int frame = 0;
  bool ended = false;
};
/// `seconds` since the first frame was due; below 0 in the count-in.
PlayMoment moment_at(const PlayPlan& plan, double seconds);
/// The time of the film, s, that is heard then: in a loop it comes again. It may be before the beginning.
double film_time(const PlayPlan& plan, double seconds);
/// Length of the count-in, s.
double count_in_seconds(const PlayPlan& plan);

}  // namespace icome::ui
