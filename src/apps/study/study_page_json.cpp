#include <cmath>

#include "apps/stats/stats_json.h"
#include "apps/study/study_page_parts.h"
#include "study/definition/conditions.h"

namespace icome::apps {
namespace {

StatsJson interval_json(const study::TestResult& test) {
  if (!test.effect_interval) return nullptr;
  return {test.effect_interval->low, test.effect_interval->high};
}

/// The members of a test; where there is none, nulls and the member "why".
StatsJson test_json(const study::Tested& tested) {
  if (!tested.result)
    return {{"test", nullptr},   {"statistic", nullptr}, {"df", StatsJson::array()},     {"p", nullptr},
            {"effect", nullptr}, {"effect_ci", nullptr}, {"doubts", StatsJson::array()}, {"why", tested.why}};
  const study::TestResult& test = *tested.result;
  StatsJson json = {{"test", test.test},
                    {"statistic", test.statistic.empty() ? StatsJson(nullptr) : StatsJson(test.value)},
                    {"statistic_name", test.statistic},
                    {"df", test.df},
                    {"p", test.p},
                    {"effect", test.effect.empty() ? StatsJson(nullptr) : StatsJson(test.effect_size)},
                    {"effect_name", test.effect},
                    {"effect_ci", interval_json(test)},
                    {"confidence", test.confidence},
                    {"people", test.people},
                    {"counts", test.counts.empty() ? StatsJson(nullptr) : StatsJson(test.counts)},
                    {"doubts", test.doubts},
                    {"notes", test.notes},
                    {"why", nullptr}};
  return json;
}

StatsJson participants_json(const study::StudyData& data, const study::ParticipantSummary& people) {
  StatsJson groups = StatsJson::array(), control = StatsJson::array();
  for (std::size_t i = 0; i < people.by_group.size(); ++i)
    groups.push_back(
        {{"group", study::crossing_name(data.study, true, study::crossings(data.study, true)[i])},
         {"people", people.by_group[i]},
         {"complete", people.complete_by_group[i]}});
  for (const study::ControlSummary& summary : people.control) {
    StatsJson one = {{"id", data.study.control[summary.variable].id}};
    if (summary.numbers)
      one.append({{"n", summary.numbers->n},
                  {"mean", summary.numbers->mean},
                  {"sd", summary.numbers->standard_deviation},
                  {"least", summary.numbers->minimum},
                  {"most", summary.numbers->maximum}});
    StatsJson counts = StatsJson::object();
    for (std::size_t i = 0; i < summary.counts.size(); ++i)
      counts[data.study.control[summary.variable].levels[i].id] = summary.counts[i].second;
    if (!summary.counts.empty()) one["counts"] = counts;
    control.push_back(one);
  }
  return {{"people", people.people},
          {"complete", people.complete},
          {"incomplete", people.people - people.complete},
          {"groups", groups},
          {"control", control},
          {"trials", people.trials},
          {"trials_not_completed", people.not_completed}};
}

StatsJson pairs_json(const study::IndependentVariable& factor, const study::ResultRow& row) {
  StatsJson pairs = StatsJson::array();
  for (const study::LevelComparison& pair : row.pairs)
    pairs.push_back({{"first", factor.levels[pair.first].id},
                     {"second", factor.levels[pair.second].id},
                     {"p_holm", pair.p}});
  return pairs;
}

StatsJson row_json(const study::Study& study, const study::ResultTable& table, const study::ResultRow& row) {
  StatsJson levels = StatsJson::object();
  for (std::size_t i = 0; i < row.levels.size(); ++i)
    levels[study.independent[table.factor].levels[i].id] =
        row.levels[i] ? StatsJson(*row.levels[i]) : StatsJson(nullptr);
  StatsJson json = {{"variable", study.dependent[row.variable].id},
                    {"unit", study::measured_unit(study.dependent[row.variable]).name},
                    {"sum", row.total ? "total" : "mean"},
                    {"levels", levels},
                    {"people", row.people}};
  json.append(test_json(row.test));
  json["outliers"] = row.outliers;
  json["p_without_outliers"] =
      row.without_outliers.result ? StatsJson(row.without_outliers.result->p) : StatsJson(nullptr);
  json["pairs"] = pairs_json(study.independent[table.factor], row);
  return json;
}

/// Names the factor of a table, the trials that it is of, and the level of another factor that it keeps to.
template <typename Table>
StatsJson table_head_json(const study::Study& study, const Table& table) {
  StatsJson head = {{"factor", study.independent[table.factor].id},
                    {"trials", table.trials == study::TrialChoice::All ? "all" : "last"}};
  if (table.within_level) {
    const study::IndependentVariable& other = study.independent[table.within_level->first];
    head["only"] = StatsJson{{other.id, other.levels[table.within_level->second].id}};
  }
  return head;
}

StatsJson tables_json(const study::StudyData& data, const study::Analysis& analysis) {
  StatsJson tables = StatsJson::array();
  for (const study::ResultTable& table : analysis.tables) {
    StatsJson rows = StatsJson::array();
    for (const study::ResultRow& row : table.rows) rows.push_back(row_json(data.study, table, row));
    StatsJson one = table_head_json(data.study, table);
    one["rows"] = rows;
    tables.push_back(one);
  }
  return tables;
}

StatsJson variances_json(const study::StudyData& data, const study::Analysis& analysis) {
  StatsJson all = StatsJson::array();
  for (const study::VarianceAnalysis& variance : analysis.variances) {
    StatsJson terms = StatsJson::array();
    for (const study::AnalysisTerm& term : variance.terms) {
      StatsJson factors = StatsJson::array();
      for (const std::size_t factor : term.factors) factors.push_back(data.study.independent[factor].id);
      StatsJson one = {{"factors", factors}};
      one.append(test_json(term.test));
      terms.push_back(one);
    }
    StatsJson one = {{"variable", data.study.dependent[variance.variable].id}, {"terms", terms}};
    if (!variance.why.empty()) one["why"] = variance.why;
    all.push_back(one);
  }
  return all;
}

StatsJson correlations_json(const study::StudyData& data, const study::CorrelationTable& found) {
  StatsJson pairs = StatsJson::array();
  for (std::size_t i = 0; i < found.variables.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      pairs.push_back({{"first", data.study.dependent[found.variables[k]].id},
                       {"second", data.study.dependent[found.variables[i]].id},
                       {"r", found.r(Eigen::Index(i), Eigen::Index(k))},
                       {"p", found.p(Eigen::Index(i), Eigen::Index(k))},
                       {"people", found.counts(Eigen::Index(i), Eigen::Index(k))}});
  return pairs;
}

StatsJson thesis_row_json(const study::Study& study, const study::ThesisTable& table,
                          const study::ThesisRow& row) {
  StatsJson levels = StatsJson::object();
  for (std::size_t i = 0; i < row.levels.size(); ++i)
    levels[study.independent[table.factor].levels[i].id] =
        row.levels[i] ? StatsJson(*row.levels[i]) : StatsJson(nullptr);
  StatsJson json = {{"variable", study.dependent[row.variable].id},
                    {"unit", study::measured_unit(study.dependent[row.variable]).name},
                    {"sum", row.total ? "total" : "mean"},
                    {"levels", levels},
                    {"trials", row.trials}};
  json.append({{"test", row.test.result ? StatsJson(row.test.result->test) : StatsJson(nullptr)},
               {"f", row.test.result ? StatsJson(row.test.result->value) : StatsJson(nullptr)},
               {"df", row.test.result ? StatsJson(row.test.result->df) : StatsJson::array()},
               {"p", row.test.result ? StatsJson(row.test.result->p) : StatsJson(nullptr)},
               {"why", row.test.result ? StatsJson(nullptr) : StatsJson(row.test.why)}});
  return json;
}

/// The choices by level, and whether their shares of wrong ones differ; null where errors are not measured.
StatsJson choices_json(const study::Study& study, const study::ThesisTable& table) {
  if (table.choices.empty()) return nullptr;
  StatsJson levels = StatsJson::object();
  for (std::size_t i = 0; i < table.choices.size(); ++i)
    levels[study.independent[table.factor].levels[i].id] =
        StatsJson{{"choices", table.choices[i].choices}, {"wrong", table.choices[i].wrong}};
  return {{"levels", levels},
          {"p", table.choices_test.result ? StatsJson(table.choices_test.result->p) : StatsJson(nullptr)}};
}

/// Tables 6.1 to 6.5 in the form of the thesis: trials are the observations.
StatsJson thesis_json(const study::StudyData& data, const study::Analysis& analysis) {
  StatsJson tables = StatsJson::array(), correlations = StatsJson::array();
  for (const study::ThesisTable& table : analysis.thesis_tables) {
    StatsJson rows = StatsJson::array();
    for (const study::ThesisRow& row : table.rows) rows.push_back(thesis_row_json(data.study, table, row));
    StatsJson one = table_head_json(data.study, table);
    one["rows"] = rows;
    one["choices"] = choices_json(data.study, table);
    tables.push_back(one);
  }
  const study::ThesisCorrelations& found = analysis.thesis_correlations;
  for (std::size_t i = 0; i < found.variables.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      correlations.push_back({{"first", data.study.dependent[found.variables[k]].id},
                              {"second", data.study.dependent[found.variables[i]].id},
                              {"r", found.r(Eigen::Index(i), Eigen::Index(k))},
                              {"trials", found.counts(Eigen::Index(i), Eigen::Index(k))}});
  return {{"tables", tables}, {"correlations", correlations}};
}

StatsJson questions_json(const study::StudyData& data, const study::Analysis& analysis) {
  StatsJson questions = StatsJson::array();
  for (const study::QuestionSummary& question : analysis.questions) {
    const study::Questionnaire& questionnaire = data.study.questionnaires[question.place.questionnaire];
    StatsJson one = {{"questionnaire", questionnaire.id},
                     {"question", questionnaire.items[question.place.item].id},
                     {"columns", question.columns},
                     {"answers", question.answers},
                     {"counts", question.counts}};
    one["result"] = test_json(question.test);
    questions.push_back(one);
  }
  return questions;
}

StatsJson hypothesis_results_json(const study::StudyData& data, const study::Analysis& analysis) {
  StatsJson hypotheses = StatsJson::array();
  for (const study::HypothesisResult& result : analysis.hypotheses) {
    const study::Hypothesis& hypothesis = data.study.hypotheses[result.hypothesis];
    StatsJson one = {{"id", hypothesis.id}};
    one.append(test_json(result.test));
    one["p_holm"] = result.p_holm ? StatsJson(*result.p_holm) : StatsJson(nullptr);
    one["alpha"] = hypothesis.alpha;
    one["primary"] = result.primary;
    one["held_back"] = result.held_back;
    one["beside"] = result.beside ? test_json({result.beside, {}}) : StatsJson(nullptr);
    one["one_sided"] = result.one_sided;
    one["as_expected"] = result.as_expected ? StatsJson(*result.as_expected) : StatsJson(nullptr);
    one["decision"] = decision_text(result.decision);
    one["conclusion"] = conclusion_text(data.study, result);
    hypotheses.push_back(one);
  }
  return hypotheses;
}

StatsJson checks_json(const study::StudyData& data, const study::Analysis& analysis) {
  StatsJson checks = StatsJson::array();
  for (const study::AssumptionCheck& check : analysis.checks) {
    StatsJson one = {{"variable", data.study.dependent[check.variable].id},
                     {"factor", data.study.independent[check.factor].id},
                     {"test", check.test},
                     {"of", check.of}};
    if (check.why.empty())
      one.append({{"statistic", check.value}, {"p", check.p}});
    else
      one["why"] = check.why;
    checks.push_back(one);
  }
  return checks;
}

}  // namespace

std::string study_page_json(const study::StudyData& data, const study::Analysis& analysis) {
  StatsJson json = {{"study", data.study.name},
                    {"simulated", data.simulated},
                    {"participants", participants_json(data, analysis.participants)},
                    {"tables", tables_json(data, analysis)},
                    {"analyses", variances_json(data, analysis)},
                    {"correlations", correlations_json(data, analysis.correlations)},
                    {"thesis", thesis_json(data, analysis)},
                    {"questions", questions_json(data, analysis)},
                    {"hypotheses", hypothesis_results_json(data, analysis)},
                    {"checks", checks_json(data, analysis)},
                    {"warnings", analysis.warnings}};
  return json.text();
}

}  // namespace icome::apps
