#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stats/tables/descriptives.h"
#include "stats/tests/hypothesis.h"
#include "study/records/trial_table.h"

namespace icome::study {

/// The result of a test, in the words of `icome stats`. All numbers are finite.
struct TestResult {
  std::string test;       // "repeated measures ANOVA"
  std::string statistic;  // "F", "t", "χ²"; empty: the test has p only
  double value = 0.0;
  std::vector<double> df;  // none, one, or those of effect and error
  double p = 1.0;          // with df, Greenhouse and Geisser's where sphericity is required
  std::string effect;      // "partial η²"; empty: none
  double effect_size = 0.0;
  std::optional<stats::ConfidenceInterval> effect_interval;
  double confidence = 0.95;  // of the interval
  std::size_t people = 0;    // used
  double direction = 0.0;  // of two levels: above 0 where the first tends to greater values, below 0 to less
  std::string counts;      // the counts, of tests without a statistic: "16 old, 6 new, 0 ties"
  std::vector<std::string> doubts;  // reasons for caution: clauses that may follow "but"
  std::vector<std::string> notes;
};

/// The result of a test, or a sentence with the reason why there is none.
struct Tested {
  std::optional<TestResult> result;
  std::string why;
};

struct ControlSummary {
  std::size_t variable = 0;                                 // of Study::control
  std::optional<stats::Description> numbers;                // of interval and ratio variables
  std::vector<std::pair<std::string, std::size_t>> counts;  // of the others, by the names of levels
};

/// An order of conditions, with the number of people who had it.
struct OrderUse {
  std::size_t group = 0;
  std::vector<std::size_t> conditions;
  std::size_t people = 0;
};

struct ParticipantSummary {
  std::size_t people = 0, complete = 0;
  std::vector<std::size_t> by_group, complete_by_group;  // of crossings(study, true)
  std::vector<ControlSummary> control;
  std::vector<OrderUse> orders;                         // those that occur
  std::size_t trials = 0, not_completed = 0;            // measured
  std::vector<std::size_t> not_completed_by_condition;  // of crossings(study, false)
};

/// Two levels of a factor, compared by a t-test.
struct LevelComparison {
  std::size_t first = 0, second = 0;
  double p = 1.0;  // adjusted after Holm for all pairs of the factor
};

/// The row of a variable in a table like 6.1, 6.2, 6.4 and 6.5 of the thesis.
struct ResultRow {
  std::size_t variable = 0;                   // of Study::dependent
  bool total = false;                         // over all trials and people; otherwise means of people's means
  std::vector<std::optional<double>> levels;  // in the variable's unit
  Tested test;
  std::size_t people = 0;              // people who have a number in every condition
  std::size_t outliers = 0;            // people among them who have |z| > 2 at a level
  Tested without_outliers;             // if there are any outliers
  std::vector<LevelComparison> pairs;  // of a factor of more than two levels, without levels that nobody has
};

struct ResultTable {
  std::size_t factor = 0;  // of Study::independent
  TrialChoice trials = TrialChoice::All;
  std::optional<std::pair<std::size_t, std::size_t>> within_level;  // of another factor, its level; none: all
  std::vector<ResultRow> rows;
};

/// A row of an analysis of variance: a factor, or an interaction of several.
struct AnalysisTerm {
  std::vector<std::size_t> factors;  // of Study::independent
  Tested test;
};
/// All terms of the analysis of variance of a variable.
struct VarianceAnalysis {
  std::size_t variable = 0;  // of Study::dependent
  std::vector<AnalysisTerm> terms;
  std::string why;  // the reason if there are none; otherwise empty
};

/// The correlations of people's means of quantities (table 6.3).
struct CorrelationTable {
  std::vector<std::size_t> variables;  // of Study::dependent
  Eigen::MatrixXd r, p;                // NaN where there is none
  Eigen::MatrixXi counts;
};

/// A row of a table as the thesis prints it: means over trials, or the total number of errors.
struct ThesisRow {
  std::size_t variable = 0;  // of Study::dependent
  bool total = false;
  std::vector<std::optional<double>> levels;  // in the variable's unit; none: no trials
  std::size_t trials = 0;                     // that have a number
  Tested test;                                // TestResult::people is the number of trials
};

/// The choices at a level of a factor: each completed trial has one that was right.
struct ChoiceCount {
  std::size_t choices = 0, wrong = 0;
};

/// A table in the form of 6.1, 6.2, 6.4 and 6.5 of the thesis: every trial is an observation of its own, as
/// if it were another person's, and all factors are tested as if they were between people. Shown beside the
/// tables of people's means to be compared with the thesis; decides nothing.
struct ThesisTable {
  std::size_t factor = 0;  // of Study::independent
  TrialChoice trials = TrialChoice::All;
  std::optional<std::pair<std::size_t, std::size_t>> within_level;  // of another factor, its level; none: all
  std::vector<ThesisRow> rows;
  std::vector<ChoiceCount> choices;  // by level, where errors are measured; of table 6.5's text
  Tested choices_test;               // do the shares of wrong choices differ? (chi-squared)
};

/// Table 6.3: correlations over trials. NaN where there is none.
struct ThesisCorrelations {
  std::vector<std::size_t> variables;  // of Study::dependent
  Eigen::MatrixXd r;
  Eigen::MatrixXi counts;  // trials
};

/// The answers to a question.
struct QuestionSummary {
  ItemPlace place;
  std::size_t dependent = 0;                               // index of Study::dependent; their number: none
  std::vector<std::string> answers;                        // names of choices, or points
  std::vector<std::string> columns;                        // names of conditions, or one empty name
  std::vector<std::vector<std::size_t>> counts;            // [column][answer]
  std::vector<std::optional<stats::Description>> numbers;  // of ratings and numbers, by column
  std::vector<std::pair<std::string, std::string>> texts;  // open answers: person (and condition), text
  Tested test;  // choices: equal shares; ratings: no difference between conditions. Neither: why is empty
};

enum class Decision : std::uint8_t { NotComputed, NotShown, Shown, Opposite };

struct HypothesisResult {
  std::size_t hypothesis = 0;  // of Study::hypotheses
  Tested test;
  std::optional<double> p_holm;      // decides: adjusted over all tested hypotheses, less the primary one
  bool primary = false;              // its own p decides, and p_holm is that p
  bool held_back = false;            // not shown for the sole reason that the primary hypothesis is not
  std::optional<TestResult> beside;  // Hypothesis::beside, where it finds the difference too; decides nothing
  std::optional<bool> as_expected;   // the test's result has the direction that was given
  bool one_sided = false;
  Decision decision = Decision::NotComputed;
};

/// A check of an assumption of a test of means.
struct AssumptionCheck {
  std::size_t variable = 0, factor = 0;
  std::string test;       // "Shapiro-Wilk"
  std::string of;         // the assumption that it tests: "differences are normal", "groups vary alike"
  std::string statistic;  // "W", "F"
  double value = 0.0, p = 1.0;
  std::string why;  // the reason if there is no result; otherwise empty
};

/// All results that a report presents. Indices are those of the study's own lists.
struct Analysis {
  ParticipantSummary participants;
  std::vector<ResultTable> tables;
  std::vector<VarianceAnalysis> variances;  // of measured variables, where there are several factors
  CorrelationTable correlations;
  std::vector<ThesisTable> thesis_tables;
  ThesisCorrelations thesis_correlations;
  std::vector<QuestionSummary> questions;  // all of the study
  std::vector<HypothesisResult> hypotheses;
  std::vector<AssumptionCheck> checks;
  std::vector<std::string> warnings;  // sentences
};

/// Analyses the data of a study. People are the units: means are of people's means, and the people in a
/// test are those who have a number in every condition. Never fails: a result that cannot be computed (too
/// few people, no variance, a test that does not fit its variables) has the reason in its place.
Analysis analyse(const StudyData& data);

}  // namespace icome::study
