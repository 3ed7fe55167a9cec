#pragma once
#include <optional>
#include <vector>

#include "speech/dialogue/dialogue.h"
#include "speech/hearing/recogniser.h"
#include "speech/hearing/wake_word.h"

namespace icome::speech {

/// Limits that tell sentences from other speech, and likely ones from others.
struct HearingLimits {
  /// Sounds that fit worse are no sentence (Heard::score).
  double least_score = -6.6;
  /// Words that are so much less likely than the best ones in any order are no sentence (Heard::behind).
  double most_behind = 100.0;
  /// A sentence that cannot be done is meant only where one that can is so much less likely.
  double impossible = 40.0;
};

/// The sentence that is most likely meant, of those that may have been said, as it can be done now; null
/// where all are too unlikely. It points into `heard`. By what could be said at the last call of another
/// function of the dialogue.
const Heard* likely_meant(const std::vector<Heard>& heard, Dialogue& dialogue,
                          const HearingLimits& limits = {});

/// The sentence that was taken for what was said, and what came of it.
struct UnderstoodUtterance {
  Answer answer = {};
  std::optional<Heard> heard =
      {};                    // also where it was refused as too unlikely; none: nothing like a sentence
  bool is_addressed = true;  // false: people talk with each other; the answer says by which word to begin
};

/// Does what was most likely meant by an utterance. Its words have their times from `begin`; it ended at
/// `end`, s, on the clock of the stage's hand. With a wake word only what that is said before is meant.
UnderstoodUtterance understand_utterance(Dialogue& dialogue, std::vector<Heard> heard, double begin,
                                         double end, const HearingLimits& limits = {},
                                         WakeWord* wake_word = nullptr);

}  // namespace icome::speech
