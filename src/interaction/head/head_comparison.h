#pragma once
#include <optional>
#include <span>
#include <vector>

#include "devices/head_trace.h"
#include "interaction/head/head_filter.h"

namespace icome::interaction {

/// The jitter and lag that a filter gives a recorded motion; places in m, rotations in rad, times in s.
struct HeadFilterScore {
  HeadFilterSettings settings;
  /// Root mean square of the deviation from a straight line, or an even turn, in the stillest twentieth of
  /// the stretches of half a second; nothing of a recording that is shorter.
  std::optional<double> jitter_place, jitter_turn;
  /// The shift in time by which the recording comes nearest; negative: ahead of it. Nothing where the
  /// recording is shorter than a second and a half, or nothing moves.
  std::optional<double> lag_place, lag_turn;
  /// Root mean square of the distance to the recording at the same time.
  double behind_place = 0.0, behind_turn = 0.0;
};

/// The poses that a way of steadying makes of a recording, one a sample.
std::vector<HeadPose> steadied(std::span<const devices::HeadSample> samples,
                               const HeadFilterSettings& settings);

/// Scores ways of steadying on a recording of at least one sample.
std::vector<HeadFilterScore> compare_head_filters(std::span<const devices::HeadSample> samples,
                                                  std::span<const HeadFilterSettings> ways);

}  // namespace icome::interaction
