#pragma once
#include <string>
#include <vector>

#include "base/random.h"
#include "interaction/techniques/bench/person.h"
#include "session/felt/haptic_representation.h"
#include "study/definition/trial_goal.h"
#include "study/records/records.h"

namespace icome::study {

/// The time that simulated people are held before a trial's start, s, whatever the study says of people.
inline constexpr double kSimulatedHold = 0.1;

/// The scene of simulated people's trials: its touchable objects, and their names in a world.
struct FeltScene {
  std::shared_ptr<const haptics::HapticScene> scene;
  std::shared_ptr<const session::TouchedNames> names;
};

/// A simulated participant, to try a study out with; its data say nothing about people. Moves as the people
/// of the technique bench do, by movements of minimum jerk with noise that end off the goal and are
/// corrected, with a hand that trembles and that forces push back; answers by chance. It sees where things
/// are, whatever hides them, though depth not sharply (DepthSight), and never learns. Where the study needs
/// head tracking, its head is tracked.
class SimulatedPerson {
 public:
  SimulatedPerson(const Study& study, std::uint64_t number);

  const interaction::PersonModel& model() const { return model_; }

  /// Answers to the control variables: any level, any whole number from 18 to 65.
  static std::vector<std::string> control(const Study& study, std::uint64_t number);
  /// Random answers, drawn for this questionnaire and position.
  std::vector<std::string> answers(const Questionnaire& questionnaire, std::size_t position) const;

  struct Run {
    TrialMeasures measures;
    Trace trace;
  };
  /// Does a trial at 1 kHz with a simulated hand, as fast as the machine can. The time that the pointer is
  /// held before the start is shortened to kSimulatedHold. The same trial of the same person gives the same
  /// bits.
  Run trial(const TrialPlan& plan, const TrialGoal& goal, const FeltScene& where) const;

 private:
  std::uint64_t seed_;
  interaction::PersonModel model_;
  bool tracked_ = false;  // by a head tracker, in trials whose view follows the head
};

}  // namespace icome::study
