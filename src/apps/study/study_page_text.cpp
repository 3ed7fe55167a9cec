#include <fmt/format.h>

#include "apps/stats/stats_text.h"
#include "apps/study/study_page_parts.h"

namespace icome::apps {
namespace {

std::string hypotheses_table(const study::StudyData& data, const study::Analysis& analysis) {
  if (analysis.hypotheses.empty()) return {};
  TextTable table({"Hypothesis", "Test", "Statistic", "P", "P (Holm)", "Result"});
  for (const study::HypothesisResult& result : analysis.hypotheses) {
    const std::string& id = data.study.hypotheses[result.hypothesis].id;
    if (!result.test.result) {
      table.add({id, "-", "-", "-", "-", decision_text(result.decision)});
      continue;
    }
    const study::TestResult& test = *result.test.result;
    table.add({id, test.test, statistic_text(test), p_cell(test.p),
               result.p_holm ? p_cell(*result.p_holm) : "-",
               decision_text(result.decision) + reservation_text(result)});
  }
  return fmt::format("\n{}  {}\n", table.text(), decision_rule(data.study, analysis));
}

}  // namespace

std::string study_page_text(const study::StudyData& data, const study::Analysis& analysis) {
  const study::ParticipantSummary& people = analysis.participants;
  std::string text =
      fmt::format("{}{}: {} of {} people are through, {} measured.\n", data.simulated ? "SIMULATED. " : "",
                  data.study.name, people.complete, people.people, count_text(people.trials, "trial"));
  text += hypotheses_table(data, analysis);
  std::vector<std::string> notes = analysis.warnings;
  for (const study::HypothesisResult& result : analysis.hypotheses)
    if (!result.test.result)
      notes.push_back(fmt::format("{}: {}", data.study.hypotheses[result.hypothesis].id, result.test.why));
    else if (!result.test.result->doubts.empty() || result.held_back || result.beside)
      notes.push_back(conclusion_text(data.study, result));
  return text + notes_text(notes);
}

}  // namespace icome::apps
