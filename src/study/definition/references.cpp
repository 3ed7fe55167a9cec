#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "study/definition/conditions.h"
#include "study/definition/counterbalancing.h"
#include "study/definition/needs.h"
#include "study/definition/study_parts.h"

namespace icome::study {
namespace {

/// Ids that must differ from each other.
class IdSet {
 public:
  IdSet(std::string what, Problems& problems) : what_(std::move(what)), problems_(problems) {}
  void add(const std::string& id, Place place) {
    if (id.empty()) return;  // reported already
    if (!seen_.insert(id).second)
      problems_.add(place, fmt::format("{} '{}' is there twice; name them apart.", what_, id));
  }

 private:
  std::string what_;
  Problems& problems_;
  std::set<std::string> seen_;
};

template <typename Part>
std::vector<std::string> ids_of(const std::vector<Part>& parts) {
  std::vector<std::string> ids;
  for (const Part& part : parts) ids.push_back(part.id);
  return ids;
}

/// Adds a problem unless `said` is one of the names.
void check_named(const std::string& said, const std::vector<std::string>& names, const std::string& what,
                 Place place, Problems& problems) {
  if (std::ranges::find(names, said) != names.end()) return;
  const std::string near = base::suggestion(said, names);
  problems.add(place, fmt::format("{} '{}'{}{}", what, said, near, near.ends_with('?') ? "" : "."));
}

template <typename Part>
void check_distinct(const std::vector<Part>& parts, const std::string& what, Problems& problems) {
  IdSet ids(what, problems);
  for (const Part& part : parts) ids.add(part.id, part.place);
}

void check_ids(const Study& study, Problems& problems) {
  IdSet variables("variable", problems);  // all are columns of one log
  const auto add_variables = [&](const auto& parts) {
    for (const auto& part : parts) variables.add(part.id, part.place);
  };
  add_variables(study.independent);
  add_variables(study.dependent);
  add_variables(study.control);
  add_variables(study.trials.variables);
  for (const IndependentVariable& factor : study.independent)
    check_distinct(factor.levels, "level", problems);
  for (const ControlVariable& control : study.control) check_distinct(control.levels, "level", problems);
  for (const TrialVariable& variable : study.trials.variables)
    check_distinct(variable.values, "value", problems);
  check_distinct(study.hypotheses, "hypothesis", problems);
  check_distinct(study.trials.scenes, "scene", problems);
  check_distinct(study.questionnaires, "questionnaire", problems);
  for (const Questionnaire& questionnaire : study.questionnaires) {
    check_distinct(questionnaire.items, "question", problems);
    for (const Item& item : questionnaire.items) check_distinct(item.choices, "choice", problems);
  }
}

/// The question that a variable is from; null if there is none.
const Item* item_of(const Study& study, const std::string& dependent) {
  const auto variable = std::ranges::find(study.dependent, dependent, &DependentVariable::id);
  if (variable == study.dependent.end()) return nullptr;
  for (const Questionnaire& questionnaire : study.questionnaires)
    for (const Item& item : questionnaire.items)
      if (fmt::format("{}.{}", questionnaire.id, item.id) == variable->from) return &item;
  return nullptr;
}

/// Checks the answers that a hypothesis names for a binomial test.
void check_answers(const Study& study, const Hypothesis& hypothesis, Problems& problems) {
  const std::string of = fmt::format("hypothesis '{}': ", hypothesis.id);
  const auto add = [&](const char* what) { problems.add(hypothesis.place, of + what); };
  if (hypothesis.test != Test::Binomial) {
    if (!hypothesis.answers.empty()) add("answers are named for test = \"binomial\" only; leave them out.");
    if (hypothesis.beside != Test::None) add("beside goes with test = \"binomial\"; leave it out.");
    return;
  }
  if (!hypothesis.factor.empty())
    add("test = \"binomial\" compares two answers of a question; leave out factor.");
  std::vector<std::string> compared = hypothesis.answers;
  if (!compared.empty() && (compared.size() != 2 || compared.front() == compared.back()))
    add("answers are the two that are compared, as answers = [\"old\", \"new\"].");
  if (hypothesis.direction != Direction::Differ) {
    if (!compared.empty()) add("expected names the answers already; leave out answers.");
    if (hypothesis.first == hypothesis.second) add("expected compares an answer with itself.");
    compared = {hypothesis.first, hypothesis.second};
  }
  const Item* const item = item_of(study, hypothesis.dependent);
  if (item == nullptr || item->kind != ItemKind::Choice) return;  // reported by check_study()
  for (const std::string& answer : compared)
    check_named(answer, ids_of(item->choices), fmt::format("{}'{}' has no choice", of, item->id),
                hypothesis.place, problems);
}

void check_hypothesis(const Study& study, const Hypothesis& hypothesis, Problems& problems) {
  const std::string of = fmt::format("hypothesis '{}': ", hypothesis.id);
  if (!hypothesis.dependent.empty())
    check_named(hypothesis.dependent, ids_of(study.dependent), of + "there is no dependent variable",
                hypothesis.place, problems);
  if (hypothesis.factor.empty()) {
    if (hypothesis.direction != Direction::Differ && hypothesis.test != Test::Binomial)
      problems.add(hypothesis.place, of + "expected compares levels; write the factor that has them.");
    return;
  }
  check_named(hypothesis.factor, ids_of(study.independent), of + "there is no independent variable",
              hypothesis.place, problems);
  const auto factor = std::ranges::find(study.independent, hypothesis.factor, &IndependentVariable::id);
  const bool of_answers = hypothesis.test == Test::Binomial;
  if (factor == study.independent.end() || hypothesis.direction == Direction::Differ || of_answers) return;
  for (const std::string& level : {hypothesis.first, hypothesis.second})
    if (!level.empty())
      check_named(level, ids_of(factor->levels), fmt::format("{}'{}' has no level", of, factor->id),
                  hypothesis.place, problems);
  if (hypothesis.first == hypothesis.second && !hypothesis.first.empty())
    problems.add(hypothesis.place, of + "expected compares a level with itself.");
}

void check_primary(const Study& study, Problems& problems) {
  const auto first = std::ranges::find(study.hypotheses, true, &Hypothesis::primary);
  for (auto other = first; other != study.hypotheses.end(); ++other)
    if (other != first && other->primary)
      problems.add(other->place, fmt::format("hypothesis '{}': '{}' is primary already, and only one can be.",
                                             other->id, first->id));
}

void check_source(const Study& study, const DependentVariable& variable, Problems& problems) {
  if (variable.from.empty()) return;
  std::vector<std::string> sources;
  for (const std::string_view quantity : measured_quantities()) sources.emplace_back(quantity);
  for (const Questionnaire& questionnaire : study.questionnaires)
    for (const Item& item : questionnaire.items)
      sources.push_back(fmt::format("{}.{}", questionnaire.id, item.id));
  check_named(variable.from, sources, fmt::format("dependent variable '{}': nothing measures", variable.id),
              variable.place, problems);
}

/// Checks that names of things hold no variables other than trial variables.
void check_task(const Study& study, const Task& task, Problems& problems) {
  std::vector<std::string> names = task.shown;
  names.push_back(task.target);
  names.push_back(task.wrong);
  for (const std::string& name : names)
    for (const std::string& variable : variables_in(name))
      check_named(variable, ids_of(study.trials.variables),
                  fmt::format("task: '{}' names a trial variable that is not there:", name), task.place,
                  problems);
}

void check_counts(const Study& study, Problems& problems) {
  if (study.independent.empty())
    problems.add({1, 1}, "the study: nothing is varied; write at least one [[independent]] variable.");
  if (study.dependent.empty())
    problems.add({1, 1}, "the study: nothing is measured; write at least one [[dependent]] variable.");
  if (study.independent.empty()) return;
  const Place place = study.independent.front().place;
  const std::size_t conditions = crossing_count(study, false, kMostConditions);
  if (conditions > kMostConditions)
    problems.add(place, fmt::format("the within factors have more than {} conditions; vary less at once.",
                                    kMostConditions));
  if (crossing_count(study, true, kMostConditions) > kMostConditions)
    problems.add(place, fmt::format("the between factors have more than {} groups; vary less at once.",
                                    kMostConditions));
  if (study.order == OrderMethod::Full && conditions > kMostFullConditions && conditions <= kMostConditions)
    problems.add(place, fmt::format("{} conditions have too many orders for order = \"full\" (at most {} "
                                    "conditions); write order = \"latin-square\".",
                                    conditions, kMostFullConditions));
}

}  // namespace

void check_references(const Study& study, Problems& problems) {
  check_ids(study, problems);
  check_counts(study, problems);
  for (const DependentVariable& variable : study.dependent) check_source(study, variable, problems);
  for (const Hypothesis& hypothesis : study.hypotheses) {
    check_hypothesis(study, hypothesis, problems);
    check_answers(study, hypothesis, problems);
  }
  check_primary(study, problems);
  if (study.task) check_task(study, *study.task, problems);
}

}  // namespace icome::study
