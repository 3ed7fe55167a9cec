#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "speech/listening/ear.h"
#include "study/definition/spoken_choices.h"

namespace icome::study {

/// Something that a person said in a trial.
struct SaidInTrial {
  double begin = 0.0, end = 0.0;  // s, on the clock of ears
  std::string heard = {};         // the words
  double score = 0.0;             // speech::Heard::score
  int thing = -1;                 // of the goal that was chosen by it; -1: none
};

/// Hears which thing of a trial is chosen by saying its name: "the red ball", "choose red". It knows all
/// names of one trial, and nothing else. One thread (main) uses it.
class TrialEar {
 public:
  /// Recognition is by PocketSphinx, where nothing else is given.
  explicit TrialEar(speech::OpenSource source,
                    speech::Ear::MakeRecogniser make = &speech::make_sphinx_recogniser);

  /// Listens for the names of the goal's things that are the target or wrong. Fails as spoken_choices().
  base::Result<void> expect(const TrialGoal& goal);
  /// Hears nothing from now on (true).
  void mute(bool muted) { ear_.mute(muted); }
  /// Does it listen?
  bool is_ready() const;
  /// Why it hears nothing, a sentence; empty: it does, or is not ready yet.
  std::string problem() const { return ear_.state().problem; }
  /// The utterances since the last call that may be choices of the trial: none that was begun before its
  /// names were expected.
  std::vector<SaidInTrial> take();

 private:
  SaidInTrial understood(const speech::HeardUtterance& utterance) const;

  std::optional<SpokenChoices> choices_;  // none: of no trial yet
  double expects_since_ = 0.0;            // s, on the clock of ears
  speech::Ear ear_;
};

}  // namespace icome::study
