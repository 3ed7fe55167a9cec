#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "stats/tables/sums.h"
#include "stats/tests/binomial_test.h"
#include "stats/tests/contingency.h"
#include "stats/tests/fisher_exact.h"
#include "study/analysis/analysis_question.h"

namespace icome::study {
namespace {

/// Counts of answers (columns) by levels of a between factor (rows), without those that nobody has.
struct GroupCounts {
  stats::CountTable table;
  std::vector<std::string> levels, answers;

  /// "Click: red 3, blue 2; Push: red 1, blue 4".
  std::string text() const {
    std::string all;
    for (std::size_t row = 0; row < table.size(); ++row) {
      all.append(row == 0 ? "" : "; ").append(levels[row]);
      for (std::size_t i = 0; i < answers.size(); ++i)
        all += fmt::format("{} {} {:g}", i == 0 ? ":" : ",", answers[i], table[row][i]);
    }
    return all;
  }
};

base::Result<GroupCounts> counts_by_group(const Question& question, const Item& item,
                                          const ItemPlace& place) {
  const auto factors = factors_of(question.data.study, true);
  const std::size_t at = std::size_t(std::ranges::find(factors, question.factor) - factors.begin());
  const std::vector<Crossing> groups = crossings(question.data.study, true);
  std::vector<std::vector<std::string>> answers(question.factor->levels.size());
  for (const GivenAnswer& answer : answers_to(question.data, place)) {
    const std::size_t group = question.data.people[answer.person].participant.group;
    if (group < groups.size()) answers[groups[group][at]].push_back(answer.text);
  }
  const std::vector<std::string> names = answer_names(item);
  std::vector<std::size_t> all = counts_of(item, {});
  for (const std::vector<std::string>& of_level : answers)
    for (std::size_t i = 0; const std::size_t count : counts_of(item, of_level)) all[i++] += count;
  GroupCounts result;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i] > 0) result.answers.push_back(names[i]);
  for (std::size_t level = 0; level < answers.size(); ++level) {
    if (answers[level].empty()) continue;
    const std::vector<std::size_t> counts = counts_of(item, answers[level]);
    result.levels.push_back(plain_name(question.factor->levels[level]));
    std::vector<double>& row = result.table.emplace_back();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i] > 0) row.push_back(double(counts[i]));
  }
  if (result.table.size() < 2 || result.answers.size() < 2)
    return base::fail("all answers are of one level, or all are the same.");
  return result;
}

std::size_t total_of(const stats::CountTable& counts) {
  double total = 0.0;
  for (const std::vector<double>& row : counts) total += stats::sum(row);
  return std::size_t(total);
}

base::Result<TestResult> contingency_of(const stats::CountTable& counts) {
  const auto test = stats::contingency_test(counts);
  if (!test) return tl::unexpected(test.error());
  const std::size_t n = total_of(counts);
  TestResult result =
      plain_result("χ² test of independence", "χ²", test->chi_squared, {test->df}, test->p, n);
  // V is w over the root of the smaller side less 1.
  const double side = std::sqrt(double(std::min(counts.size(), counts.front().size())) - 1.0);
  const stats::ConfidenceInterval w = w_interval(test->chi_squared, test->df, double(n));
  result.effect = "Cramér's V";
  result.effect_size = test->cramers_v;
  result.effect_interval = {w.low / side, std::min(1.0, w.high / side)};
  if (!test->warning.empty()) result.doubts.push_back(test->warning);
  return result;
}

base::Result<TestResult> fisher_of(const stats::CountTable& counts) {
  const auto p = stats::fisher_exact_p(counts);
  if (!p) return tl::unexpected(p.error());
  TestResult result = plain_result("Fisher's exact test", {}, 0.0, {}, *p, total_of(counts));
  if (counts.size() != 2 || counts.front().size() != 2) return result;
  const auto test = stats::fisher_exact_2x2(counts);
  if (!test || !std::isfinite(test->odds_ratio)) return result;
  result.effect = "odds ratio";
  result.effect_size = test->odds_ratio;
  if (std::isfinite(test->interval.high)) result.effect_interval = test->interval;
  return result;
}

