#pragma once
#include "study/definition/trial_goal.h"
#include "study/records/records.h"

namespace icome::study {

/// Watches a trial tick by tick: when the pointer is at the start, how long it is held there, what it does
/// then, and when it is over (thesis 6.5.1 and 6.6.1).
class TrialWatch {
 public:
  enum class State : std::uint8_t { Seeking, Holding, Running, Over };

  explicit TrialWatch(TrialGoal goal)
      : goal_(std::move(goal)), touched_at_(goal_.things.size(), kNeverTouched) {}

  /// The next tick; its time counts from anywhere, s, and never goes back. What is touched is the number of
  /// one of the goal's things, or -1. The pointer is caught within 1 cm of the start.
  State step(const Sample& tick);
  /// It has been held for so long, and is to be let go.
  bool is_due() const { return state_ == State::Holding && now_ - caught_ >= goal_.hold; }
  /// It is let go: the next tick is the start.
  void release() { released_ = true; }

  State state() const { return state_; }
  const TrialGoal& goal() const { return goal_; }
  /// Until it is released, s; of Holding.
  double hold_left() const;
  /// What would be chosen now, to be lit up; -1: nothing.
  int lit() const { return lit_; }
  /// Of what is over.
  const TrialMeasures& measures() const { return measures_; }
  /// Since it was caught, times counted from the start on.
  const std::vector<Sample>& samples() const { return samples_; }

 private:
  static constexpr double kNeverTouched = -1e9;  // s
  void start(double time);
  void run(const Sample& tick);
  int chosen(const Sample& tick);
  std::size_t whole_of(int part) const;
  bool is_same(int one, int other) const;
  int touched_anew(const Sample& tick);
  int pushed(const Sample& tick);
  void end(bool completed, double time);

  TrialGoal goal_;
  State state_ = State::Seeking;
  double caught_ = 0.0, now_ = 0.0, start_ = 0.0;  // s
  std::vector<Sample> samples_;
  TrialMeasures measures_;
  bool released_ = false;
  bool approached_ = false;
  int lit_ = -1;
  // At the last tick or before.
  base::Vector3 tip_ = base::Vector3::Zero();
  std::uint32_t buttons_ = 0;
  std::vector<double> touched_at_;  // s, when each thing was touched last
  int in_contact_ = -1;             // at the last tick
  bool pushed_ = false;             // in this contact already
};

}  // namespace icome::study
