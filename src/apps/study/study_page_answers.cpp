#include <fmt/format.h>

#include <algorithm>

#include "apps/stats/stats_text.h"
#include "apps/study/study_page_parts.h"

namespace icome::apps {
namespace {

const study::Item& item_of(const study::Study& study, const study::QuestionSummary& question) {
  return study.questionnaires[question.place.questionnaire].items[question.place.item];
}

std::string text_of(const study::Item& item) { return name_of(item.text, item.id); }

std::size_t answered(const study::QuestionSummary& question) {
  std::size_t count = 0;
  for (const auto& column : question.counts)
    for (const std::size_t people : column) count += people;
  return count;
}

/// The reason for no test, where the analysis gives none.
std::string no_test_sentence(const study::Item& item, const study::QuestionSummary& question) {
  if (question.columns.size() == 1)
    return item.kind == study::ItemKind::Rating
               ? "No test: everybody rated it once, so that there is nothing to compare within people."
               : "No test: there is nothing to compare.";
  return "No test: the same people answered in each condition, and tests of counts ask for one answer of "
         "each.";
}

std::string tested_sentence(const study::Study& study, const study::QuestionSummary& question) {
  const study::Tested& test = question.test;
  if (!test.result)
    return test.why.empty() ? no_test_sentence(item_of(study, question), question)
                            : fmt::format("No test: {}", test.why);
  const study::TestResult& result = *test.result;
  std::string text = fmt::format("{}: {}, {}", result.test,
                                 result.counts.empty() ? unbroken(statistic_text(result)) : result.counts,
                                 unbroken(p_text(result.p)));
  if (!result.effect.empty()) text += fmt::format("; {}", effect_text(result));
  text += fmt::format("; n = {}.", result.people);
  for (const std::string& doubt : result.doubts) text += fmt::format(" {}", as_sentence(doubt));
  for (const std::string& note : result.notes) text += fmt::format(" {}", as_sentence(note));
  return text;
}

/// The number of people who answered at all, by column.
std::vector<std::size_t> answerers(const StudyPage& page, const study::QuestionSummary& question) {
  std::vector<std::size_t> people(question.columns.size());
  for (const study::GivenAnswer& answer : study::answers_to(page.data(), question.place))
    if (answer.condition < people.size()) ++people[answer.condition];
  return people;
}

/// Would a chart of shares show shares of ticks rather than of people?
bool has_ticks(const study::Study& study, const study::QuestionSummary& question) {
  return item_of(study, question).kind == study::ItemKind::Choices && question.columns.size() > 1;
}

/// Writes a table of how many people chose each of several answers, after each condition.
void write_ticks(StudyPage& page, const study::QuestionSummary& question, const std::string& name) {
  const study::Study& study = page.data().study;
  const std::vector<std::size_t> people = answerers(page, question);
  PageTable table;
  table.caption = fmt::format("{}: \u201c{}\u201d People who chose each; several answers could be chosen.",
                              name, text_of(item_of(study, question)));
  table.headings = {"Answer"};
  for (std::size_t column = 0; column < people.size(); ++column)
    table.headings.push_back(fmt::format("{} (n = {})", question.columns[column], people[column]));
  for (std::size_t answer = 0; answer < question.answers.size(); ++answer) {
    std::vector<std::string> row = {question.answers[answer]};
    for (const auto& column : question.counts) row.push_back(std::to_string(column[answer]));
    table.rows.push_back(std::move(row));
  }
  table.notes = {tested_sentence(study, question)};
  page.table(table);
}

/// Draws, as figures 6.2 to 6.5, how many people gave each answer; for a question that was asked after each
/// condition, the shares of answers in each.
void write_shares(StudyPage& page, const study::QuestionSummary& question, const std::string& name) {
  const bool one = question.columns.size() == 1;
  const study::Item& item = item_of(page.data().study, question);
  StatsChart chart;
  chart.kind = ChartKind::Shares;
  chart.title = text_of(item);
  chart.groups = one ? question.answers : question.columns;
  chart.x_label = one ? name : "condition";
  chart.y_label = one ? "people" : "share";
  chart.series = one ? std::vector<std::string>{""} : question.answers;
  chart.series_label = one ? "" : name;
  chart.values.assign(chart.series.size(), std::vector<std::vector<double>>(chart.groups.size()));
  for (std::size_t column = 0; column < question.columns.size(); ++column)
    for (std::size_t answer = 0; answer < question.answers.size(); ++answer)
      chart.values[one ? 0 : answer][one ? answer : column] = {double(question.counts[column][answer])};
  const std::string several =
      item.kind == study::ItemKind::Choices
          ? fmt::format("{} answered, each with one or more. ",
                        people_phrase(answerers(page, question).front(), page.data().simulated))
          : std::string();
  page.figure(chart, fmt::format("{}: \u201c{}\u201d {}{}", name, text_of(item), several,
                                 tested_sentence(page.data().study, question)));
}

bool is_compared_rating(const study::Study& study, const study::QuestionSummary& question) {
  return item_of(study, question).kind == study::ItemKind::Rating && question.columns.size() > 1 &&
         answered(question) > 0;
}

void write_ratings(StudyPage& page) {
  PageTable table;
  table.caption = "Ratings: medians with quartiles.";
  const study::Study& study = page.data().study;
  for (const study::QuestionSummary& question : page.analysis().questions) {
    if (!is_compared_rating(study, question)) continue;
    const study::Item& item = item_of(study, question);
    if (table.headings.empty()) {
      table.headings = {"Question"};
      table.headings.insert(table.headings.end(), question.columns.begin(), question.columns.end());
      table.headings.emplace_back("P-value");
    }
    std::vector<std::string> row = {fmt::format("{} (1\u2013{})", text_of(item), item.points)};
    for (const auto& numbers : question.numbers)
      row.push_back(numbers ? fmt::format("{:g} ({:g}\u2013{:g})", numbers->median, numbers->lower_quartile,
                                          numbers->upper_quartile)
                            : "-");
    row.push_back(question.test.result ? p_cell(question.test.result->p) : "-");
    table.rows.push_back(std::move(row));
    table.notes.push_back(fmt::format("{}: {}", text_of(item), tested_sentence(study, question)));
  }
  page.table(table);
}

void write_counts(StudyPage& page, const study::QuestionSummary& question) {
  const study::Item& item = item_of(page.data().study, question);
  PageTable table;
  table.caption = fmt::format("\u201c{}\u201d", text_of(item));
  table.study_caption = true;
  table.headings = {"Answer"};
  for (const std::string& column : question.columns)
    table.headings.push_back(column.empty() ? "People" : column);
  for (std::size_t i = 0; i < question.answers.size(); ++i) {
    std::vector<std::string> row = {question.answers[i]};
    if (item.kind == study::ItemKind::Rating && i == 0 && !item.low.empty())
      row.front() += fmt::format(" ({})", item.low.front());
    if (item.kind == study::ItemKind::Rating && i + 1 == question.answers.size() && !item.high.empty())
      row.front() += fmt::format(" ({})", item.high.front());
    for (const auto& column : question.counts) row.push_back(std::to_string(column[i]));
    table.rows.push_back(std::move(row));
  }
  if (item.kind == study::ItemKind::Choices)
    table.notes = {fmt::format("Several answers could be chosen; people who answered: {}.",
                               fmt::join(answerers(page, question), ", "))};
  page.table(table);
}

void write_numbers(StudyPage& page, const study::QuestionSummary& question) {
  const study::Item& item = item_of(page.data().study, question);
  PageTable table;
  table.caption = fmt::format("\u201c{}\u201d{}", text_of(item),
                              item.unit.empty() ? "" : fmt::format(" ({})", item.unit));
  table.study_caption = true;
  table.headings = {"", "People", "Mean", "SD", "Range"};
  for (std::size_t i = 0; i < question.numbers.size(); ++i) {
    if (!question.numbers[i]) continue;
    const stats::Description& it = *question.numbers[i];
    table.rows.push_back({question.columns[i].empty() ? "all" : question.columns[i], std::to_string(it.n),
                          figure(it.mean), figure(it.standard_deviation),
                          fmt::format("{:g}\u2013{:g}", it.minimum, it.maximum)});
  }
  page.table(table);
}

/// The language in which a person answered; `who` begins with the person's id.
std::size_t language_of(const study::StudyData& data, const std::string& who) {
  const std::string id = who.substr(0, who.find(','));
  const auto found = std::ranges::find_if(
      data.people, [&](const study::StudyData::Person& person) { return person.participant.id == id; });
  return found == data.people.end() ? 0 : found->participant.language;
}

void write_texts(StudyPage& page, const study::QuestionSummary& question) {
  const study::Study& study = page.data().study;
  page.raw(fmt::format("<p{}><b>{}</b></p>\n", language_attribute(study, 0),
                       escaped(text_of(item_of(study, question)))));
  if (question.texts.empty()) page.paragraph("No answers.");
  for (const auto& [who, text] : question.texts)
    page.raw(
        fmt::format("<blockquote><span{}>{}</span><br /><span class=\"who\">Person {}</span></blockquote>\n",
                    language_attribute(study, language_of(page.data(), who)), escaped(text), escaped(who)));
}

}  // namespace

void write_answers(StudyPage& page) {
  const study::Study& study = page.data().study;
  const auto is_drawn = [&](const study::QuestionSummary& question) {
    return question.dependent < study.dependent.size() && answered(question) > 0;
  };
  const auto& questions = page.analysis().questions;
  if (std::ranges::none_of(questions, [&](const study::QuestionSummary& question) {
        return is_drawn(question) || is_compared_rating(study, question);
      }))
    return;
  page.heading("Answers");
  for (const study::QuestionSummary& question : questions) {
    if (!is_drawn(question)) continue;
    const study::DependentVariable& variable = study.dependent[question.dependent];
    const auto write = has_ticks(study, question) ? write_ticks : write_shares;
    write(page, question, name_of(variable.name, variable.id));
  }
  write_ratings(page);
}

void write_appendix(StudyPage& page) {
  const study::Study& study = page.data().study;
  if (page.analysis().questions.empty()) return;
  page.heading("Appendix: all questions and answers");
  std::size_t questionnaire = study.questionnaires.size();
  for (const study::QuestionSummary& question : page.analysis().questions) {
    if (question.place.questionnaire != questionnaire) {
      questionnaire = question.place.questionnaire;
      page.raw(fmt::format("<h3{}>{}</h3>\n", language_attribute(study, 0),
                           escaped(name_of(study.questionnaires[questionnaire].title,
                                           study.questionnaires[questionnaire].id))));
    }
    if (!question.answers.empty())
      write_counts(page, question);
    else if (item_of(study, question).kind == study::ItemKind::Number)
      write_numbers(page, question);
    else
      write_texts(page, question);
  }
}

}  // namespace icome::apps
