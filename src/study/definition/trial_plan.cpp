#include "study/definition/trial_plan.h"

#include <algorithm>
#include <numeric>

#include "base/random.h"
#include "study/definition/conditions.h"
#include "study/definition/counterbalancing.h"

namespace icome::study {
namespace {

/// The random numbers for one kind of draw for a person, independent of all others.
base::Random random_of(const Study& study, const Participant& participant, std::uint64_t position,
                       std::uint64_t subject) {
  std::uint64_t seed = study.seed;
  for (const std::uint64_t part : {std::uint64_t(participant.number), position, subject})
    seed = base::Random(seed ^ (part + 1) * 0x9e3779b97f4a7c15ULL).bits();
  return base::Random(seed);
}

/// The `block`-th shuffle of 0 ... count - 1 that the random numbers give.
std::vector<std::size_t> shuffle(base::Random random, std::size_t count, std::size_t block) {
  std::vector<std::size_t> order(count);
  for (std::size_t turn = 0; turn <= block; ++turn) {
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
  }
  return order;
}

constexpr std::uint64_t kScenes = 0;            // a subject of draws; trial variables follow
constexpr std::uint64_t kPractice = 1U << 20U;  // practice trials are drawn apart

std::size_t drawn_value(const TrialVariable& variable, base::Random random, std::size_t number) {
  const std::size_t count = variable.values.size();
  if (variable.shuffled) return shuffle(random, count, number / count)[number % count];
  std::size_t value = 0;
  for (std::size_t i = 0; i <= number; ++i) value = random.index(count);
  return value;
}

TrialPlan planned(const Study& study, const Participant& participant, std::size_t position,
                  std::size_t number, bool practice) {
  TrialPlan plan;
  plan.position = position;
  plan.condition = conditions_of(study, participant)[position];
  plan.practice = practice;
  plan.number = number;
  const std::uint64_t apart = practice ? kPractice : 0;
  const Trials& trials = study.trials;
  for (std::size_t i = 0; i < trials.variables.size(); ++i)
    plan.values.push_back(drawn_value(
        trials.variables[i], random_of(study, participant, position, apart + kScenes + 1 + i), number));
  const std::size_t scenes = trials.scenes.size();
  if (scenes == 0 || (practice && trials.practice_scene)) return plan;
  plan.scene = number % scenes;
  if (trials.scenes_shuffled)
    plan.scene = shuffle(random_of(study, participant, position, apart + kScenes), scenes,
                         number / scenes)[number % scenes];
  return plan;
}

}  // namespace

std::vector<std::size_t> conditions_of(const Study& study, const Participant& participant) {
  return condition_order(study.order, crossings(study, false).size(), participant.group,
                         participant.order_row, study.seed);
}

TrialPlan measured_trial(const Study& study, const Participant& participant, std::size_t position,
                         std::size_t number) {
  return planned(study, participant, position, number, false);
}

TrialPlan practice_trial(const Study& study, const Participant& participant, std::size_t position,
                         std::size_t number) {
  return planned(study, participant, position, number, true);
}

const TrialScene* scene_of(const Study& study, const TrialPlan& plan) {
  if (plan.scene) return &study.trials.scenes[*plan.scene];
  return plan.practice && study.trials.practice_scene ? &*study.trials.practice_scene : nullptr;
}

}  // namespace icome::study
