#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "session/session.h"
#include "study/records/records.h"

namespace icome::study {

/// Where a person's trials take place: a running session, whose design, hand and look it rules while trials
/// go on. Session and study outlive it; one thread (main) uses it.
class TrialStage {
 public:
  enum class State : std::uint8_t {
    Idle,
    Loading,  // the scene is being read
    Seeking,  // the pointer is to be brought to the start
    Holding,  // it is held there
    Running,  // measured
    Over,     // measures() and trace() are there
    Failed,   // why() says so
  };
  /// `folder`: of the study file, which scenes lie beside.
  TrialStage(session::Session& session, const Study& study, std::filesystem::path folder,
             const Participant& participant);
  ~TrialStage();

  /// How the session is to look; the place of the start is added while it is sought.
  void set_look(const session::DisplayWish& look);
  /// Starts a trial, from Idle, Over or Failed.
  void begin(const TrialPlan& plan);
  /// Gives up the trial: Idle.
  void stop();
  /// Updates the session and takes the trial on. Call it some 60 times a second, also between trials.
  State update();
  State state() const;

  /// What the session wants to tell since the last call.
  std::vector<session::SessionEvent> take_events();
  /// True once when the start has come and there is to be a beep.
  bool take_beep();
  /// Until the pointer is released, s; while Holding.
  double hold_left() const;
  /// Where the pointer is to be brought, m, stage frame; while Seeking.
  base::Vector3 start() const;
  const TrialMeasures& measures() const;
  const Trace& trace() const;
  const std::string& why() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::study
