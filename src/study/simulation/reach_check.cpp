#include "study/simulation/reach_check.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "study/definition/conditions.h"
#include "study/definition/scene_check.h"
#include "study/definition/scene_reader.h"
#include "study/definition/trial_draws.h"
#include "study/definition/trial_goal.h"
#include "study/simulation/simulated_person.h"

namespace icome::study {
namespace {

constexpr std::size_t kMostTried = 100;
constexpr double kHeldBack = 0.005;  // m behind a surface, more than a push: the hand is in something solid

/// A trial for each target of each scene, the conditions in turn.
std::vector<TrialPlan> trials_to_try(const Study& study) {
  const std::size_t conditions = std::max<std::size_t>(1, crossings(study, false).size());
  std::vector<TrialPlan> plans;
  const auto add = [&](std::optional<std::size_t> scene) {
    std::set<std::string> targets;
    for (const std::vector<std::size_t>& draw : possible_draws(study)) {
      TrialPlan plan;
      plan.scene = scene;
      plan.practice = !scene;
      plan.condition = plans.size() % conditions;
      plan.values = draw;
      if (plans.size() < kMostTried && targets.insert(name_in_trial(study, plan, study.task->target)).second)
        plans.push_back(std::move(plan));
    }
  };
  for (std::size_t i = 0; i < study.trials.scenes.size(); ++i)
    if (!study.trials.scenes[i].file.empty()) add(i);
  const auto& practice = study.trials.practice_scene;
  if (practice && !practice->file.empty() && is_practised(study.trials)) add(std::nullopt);
  return plans;
}

/// The distance from a place to the target, m; 0 while that is in a menu that is still to be opened.
double way_to_target(const TrialGoal& goal, const base::Vector3& from) {
  double least = std::numeric_limits<double>::infinity();
  for (const Thing& thing : goal.things)
    if (thing.target && !thing.bounds.isEmpty()) least = std::min(least, thing.bounds.exteriorDistance(from));
  return std::isfinite(least) ? least : 0.0;
}

/// Does the person choose the target in time, within an arm's length, with a hand that is held back by
/// nothing solid? A trial that cannot be made counts: others tell why.
bool is_reached(const Study& study, SceneReader& scenes, const SimulatedPerson& person,
                const TrialPlan& plan) {
  const auto world = scenes.in_trial(plan);
  const auto element = scenes.element_in(plan);
  if (!world || !element) return true;
  const auto goal = trial_goal(study, {}, plan, *world, *element);
  if (!goal) return true;
  if (way_to_target(*goal, goal->start) > person.model().arm_length) return false;
  session::HapticRepresentation felt;
  felt.open(*world);
  const auto run = person.trial(plan, *goal, {felt.scene(), felt.names()});
  if (!run.measures.completed || !goal->is_in_element()) return run.measures.completed;
  const Sample& last = run.trace.samples.back();
  return (last.tip - last.scp).norm() <= goal->depth + kHeldBack;
}

}  // namespace

void check_reach(const Study& study, const std::filesystem::path& folder, StudyCheck& check,
                 const std::function<bool(double)>& tell) {
  if (!study.task || !check.reasons.empty()) return;
  SceneReader scenes(study, folder);
  const SimulatedPerson person(study, 0);
  const std::vector<TrialPlan> plans = trials_to_try(study);
  std::map<std::string, std::set<std::string>> missed;  // targets, by scene
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (!tell(double(i) / double(plans.size()))) return;
    if (!is_reached(study, scenes, person, plans[i]))
      missed[scene_of(study, plans[i])->id].insert(name_in_trial(study, plans[i], study.task->target));
  }
  for (const auto& [scene, targets] : missed)
    check.warnings.push_back(
        {study.task->place,
         fmt::format(
             "scene '{}': a simulated person does not come to {} within {:g} s and an arm's length, or only "
             "through something solid, such as a wall or the floor.",
             scene, listed(targets), study.task->limit)});
}

}  // namespace icome::study
