#include "study/records/allocation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parse_number.h"
#include "base/random.h"
#include "study/definition/conditions.h"

namespace icome::study {
namespace {

/// Two groups may differ by this many people for the sake of balance; the last people even it out.
constexpr std::size_t kMostApart = 2;

std::size_t spread(const std::vector<std::size_t>& counts) {
  const auto [least, most] = std::ranges::minmax(counts);
  return most - least;
}

std::vector<std::size_t> group_sizes(std::size_t groups, const std::vector<Allocated>& already) {
  std::vector<std::size_t> sizes(groups);
  for (const Allocated& person : already) ++sizes[person.group];
  return sizes;
}

/// For each factor, the number of people in each group who have the same class as `person`.
std::vector<std::vector<std::size_t>> alike_counts(const AllocationPlan& plan,
                                                   const std::vector<Allocated>& already,
                                                   const Classes& person) {
  std::vector<std::vector<std::size_t>> counts(plan.factors.size(), std::vector<std::size_t>(plan.groups));
  for (const Allocated& other : already)
    for (std::size_t f = 0; f < plan.factors.size(); ++f)
      if (other.classes[f] == person[f]) ++counts[f][other.group];
  return counts;
}

bool is_open(const AllocationPlan& plan, const std::vector<std::size_t>& sizes, std::size_t group) {
  const std::size_t smallest = *std::ranges::min_element(sizes);
  if (plan.group_size > 0 && smallest < plan.group_size && sizes[group] >= plan.group_size) return false;
  return sizes[group] + 1 <= smallest + std::max<std::size_t>(plan.most_apart, 1);
}

base::Result<std::size_t> level_class(const ControlVariable& variable, const std::string& answer) {
  const auto found = std::ranges::find(variable.levels, answer, &Level::id);
  if (found == variable.levels.end())
    return base::fail(fmt::format("'{}' has no level '{}'.", variable.id, answer));
  return std::size_t(found - variable.levels.begin());
}

base::Result<std::size_t> split_class(const ControlVariable& variable, const std::string& answer) {
  const auto value = base::parse_finite(answer);
  if (!value) return base::fail(fmt::format("'{}' is a number, and '{}' is none.", variable.id, answer));
  return std::size_t(std::ranges::upper_bound(variable.split, *value) - variable.split.begin());
}

}  // namespace

std::size_t allocate(const AllocationPlan& plan, const std::vector<Allocated>& already,
                     const Classes& person) {
  const std::vector<std::size_t> sizes = group_sizes(plan.groups, already);
  const auto counts = alike_counts(plan, already, person);
  std::vector<std::size_t> best;
  std::pair<double, std::size_t> least{};
  for (std::size_t group = 0; group < plan.groups; ++group) {
    if (!is_open(plan, sizes, group)) continue;
    std::pair<double, std::size_t> badness(0.0, sizes[group]);
    for (std::size_t f = 0; f < plan.factors.size(); ++f) {
      std::vector<std::size_t> with = counts[f];
      ++with[group];
      badness.first += plan.factors[f].weight * double(spread(with));
    }
    if (best.empty() || badness < least) best.clear();
    if (best.empty()) least = badness;
    if (badness == least) best.push_back(group);
  }
  base::Random random(base::Random(plan.seed).bits() ^ already.size());
  return best[random.index(best.size())];
}

AllocationPlan allocation_plan(const Study& study) {
  AllocationPlan plan;
  plan.groups = crossings(study, true).size();
  plan.seed = study.seed;
  for (const ControlVariable& variable : study.control)
    if (variable.balanced)
      plan.factors.push_back({std::max(variable.levels.size(), variable.split.size() + 1), variable.weight});
  if (!plan.factors.empty()) plan.most_apart = kMostApart;
  plan.group_size = (study.participants + plan.groups - 1) / plan.groups;
  return plan;
}

base::Result<Classes> classes_of(const Study& study, const std::vector<std::string>& answers) {
  if (answers.size() != study.control.size())
    return base::fail(
        fmt::format("there are {} answers for {} control variables.", answers.size(), study.control.size()));
  Classes classes;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const ControlVariable& variable = study.control[i];
    if (!variable.balanced) continue;
    const auto found =
        variable.levels.empty() ? split_class(variable, answers[i]) : level_class(variable, answers[i]);
    if (!found) return tl::unexpected(found.error());
    classes.push_back(*found);
  }
  return classes;
}

}  // namespace icome::study
