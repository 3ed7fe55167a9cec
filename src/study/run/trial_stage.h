#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "session/session.h"
#include "study/records/records.h"
#include "study/run/trial_ear.h"

namespace icome::study {

/// The stage of a person's trials: a running session, whose design, hand and look it controls while trials
/// go on. Session and study must outlive it; one thread (main) uses it.
class TrialStage {
 public:
  enum class State : std::uint8_t {
    Idle,
    Loading,  // the scene is being read
    Seeking,  // the pointer is to be brought to the start
    Holding,  // it is held there
    Running,  // measured
    Over,     // measures() and trace() are available
    Failed,   // why() gives the reason
  };
  /// `folder` is that of the study file, beside which the scenes lie.
  TrialStage(session::Session& session, const Study& study, std::filesystem::path folder,
             const Participant& participant);
  ~TrialStage();

  /// The microphone by which things are chosen in trials that need speech; the usual one at first. Where the
  /// study has such trials, what recognises speech is loaded from now on.
  void listen_to(speech::OpenSource microphone);
  /// Sets the look of the session; the start is marked in it while it is sought.
  void set_look(const session::DisplayWish& look);
  /// Starts a trial, from Idle, Over or Failed.
  void begin(const TrialPlan& plan);
  /// Gives up the trial; the state is Idle then.
  void stop();
  /// Updates the session and advances the trial. Call it some 60 times a second, also between trials.
  State update();
  State state() const;

  /// The session's events since the last call.
  std::vector<session::SessionEvent> take_events();
  /// True once, when the trial starts and there is to be a beep.
  bool take_beep();
  /// The time until the pointer is released, s; while Holding.
  double hold_left() const;
  /// Is only the microphone still to be heard, while Holding?
  bool awaits_ear() const;
  /// The place that the pointer is to be brought to, m, stage frame; while Seeking.
  base::Vector3 start() const;
  const TrialMeasures& measures() const;
  /// The utterances of a trial that is Over; their times count from its start.
  const std::vector<SaidInTrial>& said() const;
  const Trace& trace() const;
  const std::string& why() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::study
