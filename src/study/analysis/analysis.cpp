#include "study/analysis/analysis.h"

#include "study/analysis/analysis_parts.h"

namespace icome::study {

namespace {

/// Gives a question the test of a hypothesis that compares two answers to it.
void take_tests_of_hypotheses(const Study& study, Analysis& analysis) {
  for (QuestionSummary& question : analysis.questions) {
    if (question.dependent >= study.dependent.size()) continue;
    for (const HypothesisResult& result : analysis.hypotheses) {
      const Hypothesis& hypothesis = study.hypotheses[result.hypothesis];
      if (hypothesis.test == Test::Binomial && hypothesis.dependent == study.dependent[question.dependent].id)
        question.test = result.test;
    }
  }
}

}  // namespace

Analysis analyse(const StudyData& data) {
  Analysis analysis;
  analysis.participants = summarise_participants(data);
  analysis.tables = result_tables(data);
  analysis.variances = analyse_variances(data);
  analysis.correlations = correlate_quantities(data);
  analysis.thesis_tables = thesis_tables(data);
  analysis.thesis_correlations = thesis_correlations(data);
  analysis.questions = summarise_questions(data);
  analysis.hypotheses = test_hypotheses(data);
  take_tests_of_hypotheses(data.study, analysis);
  analysis.checks = check_assumptions(data);
  analysis.warnings = warnings_of(data, analysis.participants);
  return analysis;
}

}  // namespace icome::study
