#include "study/records/people_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "base/near_names.h"
#include "base/parse_number.h"
#include "study/definition/conditions.h"
#include "study/records/disk.h"
#include "study/records/study_columns.h"

namespace icome::study {
namespace {

constexpr std::string_view kPersonPrefix = "sub-";
constexpr std::size_t kMostPeopleEver = 1000000;

std::vector<std::string> group_names(const Study& study) {
  std::vector<std::string> names;
  for (const Crossing& crossing : crossings(study, true))
    names.push_back(crossing_name(study, true, crossing));
  return names;
}

/// "with, near; with, far"
std::string order_text(const Study& study, std::size_t group, std::size_t order_row) {
  const std::vector<Crossing> conditions = crossings(study, false);
  std::string text;
  for (const std::size_t condition : order_of(study, group, order_row))
    text.append(text.empty() ? "" : "; ").append(crossing_name(study, false, conditions[condition]));
  return text;
}

/// The reason why this is not a value of a variable of numbers; empty if it is one.
std::string why_no_number(const ControlVariable& variable, const std::string& answer) {
  const auto value = base::parse_finite(answer);
  if (!value) return fmt::format("'{}' is a number, and '{}' is none.", variable.id, cell_of(answer));
  if (variable.discrete && *value != std::floor(*value))
    return fmt::format("'{}' is counted in whole numbers, and '{}' is none.", variable.id, cell_of(answer));
  if (variable.scale == Scale::Ratio && *value < 0.0)
    return fmt::format("'{}' begins at 0, and '{}' is less.", variable.id, cell_of(answer));
  return {};
}

/// The reason why this is not an answer to the variable; empty if it is one.
std::string why_no_control(const ControlVariable& variable, const std::string& answer) {
  const std::string by_level = base::suggestion(
      answer, variable.levels.empty() ? std::vector<std::string>() : level_ids(variable.levels));
  if (answer.empty())
    return variable.balanced ? fmt::format("'{}' is missing, and the groups are balanced by it; give {}.",
                                           variable.id, variable.levels.empty() ? "a number" : "a level")
                             : std::string();
  if (variable.levels.empty()) return why_no_number(variable, answer);
  const auto found = std::ranges::find(variable.levels, answer, &Level::id);
  return found != variable.levels.end()
             ? std::string()
             : fmt::format("'{}' has no level '{}'{}{}", variable.id, cell_of(answer), by_level,
                           by_level.ends_with('?') ? "" : ".");
}

/// Reads the cells of a row other than the id and the answers.
void read_place(RowReader& row, const Study& study, const std::vector<std::string>& groups,
                Participant& person) {
  person.number = row.whole() - 1;
  if (row.good() && person.number > kMostPeopleEver) row.refuse("is out of order");
  person.group = row.one_of(groups);
  const Crossing crossing = crossings(study, true)[person.group];
  const auto factors = factors_of(study, true);
  for (std::size_t i = 0; i < factors.size(); ++i)
    if (row.one_of(level_ids(factors[i]->levels)) != crossing[i]) row.refuse("does not go with the group");
  person.order_row = row.whole() - 1;
  if (row.good() && person.order_row > person.number) row.refuse("is out of order");
  if (const std::string& order = row.text();
      row.good() && order != order_text(study, person.group, person.order_row))
    row.refuse("is not the order that this person has");
  person.language = row.one_of(study.languages);
}

base::Result<Participant> parse_person(const TsvRow& cells, const Columns& columns, const std::string& source,
                                       const StudyFolder& folder, const std::vector<std::string>& groups) {
  RowReader row(cells, columns, source);
  Participant person;
  const std::string& name = row.text();
  if (name.starts_with(kPersonPrefix)) person.id = name.substr(kPersonPrefix.size());
  if (!is_person_id(person.id)) row.refuse("is not sub- with letters and digits");
  if (person.id.starts_with(kSimulated) != folder.simulated) row.refuse("mixes simulated and real people");
  read_place(row, folder.study, groups, person);
  if (!row.good()) return tl::unexpected(row.result().error());
  for (std::size_t i = 0; i < folder.study.control.size(); ++i) {
    person.control.push_back(row.text());
    if (!why_no_control(folder.study.control[i], person.control.back()).empty())
      row.refuse("is no answer to this variable");
  }
  if (!row.good()) return tl::unexpected(row.result().error());
  return person;
}

/// Checks that ids are unique and that numbers rise, both those of all people and those in each group.
class PeopleSequence {
 public:
  /// The reason why this person cannot come next; empty if they can.
  std::string why_not(const Participant& next) {
    if (!ids_.insert(next.id).second) return fmt::format("sub-{} is there twice.", next.id);
    const bool rises = next.number >= next_number_ && next.order_row >= next_of_group_[next.group];
    next_number_ = next.number + 1;
    next_of_group_[next.group] = next.order_row + 1;
    return rises ? std::string() : std::string("the rows are out of order.");
  }

