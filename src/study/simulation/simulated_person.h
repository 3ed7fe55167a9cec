#pragma once
#include <string>
#include <vector>

#include "base/random.h"
#include "interaction/techniques/bench/person.h"
#include "session/felt/haptic_representation.h"
#include "study/definition/trial_goal.h"
#include "study/records/records.h"

namespace icome::study {

/// s, that simulated people are held before the start of a trial, whatever the study says of people.
inline constexpr double kSimulatedHold = 0.1;

/// Where simulated people do trials: what can be touched, under the names of a world.
struct FeltScene {
  std::shared_ptr<const haptics::HapticScene> scene;
  std::shared_ptr<const session::TouchedNames> names;
};

/// Someone who is not there: moves as the people of the technique bench do, by movements of minimum jerk with
/// noise that end off the goal and are corrected, with a hand that trembles and that forces push back;
/// answers by chance. It sees where things are, whatever hides them, and never learns. To try a study out
/// with; its data say nothing about people.
class SimulatedPerson {
 public:
  SimulatedPerson(const Study& study, std::uint64_t number);

  /// Control variables: any level, any whole number from 18 to 65.
  static std::vector<std::string> control(const Study& study, std::uint64_t number);
  /// Any answer, drawn for this questionnaire and position.
  std::vector<std::string> answers(const Questionnaire& questionnaire, std::size_t position) const;

  struct Run {
    TrialMeasures measures;
    Trace trace;
  };
  /// Does a trial at 1 kHz with a simulated hand, as fast as the machine can. The time that the pointer is
  /// held before the start is cut short to kSimulatedHold. The same trial of the same person gives the same
  /// bits.
  Run trial(const TrialPlan& plan, const TrialGoal& goal, const FeltScene& where) const;

 private:
  std::uint64_t seed_;
  interaction::PersonModel model_;
};

}  // namespace icome::study
