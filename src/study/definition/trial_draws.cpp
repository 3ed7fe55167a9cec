#include "study/definition/trial_draws.h"

#include <algorithm>
#include <set>
#include <string>

#include "study/definition/study_parts.h"

namespace icome::study {
namespace {

constexpr std::size_t kMostDraws = 500;

/// The indices in Trials::variables of the trial variables that occur in the names of things.
std::vector<std::size_t> variables_of_names(const Study& study) {
  std::set<std::string> ids;
  const auto add = [&](const std::string& name) {
    for (std::string& id : variables_in(name)) ids.insert(std::move(id));
  };
  add(study.task->target);
  add(study.task->wrong);
  for (const std::string& name : study.task->shown) add(name);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < study.trials.variables.size(); ++i)
    if (ids.contains(study.trials.variables[i].id)) places.push_back(i);
  return places;
}

}  // namespace

std::vector<std::vector<std::size_t>> possible_draws(const Study& study) {
  const auto& variables = study.trials.variables;
  const std::vector<std::size_t> changed = variables_of_names(study);
  std::size_t count = 1, longest = 1;
  for (const std::size_t place : changed) {
    count = std::min(count * variables[place].values.size(), kMostDraws + 1);
    longest = std::max(longest, variables[place].values.size());
  }
  const bool all = count <= kMostDraws;
  std::vector<std::vector<std::size_t>> draws(all ? count : std::min(longest, kMostDraws),
                                              std::vector<std::size_t>(variables.size(), 0));
  for (std::size_t draw = 0; draw < draws.size(); ++draw) {
    std::size_t rest = draw;
    for (const std::size_t place : changed) {
      const std::size_t values = variables[place].values.size();
      draws[draw][place] = rest % values;
      if (all) rest /= values;
    }
  }
  return draws;
}

bool is_practised(const Trials& trials) { return trials.practice > 0 || trials.criterion.has_value(); }

}  // namespace icome::study
