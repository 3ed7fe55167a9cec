#include <fmt/format.h>

#include <algorithm>

#include "study/analysis/analysis_parts.h"

namespace icome::study {
namespace {

bool is_choice(const Item& item) { return item.kind == ItemKind::Choice || item.kind == ItemKind::Choices; }

void describe_columns(const StudyData& data, QuestionSummary& summary) {
  const PersonTable table = answered_table(data, summary.place);
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    std::vector<double> values;
    for (const std::vector<double>& row : table.values) values.push_back(row[column]);
    const auto description = stats::describe(values);
    summary.numbers.push_back(description ? std::optional(*description) : std::nullopt);
  }
}

/// Do ratings differ between the conditions in which they were asked?
Tested compare_conditions(const PersonTable& table) {
  const PersonTable complete = complete_rows(table);
  std::vector<std::vector<double>> columns(complete.columns.size());
  for (const std::vector<double>& row : complete.values)
    for (std::size_t i = 0; i < row.size(); ++i) columns[i].push_back(row[i]);
  if (columns.size() == 2) return tested(signed_ranks_of(columns[0], columns[1], {}));
  return tested(friedman_of(columns));
}

void test_question(const StudyData& data, const Item& item, QuestionSummary& summary) {
  if (item.kind == ItemKind::Choices) {
    summary.test.why = "several answers could be chosen, so their counts depend on each other.";
  } else if (item.kind == ItemKind::Choice && summary.counts.size() == 1) {
    summary.test = tested(even_shares(summary.counts.front()));
  } else if (item.kind == ItemKind::Rating && summary.columns.size() > 1) {
    summary.test = compare_conditions(answered_table(data, summary.place));
  }
}

void list_texts(const StudyData& data, const std::vector<GivenAnswer>& answers, QuestionSummary& summary) {
  for (const GivenAnswer& answer : answers) {
    std::string who = data.people[answer.person].participant.id;
    if (summary.columns.size() > 1) who.append(", ").append(summary.columns[answer.condition]);
    summary.texts.emplace_back(std::move(who), answer.text);
  }
}

QuestionSummary summarise_question(const StudyData& data, const ItemPlace& place) {
  const Questionnaire& questionnaire = data.study.questionnaires[place.questionnaire];
  const Item& item = questionnaire.items[place.item];
  QuestionSummary summary;
  summary.place = place;
  const auto dependent = std::ranges::find(
      data.study.dependent, fmt::format("{}.{}", questionnaire.id, item.id), &DependentVariable::from);
  summary.dependent = std::size_t(dependent - data.study.dependent.begin());
  summary.answers = answer_names(item);
  summary.columns = {""};
  if (questionnaire.when == AskWhen::AfterCondition) {
    summary.columns.clear();
    for (const Crossing& condition : crossings(data.study, false))
      summary.columns.push_back(crossing_title(factors_of(data.study, false), condition));
  }
  const std::vector<GivenAnswer> answers = answers_to(data, place);
  for (std::size_t column = 0; column < summary.columns.size(); ++column) {
    std::vector<std::string> texts;
    for (const GivenAnswer& answer : answers)
      if (answer.condition == column) texts.push_back(answer.text);
    summary.counts.push_back(counts_of(item, texts));
  }
  if (item.kind == ItemKind::OpenText) list_texts(data, answers, summary);
  if (item.kind == ItemKind::Rating || item.kind == ItemKind::Number) describe_columns(data, summary);
  test_question(data, item, summary);
  return summary;
}

}  // namespace

std::vector<std::string> answer_names(const Item& item) {
  std::vector<std::string> names;
  for (const Level& choice : item.choices) names.push_back(plain_name(choice));
  for (int point = 1; item.kind == ItemKind::Rating && point <= item.points; ++point)
    names.push_back(std::to_string(point));
  return names;
}

std::vector<std::string> chosen_ids(const std::string& answer) {
  std::vector<std::string> ids;
  for (std::size_t from = 0; from <= answer.size();) {
    const std::size_t comma = std::min(answer.find(',', from), answer.size());
    std::string id = answer.substr(from, comma - from);
    id.erase(0, std::min(id.find_first_not_of(' '), id.size()));
    if (!id.empty() && std::ranges::find(ids, id) == ids.end()) ids.push_back(std::move(id));
    from = comma + 1;
  }
  return ids;
}

std::vector<std::size_t> counts_of(const Item& item, const std::vector<std::string>& answers) {
  std::vector<std::size_t> counts(answer_names(item).size());
  for (const std::string& answer : answers) {
    const bool several = item.kind == ItemKind::Choices;
    for (const std::string& id : several ? chosen_ids(answer) : std::vector{answer}) {
      for (std::size_t i = 0; i < counts.size(); ++i)
        if (id == (is_choice(item) ? item.choices[i].id : std::to_string(i + 1))) ++counts[i];
    }
  }
  return counts;
}

std::vector<QuestionSummary> summarise_questions(const StudyData& data) {
  std::vector<QuestionSummary> all;
  for (std::size_t i = 0; i < data.study.questionnaires.size(); ++i)
    for (std::size_t j = 0; j < data.study.questionnaires[i].items.size(); ++j)
      all.push_back(summarise_question(data, {i, j}));
  return all;
}

}  // namespace icome::study
