#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "stats/models/sphericity.h"
#include "study/analysis/analysis.h"

namespace icome::study {

// The parts of analyse().

ParticipantSummary summarise_participants(const StudyData& data);
std::vector<ResultTable> result_tables(const StudyData& data);
std::vector<VarianceAnalysis> analyse_variances(const StudyData& data);
CorrelationTable correlate_quantities(const StudyData& data);
std::vector<ThesisTable> thesis_tables(const StudyData& data);
ThesisCorrelations thesis_correlations(const StudyData& data);
std::vector<QuestionSummary> summarise_questions(const StudyData& data);
std::vector<HypothesisResult> test_hypotheses(const StudyData& data);
std::vector<AssumptionCheck> check_assumptions(const StudyData& data);
std::vector<std::string> warnings_of(const StudyData& data, const ParticipantSummary& participants);

/// The name in the study's first language, or the id if there is none.
template <typename Named>
std::string plain_name(const Named& named) {
  return named.name.empty() || named.name.front().empty() ? named.id : named.name.front();
}
/// "Click, With forces": names of levels; empty for the empty crossing.
std::string crossing_title(const std::vector<const IndependentVariable*>& factors, const Crossing& crossing);

/// The main effect of a factor by an analysis of variance of all factors of the table with their
/// interactions. Incomplete rows are left out.
base::Result<TestResult> main_effect(const PersonTable& table, const IndependentVariable& factor);
/// A main effect with Mauchly's test, which is there for a within factor of more than two levels.
struct MainEffect {
  TestResult result;
  std::optional<stats::Sphericity> sphericity;
};
base::Result<MainEffect> main_effect_with_sphericity(const PersonTable& table,
                                                     const IndependentVariable& factor);

/// An interaction of the factor with others in that analysis.
struct Interaction {
  std::vector<std::string> factors;  // ids, the factor's among them
  TestResult result;
};
/// The interactions that can be computed; none for a table of one factor.
std::vector<Interaction> interactions_of(const PersonTable& table, const IndependentVariable& factor);

/// The residuals that should be normal in that analysis: of pairs of conditions, the differences of
/// each group less their mean; of more conditions, the rest after people and conditions; of groups,
/// people's means less the group's.
std::vector<double> residuals_of(const PersonTable& table, const IndependentVariable& factor);
/// People's means in each group that has people; with several factors, groups are crossings of their levels.
std::vector<std::vector<double>> means_by_group(const PersonTable& table);

/// All terms of that analysis.
VarianceAnalysis analyse_variance(const Study& study, const PersonTable& table, std::size_t variable);

/// A result without an effect size.
TestResult plain_result(std::string test, std::string statistic, double value, std::vector<double> df,
                        double p, std::size_t people);
Tested tested(base::Result<TestResult> result);

/// Friedman's test of people's values at the levels of a within factor; each level has one value a person.
base::Result<TestResult> friedman_of(const std::vector<std::vector<double>>& levels);
/// Wilcoxon's signed rank test, pair by pair.
base::Result<TestResult> signed_ranks_of(const std::vector<double>& first, const std::vector<double>& second,
                                         stats::Alternative alternative);
/// Are the answers spread evenly?
base::Result<TestResult> even_shares(const std::vector<std::size_t>& counts);

/// The names of the choices, or points of a rating.
std::vector<std::string> answer_names(const Item& item);

/// The number of people who gave each choice, or point of a rating; of several choices each counts.
std::vector<std::size_t> counts_of(const Item& item, const std::vector<std::string>& answers);
/// The noncentral confidence interval (Smithson 2003) of Cohen's w, 0.95, with n answers.
stats::ConfidenceInterval w_interval(double chi_squared, double df, double n);
/// The ids of the choices in an answer, each once.
std::vector<std::string> chosen_ids(const std::string& answer);

}  // namespace icome::study
