#pragma once
#include <vector>

#include "speech/dialogue/dialogue.h"
#include "speech/hearing/recogniser.h"

namespace icome::speech {

/// What counts as a sentence of those that may have been said.
struct HearingLimits {
  /// Sounds that fit worse are no sentence (Heard::score).
  double least_score = -6.6;
  /// Words that are so much less likely than the best ones in any order are no sentence (Heard::behind).
  double most_behind = 100.0;
  /// A sentence that cannot be done is meant only where one that can is so much less likely.
  double impossible = 40.0;
};

/// Of the sentences that may have been said, the one that is most likely meant, as it can be done now; null
/// where all are too unlikely. It points into `heard`. By what could be said at the last call of another
/// function of the dialogue.
const Heard* likely_meant(const std::vector<Heard>& heard, Dialogue& dialogue,
                          const HearingLimits& limits = {});

}  // namespace icome::speech