/// McNemar's test of answers of the same people at two levels of a within factor.
base::Result<TestResult> mcnemar_of(const Question& question, const Item& item, const ItemPlace& place) {
  const auto levels = compared_levels(question);
  const std::vector<Crossing> conditions = crossings(question.data.study, false);
  const auto factors = factors_of(question.data.study, false);
  if (!levels || factors.size() != 1)
    return base::fail("McNemar's test compares two levels of the only within factor.");
  std::map<std::size_t, std::map<std::size_t, std::size_t>> chosen;  // person, level, choice
  for (const GivenAnswer& answer : answers_to(question.data, place)) {
    const auto choice = std::ranges::find(item.choices, answer.text, &Level::id);
    if (choice == item.choices.end()) continue;
    chosen[answer.person][conditions[answer.condition].front()] = std::size_t(choice - item.choices.begin());
  }
  stats::CountTable counts(item.choices.size(), std::vector<double>(item.choices.size()));
  for (const auto& [person, at] : chosen)
    if (at.contains(levels->first) && at.contains(levels->second))
      ++counts[at.at(levels->first)][at.at(levels->second)];
  const auto test = stats::mcnemar_test(counts);
  if (!test) return tl::unexpected(test.error());
  if (!std::isfinite(test->chi_squared)) return base::fail("nobody changed the answer.");
  const bool exact = std::isfinite(test->exact_p);
  TestResult result =
      exact ? plain_result("McNemar's exact test", {}, 0.0, {}, test->exact_p, 0)
            : plain_result("McNemar-Bowker test", "χ²", test->chi_squared, {test->df}, test->p, 0);
  result.people = total_of(counts);
  if (exact && std::isfinite(test->odds_ratio)) {
    result.effect = "odds ratio";
    result.effect_size = test->odds_ratio;
  }
  return result;
}

/// The number of people who gave each answer to a question that was asked once.
std::vector<std::size_t> all_counts(const Question& question, const Item& item, const ItemPlace& place) {
  std::vector<std::string> texts;
  for (const GivenAnswer& answer : answers_to(question.data, place)) texts.push_back(answer.text);
  return counts_of(item, texts);
}

/// The sign test (Dixon and Mood 1946): people who chose neither answer are ties, reported but not counted.
base::Result<TestResult> sign_test_of(const Question& question, const Item& item, const ItemPlace& place) {
  if (question.factor != nullptr)
    return base::fail("a binomial test compares two answers of a question; leave `factor` out.");
  if (item.kind != ItemKind::Choice)
    return base::fail(
        "a binomial test compares choices, and this is a rating; test = \"wilcoxon\" compares those.");
  const auto compared = compared_answers(question.hypothesis, item);
  if (!compared)
    return base::fail("a binomial test compares two answers; write which, as answers = [\"a\", \"b\"].");
  const std::vector<std::size_t> counts = all_counts(question, item, place);
  const std::size_t first = counts[compared->first], second = counts[compared->second];
  std::size_t ties = 0;
  for (const std::size_t count : counts) ties += count;
  ties -= first + second;
  if (first + second == 0) return base::fail("nobody chose either of the two answers.");
  stats::BinomialTestSettings settings;
  if (question.hypothesis.direction != Direction::Differ)
    settings.alternative = question.hypothesis.direction == Direction::Less ? stats::Alternative::Less
                                                                            : stats::Alternative::Greater;
  const auto test = stats::sign_test(double(first), double(second), settings);
  if (!test) return tl::unexpected(test.error());
  TestResult result = plain_result("sign test", {}, 0.0, {}, test->p, first + second);
  const std::string name = plain_name(item.choices[compared->first]);
  result.counts = fmt::format("{} {}, {} {}, {} {}", first, name, second,
                              plain_name(item.choices[compared->second]), ties, ties == 1 ? "tie" : "ties");
  result.effect = fmt::format("share of {}", name);
  result.effect_size = test->share;
  result.effect_interval = test->interval;
  result.direction = double(first) - double(second);
  return result;
}

