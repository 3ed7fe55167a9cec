#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "base/parse_number.h"
#include "stats/tables/data_table.h"
#include "study/analysis/analysis_parts.h"
#include "study/definition/needs.h"

namespace icome::study {
namespace {

ControlSummary summarise_control(const StudyData& data, std::size_t variable) {
  const ControlVariable& control = data.study.control[variable];
  ControlSummary summary{variable, {}, {}};
  std::vector<double> numbers;
  for (const Level& level : control.levels) summary.counts.emplace_back(plain_name(level), 0);
  for (const StudyData::Person& person : data.people) {
    if (variable >= person.participant.control.size()) continue;
    const std::string& answer = person.participant.control[variable];
    const auto level = std::ranges::find(control.levels, answer, &Level::id);
    if (level != control.levels.end()) ++summary.counts[std::size_t(level - control.levels.begin())].second;
    if (const auto number = base::parse_finite(answer)) numbers.push_back(*number);
  }
  if (!control.levels.empty()) return summary;
  if (const auto description = stats::describe(numbers)) summary.numbers = *description;
  return summary;
}

void count_orders(const StudyData& data, ParticipantSummary& summary) {
  for (const StudyData::Person& person : data.people) {
    const auto order = conditions_of(data.study, person.participant);
    const auto same = std::ranges::find_if(summary.orders, [&](const OrderUse& use) {
      return use.group == person.participant.group && use.conditions == order;
    });
    if (same != summary.orders.end())
      ++same->people;
    else
      summary.orders.push_back({person.participant.group, order, 1});
  }
  std::ranges::stable_sort(summary.orders, {},
                           [](const OrderUse& use) { return std::pair(use.group, use.conditions); });
}

void count_trials(const StudyData& data, ParticipantSummary& summary) {
  for (const StudyData::Person& person : data.people) {
    for (const TrialRecord& trial : person.progress.trials) {
      if (trial.plan.practice || trial.plan.condition >= summary.not_completed_by_condition.size()) continue;
      ++summary.trials;
      if (trial.measures.completed) continue;
      ++summary.not_completed;
      ++summary.not_completed_by_condition[trial.plan.condition];
    }
  }
}

/// Did each condition come equally often at each place, among the people of each group who are through?
/// True of a fixed order, which was never meant to be balanced.
bool orders_balance(const StudyData& data) {
  if (data.study.order == OrderMethod::Fixed) return true;
  const std::size_t conditions = crossings(data.study, false).size();
  std::map<std::size_t, std::vector<std::vector<std::size_t>>> at;  // group, condition, position
  for (const StudyData::Person& person : data.people) {
    if (!person.complete) continue;
    auto& counts = at[person.participant.group];
    counts.resize(conditions, std::vector<std::size_t>(conditions));
    const auto order = conditions_of(data.study, person.participant);
    for (std::size_t position = 0; position < order.size(); ++position) ++counts[order[position]][position];
  }
  const auto even = [](const std::vector<std::size_t>& counts) {
    return std::ranges::all_of(counts, [&](std::size_t count) { return count == counts.front(); });
  };
  return std::ranges::all_of(at, [&](const auto& group) { return std::ranges::all_of(group.second, even); });
}

std::size_t unpractised(const StudyData& data) {
  return std::size_t(std::ranges::count_if(data.people, [](const StudyData::Person& person) {
    return std::ranges::find(person.progress.events, EventKind::Unpractised, &EventRecord::kind) !=
           person.progress.events.end();
  }));
}

/// Adds a sentence for each need of the study that was not met for simulated people: the differences that it
/// makes in the study did not exist for them.
void tell_what_was_not_there(const Study& study, std::vector<std::string>& warnings) {
  std::vector<std::string> told;
  const std::vector<UnmetNeed> unmet = needs_not_simulated(study);
  for (const UnmetNeed& need : unmet) {
    if (std::ranges::find(told, need.id) != told.end()) continue;
    told.push_back(need.id);
    std::vector<std::string> of;
    for (const UnmetNeed& same : unmet)
      if (same.id == need.id) of.push_back(same.of);
    std::string name = need.id;
    std::ranges::replace(name, '-', ' ');
    warnings.push_back(
        fmt::format("In this simulation {} was not there ({}), which {} {}: trials were run without it.",
                    name, need.what, fmt::join(of, " and "), of.size() == 1 ? "needs" : "need"));
  }
}

std::string people_text(std::size_t count, const char* one, const char* more) {
  return count == 1 ? fmt::format("one person {}", one) : fmt::format("{} people {}", count, more);
}

}  // namespace

std::string crossing_title(const std::vector<const IndependentVariable*>& factors, const Crossing& crossing) {
  std::string title;
  for (std::size_t i = 0; i < crossing.size(); ++i)
    title.append(i == 0 ? "" : ", ").append(plain_name(factors[i]->levels[crossing[i]]));
  return title;
}

ParticipantSummary summarise_participants(const StudyData& data) {
  ParticipantSummary summary;
  const std::size_t conditions = crossings(data.study, false).size();
  summary.people = data.people.size();
  summary.by_group.resize(crossings(data.study, true).size());
  summary.complete_by_group = summary.by_group;
  summary.not_completed_by_condition.resize(conditions);
  for (const StudyData::Person& person : data.people) {
    if (person.complete) ++summary.complete;
    if (person.participant.group >= summary.by_group.size()) continue;
    ++summary.by_group[person.participant.group];
    if (person.complete) ++summary.complete_by_group[person.participant.group];
  }
  for (std::size_t i = 0; i < data.study.control.size(); ++i)
    summary.control.push_back(summarise_control(data, i));
  count_orders(data, summary);
  count_trials(data, summary);
  return summary;
}

std::vector<std::string> warnings_of(const StudyData& data, const ParticipantSummary& participants) {
  std::vector<std::string> warnings;
  if (data.simulated)
    warnings.emplace_back("The participants are simulated: these results say nothing about people.");
  if (data.simulated) tell_what_was_not_there(data.study, warnings);
  for (const std::string& need : data.study.without)
    warnings.push_back(fmt::format("The study was run without {}.", need));
  if (participants.people == 0) warnings.emplace_back("Nobody has taken part yet.");
  if (const std::size_t left = participants.people - participants.complete; left > 0)
    warnings.push_back(fmt::format(
        "{} not through; conditions that they did to their end count where a test needs no others of them.",
        people_text(left, "is", "are")));
  if (data.study.participants > participants.complete && participants.people > 0)
    warnings.push_back(
        fmt::format("{} of {} planned people are through; a test that is looked at again and "
                    "again finds something sooner or later.",
                    participants.complete, data.study.participants));
  if (!orders_balance(data))
    warnings.emplace_back(
        "The orders of conditions are not balanced so far: learning and tiredness are mixed "
        "with the effects of conditions.");
  if (const auto [least, most] = std::ranges::minmax(participants.by_group); most > least)
    warnings.push_back(fmt::format("The groups are not of one size: {} to {} people.", least, most));
  if (const std::size_t count = unpractised(data); count > 0)
    warnings.push_back(
        fmt::format("{} not meet the criterion of practice.", people_text(count, "did", "did")));
  if (participants.not_completed > 0)
    warnings.push_back(fmt::format("{} of {} measured trials were not completed; their times do not count.",
                                   participants.not_completed, participants.trials));
  for (const DependentVariable& variable : data.study.dependent)
    if (is_measured(variable) && !measured_unit(variable).known)
      warnings.push_back(fmt::format("{} cannot be told in {}; it is in {}.", plain_name(variable),
                                     variable.unit, measured_unit(variable).name));
  warnings.insert(warnings.end(), data.notices.begin(), data.notices.end());
  return warnings;
}

}  // namespace icome::study
