#include "study/records/trial_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/parse_number.h"
#include "stats/tables/data_table.h"
#include "stats/tables/sums.h"
#include "study/definition/session_length.h"

namespace icome::study {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

bool is_time(const std::string& quantity) {
  return quantity == "time" || quantity == "approach-time" || quantity == "homing-time";
}

/// A measure of a trial, in SI units; NaN for the time of a trial that never came to its end.
double measured_value(const TrialMeasures& measures, const std::string& quantity) {
  if (is_time(quantity) && !measures.completed) return kNone;
  if (quantity == "time") return measures.time;
  if (quantity == "approach-time") return measures.approach_time;
  if (quantity == "homing-time") return measures.homing_time;
  if (quantity == "distance") return measures.distance;
  return measures.errors;
}

/// A table with a row for each person, and no values in it.
PersonTable empty_table(const StudyData& data, bool by_condition) {
  PersonTable table;
  table.between = factors_of(data.study, true);
  table.columns = {{}};
  if (by_condition) {
    table.within = factors_of(data.study, false);
    table.columns = crossings(data.study, false);
  }
  const std::vector<Crossing> groups = crossings(data.study, true);
  for (std::size_t i = 0; i < data.people.size(); ++i) {
    const std::size_t group = data.people[i].participant.group;
    if (group >= groups.size()) continue;
    table.people.push_back(i);
    table.groups.push_back(groups[group]);
    table.values.emplace_back(table.columns.size(), kNone);
  }
  return table;
}

/// The chosen measured trials of a person in a condition; none unless all trials of the condition are there.
std::vector<const TrialRecord*> trials_of(const StudyData& data, const Progress& progress,
                                          std::size_t condition, TrialChoice choice) {
  const std::size_t count = trials_a_condition(data.study.trials);
  std::vector<const TrialRecord*> trials(count);
  for (const TrialRecord& trial : progress.trials)
    if (!trial.plan.practice && trial.plan.condition == condition && trial.plan.number < count)
      trials[trial.plan.number] = &trial;
  if (std::ranges::find(trials, nullptr) != trials.end()) return {};
  if (choice == TrialChoice::Last && count > 0) return {trials.back()};
  return trials;
}

/// The place of a factor among those of a table; their number if it is not among them.
std::size_t place_of(const std::vector<const IndependentVariable*>& factors,
                     const IndependentVariable& factor) {
  return std::size_t(std::ranges::find(factors, &factor) - factors.begin());
}

/// The number or points that were answered; NaN if they cannot be an answer to the question.
double answered_number(const Item& item, const std::string& text) {
  const std::optional<double> number = base::parse_finite(text);
  if (!number) return kNone;
  const bool points = item.kind == ItemKind::Rating;
  if (points && (*number < 1.0 || *number > item.points || *number != std::floor(*number))) return kNone;
  if (*number < item.least.value_or(*number) || *number > item.most.value_or(*number)) return kNone;
  return *number;
}

Crossing without(Crossing crossing, std::size_t place) {
  crossing.erase(crossing.begin() + std::ptrdiff_t(place));
  return crossing;
}

}  // namespace

bool is_measured(const DependentVariable& variable) {
  return is_time(variable.from) || variable.from == "distance" || variable.from == "errors";
}

MeasuredUnit measured_unit(const DependentVariable& variable) {
  if (variable.from == "errors") return {1.0, variable.unit, true};
  const bool time = is_time(variable.from);
  const std::map<std::string, double> scales =
      time ? std::map<std::string, double>{{"s", 1.0}, {"ms", 1000.0}}
           : std::map<std::string, double>{{"m", 1.0}, {"cm", 100.0}, {"mm", 1000.0}};
  const auto found = scales.find(variable.unit);
  if (found != scales.end()) return {found->second, found->first, true};
  return {1.0, time ? "s" : "m", variable.unit.empty()};
}

PersonTable measured_table(const StudyData& data, const DependentVariable& variable, TrialChoice choice,
                           TrialSum sum) {
  PersonTable table = empty_table(data, true);
  const double scale = measured_unit(variable).scale;
  for (std::size_t row = 0; row < table.people.size(); ++row) {
    for (std::size_t condition = 0; condition < table.columns.size(); ++condition) {
      std::vector<double> values;
      for (const TrialRecord* const trial :
           trials_of(data, data.people[table.people[row]].progress, condition, choice)) {
        const double value = scale * measured_value(trial->measures, variable.from);
        if (std::isfinite(value)) values.push_back(value);
      }
      if (values.empty()) continue;
      table.values[row][condition] = sum == TrialSum::Mean ? stats::mean(values) : stats::sum(values);
    }
  }
  return table;
}

