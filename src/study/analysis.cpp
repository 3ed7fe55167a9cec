#include "study/analysis.h"

#include "study/analysis_parts.h"

namespace icome::study {

Analysis analyse(const StudyData& data) {
  Analysis analysis;
  analysis.participants = summarise_participants(data);
  analysis.tables = result_tables(data);
  analysis.variances = analyse_variances(data);
  analysis.correlations = correlate_quantities(data);
  analysis.questions = summarise_questions(data);
  analysis.hypotheses = test_hypotheses(data);
  analysis.checks = check_assumptions(data);
  analysis.warnings = warnings_of(data, analysis.participants);
  return analysis;
}

}  // namespace icome::study