/// Tests answers to a question asked once, in groups of people or, without a factor, for equal shares.
base::Result<TestResult> answers_given_once(const Question& question, const Item& item,
                                            const ItemPlace& place) {
  if (question.factor == nullptr) {
    if (question.test == Test::Fisher)
      return base::fail("Fisher's test compares groups of people; test = \"chisq\" does without a factor.");
    return even_shares(all_counts(question, item, place));
  }
  if (!question.factor->between) return base::fail("the question was asked once, not in each condition.");
  const auto counts = counts_by_group(question, item, place);
  if (!counts) return tl::unexpected(counts.error());
  auto result = question.test == Test::Fisher ? fisher_of(counts->table) : contingency_of(counts->table);
  if (result) result->notes.insert(result->notes.begin(), counts->text());
  return result;
}

base::Result<TestResult> changes_of_answers(const Question& question, const Item& item,
                                            const ItemPlace& place, bool repeated) {
  if (question.factor == nullptr || question.factor->between)
    return base::fail(
        "McNemar's test compares answers of the same people under two levels; test = \"chisq\" others.");
  if (!repeated) return base::fail("the question was asked once, not in each condition.");
  if (item.kind != ItemKind::Choice)
    return base::fail(
        "McNemar's test compares choices, and this is a rating; test = \"wilcoxon\" compares those.");
  return mcnemar_of(question, item, place);
}

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> compared_answers(const Hypothesis& hypothesis,
                                                                    const Item& item) {
  std::vector<std::string> named = hypothesis.answers;
  if (hypothesis.direction != Direction::Differ) named = {hypothesis.first, hypothesis.second};
  if (named.empty() && item.choices.size() == 2) return std::pair<std::size_t, std::size_t>{0, 1};
  if (named.size() != 2 || named.front() == named.back()) return {};
  const auto place_of = [&](const std::string& id) {
    return std::size_t(std::ranges::find(item.choices, id, &Level::id) - item.choices.begin());
  };
  const std::size_t first = place_of(named.front()), second = place_of(named.back());
  if (std::max(first, second) >= item.choices.size()) return {};
  return std::pair{first, second};
}

std::optional<TestResult> shares_that_agree(const Question& question) {
  ItemPlace place;
  if (!find_item(question.data.study, question.dependent.from, place)) return {};
  const Item& item = question.data.study.questionnaires[place.questionnaire].items[place.item];
  const auto compared = compared_answers(question.hypothesis, item);
  if (!compared) return {};
  std::vector<std::size_t> counts = all_counts(question, item, place);
  const auto pair = even_shares({counts[compared->first], counts[compared->second]});
  std::erase(counts, std::size_t{0});
  auto all = even_shares(counts);
  const double alpha = question.hypothesis.alpha;
  if (!all || !pair || all->p >= alpha || pair->p >= alpha) return {};
  return std::move(*all);
}

base::Result<TestResult> test_counts(const Question& question) {
  if (question.hypothesis.direction != Direction::Differ && question.test != Test::Binomial)
    return base::fail("counts of answers have no direction; leave `expected` out, or ask for a rating.");
  ItemPlace place;
  if (!find_item(question.data.study, question.dependent.from, place))
    return base::fail("counts are compared of answers to a question, and the variable is from none.");
  const Questionnaire& questionnaire = question.data.study.questionnaires[place.questionnaire];
  const Item& item = questionnaire.items[place.item];
  if (item.kind == ItemKind::Choices)
    return base::fail("several answers could be chosen, so their counts depend on each other.");
  if (item.kind != ItemKind::Choice && item.kind != ItemKind::Rating)
    return base::fail("the question has no choices to count.");
  // With a single condition everybody answers once.
  const bool repeated =
      questionnaire.when == AskWhen::AfterCondition && crossings(question.data.study, false).size() > 1;
  if (question.test == Test::McNemar) return changes_of_answers(question, item, place, repeated);
  if (!repeated && question.test == Test::Binomial) return sign_test_of(question, item, place);
  if (!repeated) return answers_given_once(question, item, place);
  if (question.factor != nullptr && !question.factor->between)
    return base::fail("the same people answered in each condition; test = \"mcnemar\" compares those.");
  return base::fail("everybody answered several times, so counts depend on each other.");
}

}  // namespace icome::study