 private:
  std::set<std::string> ids_;
  std::size_t next_number_ = 0;
  std::map<std::size_t, std::size_t> next_of_group_;
};

Column control_column(const ControlVariable& variable) {
  return {variable.id, first_text(variable.name), variable.unit, column_levels(variable.levels), true};
}

}  // namespace

Columns people_columns(const StudyFolder& folder) {
  Columns columns = {
      {"participant_id", "A number that nothing leads from to a person."},
      {"number", "In the order of enrolling, from 1."},
      {"group",
       "Levels of the between-subjects factors, which the person has all along; 'all' without any."}};
  for (const IndependentVariable* const factor : factors_of(folder.study, true))
    columns.push_back(level_column(factor->id, factor->name, factor->levels));
  columns.push_back({"order_row", "In the order of enrolling in the group, from 1."});
  columns.push_back(
      {"order", "The conditions in the order in which the person has them, semicolons between."});
  columns.push_back({"language", "That the study speaks with the person (BCP 47)."});
  for (const ControlVariable& variable : folder.study.control) columns.push_back(control_column(variable));
  return finished_columns(std::move(columns), folder.simulated);
}

std::string person_row(const StudyFolder& folder, const Participant& participant) {
  const Study& study = folder.study;
  std::vector<std::string> cells = {fmt::format("{}{}", kPersonPrefix, participant.id),
                                    fmt::format("{}", participant.number + 1),
                                    group_names(study)[participant.group]};
  const Crossing crossing = crossings(study, true)[participant.group];
  const auto factors = factors_of(study, true);
  for (std::size_t i = 0; i < factors.size(); ++i) cells.push_back(factors[i]->levels[crossing[i]].id);
  cells.push_back(fmt::format("{}", participant.order_row + 1));
  cells.push_back(order_text(study, participant.group, participant.order_row));
  cells.push_back(study.languages[participant.language]);
  for (const std::string& answer : participant.control) cells.push_back(cell_of(answer));
  return row_of(cells, folder.simulated);
}

base::Result<People> parse_people(std::string_view text, const StudyFolder& folder) {
  const std::string source = folder.people().string();
  const Columns columns = people_columns(folder);
  const auto table = parse_tsv(text, source, columns);
  if (!table) return tl::unexpected(table.error());
  People people;
  people.whole = table->whole;
  people.torn = table->torn;
  const std::vector<std::string> groups = group_names(folder.study);
  PeopleSequence sequence;
  for (const TsvRow& row : table->rows) {
    auto person = parse_person(row, columns, source, folder, groups);
    if (!person) return tl::unexpected(person.error());
    if (const std::string why = sequence.why_not(*person); !why.empty())
      return base::fail(fmt::format("{}:{}: {}", source, row.line, why));
    people.participants.push_back(std::move(*person));
  }
  return people;
}

base::Result<People> read_people(const StudyFolder& folder) {
  const auto text = read_whole(folder.people());
  if (!text) return tl::unexpected(text.error());
  return *text ? parse_people(**text, folder) : People();
}

base::Result<std::vector<std::string>> checked_control(const Study& study, std::vector<std::string> answers) {
  if (answers.size() != study.control.size())
    return base::fail(fmt::format("there are {} answers for the {} control variables of the study.",
                                  answers.size(), study.control.size()));
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (answers[i] == kNotAvailable) answers[i].clear();
    if (std::string why = why_no_control(study.control[i], answers[i]); !why.empty())
      return base::fail(std::move(why));
  }
  return answers;
}

}  // namespace icome::study
