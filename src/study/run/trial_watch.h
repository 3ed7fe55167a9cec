#pragma once
#include <deque>

#include "study/definition/trial_goal.h"
#include "study/records/records.h"

namespace icome::study {

/// Watches a trial tick by tick: the arrival of the pointer at the start, the time that it is held there,
/// its movement afterwards, and the end (thesis 6.5.1 and 6.6.1).
class TrialWatch {
 public:
  enum class State : std::uint8_t { Seeking, Holding, Running, Over };

  explicit TrialWatch(TrialGoal goal);

  /// Takes the next tick; its time counts from any origin, s, and never goes back. The touched thing is an
  /// index of the goal's things, or -1. The pointer is caught within 1 cm of the start.
  State step(const Sample& tick);
  /// Has the pointer been held long enough, so that it is to be released?
  bool is_due() const { return state_ == State::Holding && now_ - caught_ >= goal_.hold; }
  /// The person has chosen this thing of the goal by saying its name, which counts in the next tick while
  /// Running, or where something said before still waits for that, in the one after it.
  void say(int thing) { said_.push_back(thing); }
  /// Releases the pointer: the next tick is the start.
  void release() { released_ = true; }

  State state() const { return state_; }
  const TrialGoal& goal() const { return goal_; }
  /// The element of the scene as the pointer has it; null: the scene has none.
  const interaction::ElementUse* element() const { return element_ ? &*element_ : nullptr; }
  /// The time until the pointer is released, s; 0 unless Holding.
  double hold_left() const;
  /// The thing that would be chosen now, to be lit up; -1: none.
  int lit() const { return lit_; }
  /// The measures of a trial that is over.
  const TrialMeasures& measures() const { return measures_; }
  /// The samples since the pointer was caught, with times counted from the start.
  const std::vector<Sample>& samples() const { return samples_; }

 private:
  static constexpr double kNeverTouched = -1e9;  // s
  void start(double time);
  void run(const Sample& tick);
  void follow_element(Sample& tick);
  bool is_approached(const base::Vector3& tip) const;
  int chosen(const Sample& tick);
  std::size_t whole_of(int part) const;
  bool is_same(int one, int other) const;
  int touched_anew(const Sample& tick);
  int pushed(const Sample& tick);
  void end(bool completed, double time);

  TrialGoal goal_;
  std::optional<interaction::ElementUse> element_;  // refers to that of the goal
  State state_ = State::Seeking;
  double caught_ = 0.0, now_ = 0.0, start_ = 0.0;  // s
  std::vector<Sample> samples_;
  TrialMeasures measures_;
  std::deque<int> said_;
  bool released_ = false;
  bool approached_ = false;
  int lit_ = -1;
  int of_element_ = -1;  // thing of the element that was chosen in this tick
  // The state at the last tick or before.
  base::Vector3 tip_ = base::Vector3::Zero();
  std::uint32_t buttons_ = 0;
  std::vector<double> touched_at_;  // s, when each thing was touched last
  int in_contact_ = -1;             // at the last tick
  bool pushed_ = false;             // in this contact already
};

}  // namespace icome::study
