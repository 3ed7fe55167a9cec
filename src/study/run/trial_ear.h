#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "speech/listening/ear.h"
#include "study/definition/trial_goal.h"

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

  /// Listens for the names of the goal's things that are the target or wrong. Fails where two of them that
  /// differ in that sound alike.
  base::Result<void> expect(const TrialGoal& goal);
  /// Hears nothing from now on (true).
  void mute(bool muted) { ear_.mute(muted); }
  /// Does it listen?
  bool is_ready() const;
  /// Why it hears nothing, a sentence; empty: it does, or is not ready yet.
  std::string problem() const { return ear_.state().problem; }
  /// The utterances since the last call that may be choices of the trial.
  std::vector<SaidInTrial> take();

 private:
  SaidInTrial understood(const speech::HeardUtterance& utterance) const;

  speech::Grammar grammar_;
  bool expects_ = false;
  speech::Ear ear_;
};

/// The words by which a thing is chosen: its name, that of a widget as it is written there.
std::vector<std::string> words_of_thing(const TrialGoal& goal, const Thing& thing);

}  // namespace icome::study