TrialList measured_trials(const StudyData& data, const DependentVariable& variable, TrialChoice choice) {
  const PersonTable table = empty_table(data, true);
  const double scale = measured_unit(variable).scale;
  TrialList list;
  list.levels.resize(data.study.independent.size());
  for (std::size_t row = 0; row < table.people.size(); ++row) {
    for (std::size_t condition = 0; condition < table.columns.size(); ++condition) {
      for (const TrialRecord* const trial :
           trials_of(data, data.people[table.people[row]].progress, condition, choice)) {
        list.values.push_back(scale * measured_value(trial->measures, variable.from));
        for (std::size_t i = 0; i < list.levels.size(); ++i) {
          const IndependentVariable& factor = data.study.independent[i];
          list.levels[i].push_back(factor.between ? table.groups[row][place_of(table.between, factor)]
                                                  : table.columns[condition][place_of(table.within, factor)]);
        }
      }
    }
  }
  return list;
}

bool find_item(const Study& study, const std::string& from, ItemPlace& place) {
  for (std::size_t i = 0; i < study.questionnaires.size(); ++i) {
    const Questionnaire& questionnaire = study.questionnaires[i];
    for (std::size_t j = 0; j < questionnaire.items.size(); ++j) {
      if (fmt::format("{}.{}", questionnaire.id, questionnaire.items[j].id) != from) continue;
      place = {i, j};
      return true;
    }
  }
  return false;
}

std::vector<GivenAnswer> answers_to(const StudyData& data, const ItemPlace& place) {
  const Questionnaire& questionnaire = data.study.questionnaires[place.questionnaire];
  const std::string name = fmt::format("{}.{}", questionnaire.id, questionnaire.items[place.item].id);
  const bool by_condition = questionnaire.when == AskWhen::AfterCondition;
  std::vector<GivenAnswer> answers;
  for (std::size_t i = 0; i < data.people.size(); ++i) {
    const Participant& person = data.people[i].participant;
    const std::vector<std::size_t> order = conditions_of(data.study, person);
    std::map<std::size_t, std::string> given;  // the last one counts
    for (const EventRecord& event : data.people[i].progress.events) {
      if (event.kind != EventKind::Answer || event.name != name) continue;
      if (by_condition && event.position >= order.size()) continue;
      given[by_condition ? order[event.position] : 0] = event.value;
    }
    for (const auto& [condition, text] : given)
      if (!text.empty()) answers.push_back({i, condition, text});
  }
  return answers;
}

PersonTable answered_table(const StudyData& data, const ItemPlace& place) {
  const bool by_condition = data.study.questionnaires[place.questionnaire].when == AskWhen::AfterCondition;
  const Item& item = data.study.questionnaires[place.questionnaire].items[place.item];
  PersonTable table = empty_table(data, by_condition);
  for (const GivenAnswer& answer : answers_to(data, place)) {
    const auto row = std::ranges::find(table.people, answer.person) - table.people.begin();
    if (std::size_t(row) == table.people.size()) continue;
    table.values[std::size_t(row)][answer.condition] = answered_number(item, answer.text);
  }
  return table;
}

PersonTable rows_of(const PersonTable& table, const std::vector<std::size_t>& rows) {
  PersonTable chosen{table.within, table.between, table.columns, {}, {}, {}};
  for (const std::size_t row : rows) {
    chosen.people.push_back(table.people[row]);
    chosen.groups.push_back(table.groups[row]);
    chosen.values.push_back(table.values[row]);
  }
  return chosen;
}

PersonTable complete_rows(const PersonTable& table) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.values.size(); ++row)
    if (std::ranges::all_of(table.values[row], [](double value) { return std::isfinite(value); }))
      rows.push_back(row);
  return rows_of(table, rows);
}

PersonTable at_level(const PersonTable& table, const IndependentVariable& factor, std::size_t level) {
  PersonTable part;
  if (const std::size_t place = place_of(table.between, factor); place < table.between.size()) {
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < table.groups.size(); ++row)
      if (table.groups[row][place] == level) rows.push_back(row);
    part = rows_of(table, rows);
    part.between.erase(part.between.begin() + std::ptrdiff_t(place));
    for (Crossing& group : part.groups) group = without(group, place);
    return part;
  }
  const std::size_t place = place_of(table.within, factor);
  part = {table.within, table.between, {}, table.people, table.groups, {}};
  part.within.erase(part.within.begin() + std::ptrdiff_t(place));
  part.values.resize(table.values.size());
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    if (table.columns[column][place] != level) continue;
    part.columns.push_back(without(table.columns[column], place));
    for (std::size_t row = 0; row < table.values.size(); ++row)
      part.values[row].push_back(table.values[row][column]);
  }
  return part;
}

std::vector<double> person_means(const PersonTable& table) {
  std::vector<double> means;
  for (const std::vector<double>& row : table.values) means.push_back(stats::mean(row));
  return means;
}

std::vector<std::vector<double>> by_level(const PersonTable& table, const IndependentVariable& factor) {
  std::vector<std::vector<double>> levels;
  for (std::size_t level = 0; level < factor.levels.size(); ++level)
    levels.push_back(person_means(at_level(table, factor, level)));
  return levels;
}

}  // namespace icome::study
