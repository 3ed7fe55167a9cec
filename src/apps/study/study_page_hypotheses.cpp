#include <fmt/format.h>

#include "apps/stats/stats_text.h"
#include "apps/study/study_page_parts.h"

namespace icome::apps {
namespace {

void write_computed(StudyPage& page) {
  const study::Study& study = page.data().study;
  PageTable table;
  table.caption = "Tests of the hypotheses.";
  table.headings = {"Hypothesis", "Test", "Statistic", "P", "P (Holm)", "\u03b1", "Result"};
  table.left_columns = 2;
  for (const study::HypothesisResult& result : page.analysis().hypotheses) {
    if (!result.test.result) continue;
    const study::Hypothesis& hypothesis = study.hypotheses[result.hypothesis];
    const study::TestResult& test = *result.test.result;
    table.rows.push_back({name_of(hypothesis.text, hypothesis.id), test.test, statistic_text(test),
                          p_cell(test.p), result.p_holm ? p_cell(*result.p_holm) : "-",
                          share_text(hypothesis.alpha),
                          decision_text(result.decision) + reservation_text(result)});
  }
  table.notes = {decision_rule(study, page.analysis())};
  page.table(table);
}

void write_effects(StudyPage& page) {
  const study::Study& study = page.data().study;
  PageTable table;
  table.caption = "How large the effects are.";
  table.headings = {"Hypothesis", "Effect", "People", "As expected"};
  table.left_columns = 2;
  for (const study::HypothesisResult& result : page.analysis().hypotheses) {
    if (!result.test.result) continue;
    const study::Hypothesis& hypothesis = study.hypotheses[result.hypothesis];
    table.rows.push_back({name_of(hypothesis.text, hypothesis.id), effect_text(*result.test.result),
                          std::to_string(result.test.result->people),
                          !result.as_expected ? "-" : (*result.as_expected ? "yes" : "no")});
  }
  table.notes = {
      "Intervals of shares of variance have a confidence of 90 %: they leave out 0 just where P < "
      ".05. \u201cAs expected\u201d: means, or ranks where the test is one of ranks, lie as the hypothesis "
      "has "
      "them."};
  page.table(table);
}

}  // namespace

void write_hypotheses(StudyPage& page) {
  if (page.analysis().hypotheses.empty()) return;
  page.heading("Hypotheses");
  write_computed(page);
  write_effects(page);
  std::vector<std::string> lines;
  for (const study::HypothesisResult& result : page.analysis().hypotheses) {
    const study::Hypothesis& hypothesis = page.data().study.hypotheses[result.hypothesis];
    if (!result.test.result || !result.test.result->doubts.empty() || result.held_back || result.beside)
      lines.push_back(conclusion_text(page.data().study, result));
    if (!result.test.result) continue;
    for (const std::string& note : result.test.result->notes)
      lines.push_back(fmt::format("{} {}", name_of(hypothesis.text, hypothesis.id), as_sentence(note)));
  }
  page.list(lines);
}

void write_checks(StudyPage& page) {
  if (page.analysis().checks.empty()) return;
  const study::Study& study = page.data().study;
  PageTable table;
  table.caption = "What the tests of means take for granted, of people's means over all measurements.";
  table.headings = {"Variable", "By", "Assumption", "Test", "Statistic", "P"};
  table.left_columns = 4;
  std::vector<std::string> lines;
  for (const study::AssumptionCheck& check : page.analysis().checks) {
    const study::DependentVariable& variable = study.dependent[check.variable];
    const study::IndependentVariable& factor = study.independent[check.factor];
    const std::string name = name_of(variable.name, variable.id), by = name_of(factor.name, factor.id);
    if (!check.why.empty()) {
      lines.push_back(fmt::format("{} by {}, {}: {}", name, by, check.test, check.why));
      continue;
    }
    table.rows.push_back({name, by, check.of, check.test,
                          fmt::format("{} = {}", check.statistic, fixed_text(check.value, 3)),
                          p_cell(check.p)});
  }
  table.notes = {
      "A small P speaks against the assumption. Shapiro and Wilk (1965), Levene (1960), Mauchly "
      "(1940)."};
  page.heading("Assumptions");
  page.table(table);
  page.list(lines);
}

}  // namespace icome::apps
