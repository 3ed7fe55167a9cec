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

/// What a test says, in the words of `icome stats`. All numbers are finite.
struct TestResult {
  std::string test;       // "repeated measures ANOVA"
  std::string statistic;  // "F", "t", "χ²"; empty: the test has p only
  double value = 0.0;
  std::vector<double> df;  // none, one, or those of effect and error
  double p = 1.0;          // with df, Greenhouse and Geisser's where sphericity is asked for
  std::string effect;      // "partial η²"; empty: none
  double effect_size = 0.0;
  std::optional<stats::ConfidenceInterval> effect_interval;
  double confidence = 0.95;  // of the interval
  std::size_t people = 0;    // that count
  double direction = 0.0;  // of two levels: above 0 where the first tends to greater values, below 0 to less
  std::string counts;      // what was counted, of tests without a statistic: "16 old, 6 new, 0 ties"
  std::vector<std::string> doubts;  // why not to take it at its word: clauses that may follow "but"
  std::vector<std::string> notes;
};

/// A test, or the sentence that says why there is none.
struct Tested {
  std::optional<TestResult> result;
  std::string why;
};

struct ControlSummary {
  std::size_t variable = 0;                                 // of Study::control
  std::optional<stats::Description> numbers;                // of interval and ratio variables
  std::vector<std::pair<std::string, std::size_t>> counts;  // of the others, by the names of levels
};

/// An order of conditions, and how many people had it.
struct OrderUse {
  std::size_t group = 0;
  std::vector<std::size_t> conditions;
  std::size_t people = 0;
};

struct ParticipantSummary {
  std::size_t people = 0, complete = 0;
  std::vector<std::size_t> by_group, complete_by_group;  // of crossings(study, true)
  std::vector<ControlSummary> control;
  std::vector<OrderUse> orders;                         // that occur
  std::size_t trials = 0, not_completed = 0;            // measured
  std::vector<std::size_t> not_completed_by_condition;  // of crossings(study, false)
};

/// Two levels of a factor, compared by a t-test.
struct LevelComparison {
  std::size_t first = 0, second = 0;
  double p = 1.0;  // adjusted after Holm for all pairs of the factor
};

/// A variable in a table as the thesis's 6.1, 6.2, 6.4 and 6.5.
struct ResultRow {
  std::size_t variable = 0;                   // of Study::dependent
  bool total = false;                         // over all trials and people; otherwise means of people's means
  std::vector<std::optional<double>> levels;  // in the variable's unit
  Tested test;
  std::size_t people = 0;              // who have a number in every condition
  std::size_t outliers = 0;            // of them, who have |z| > 2 at a level
  Tested without_outliers;             // where there are any
  std::vector<LevelComparison> pairs;  // of a factor of more than two levels, but for levels of nobody
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
  std::string why;  // there are none; otherwise empty
};

/// How the people's means of quantities go together (table 6.3).
struct CorrelationTable {
  std::vector<std::size_t> variables;  // of Study::dependent
  Eigen::MatrixXd r, p;                // NaN where there is none
  Eigen::MatrixXi counts;
};

/// What was answered to a question.
struct QuestionSummary {
  ItemPlace place;
  std::size_t dependent = 0;                               // of Study::dependent; their number: of none
  std::vector<std::string> answers;                        // names of choices, or points
  std::vector<std::string> columns;                        // names of conditions, or one empty name
  std::vector<std::vector<std::size_t>> counts;            // [column][answer]
  std::vector<std::optional<stats::Description>> numbers;  // of ratings and numbers, by column
  std::vector<std::pair<std::string, std::string>> texts;  // open answers: who (and in what condition), what
  Tested test;  // choices: equal shares; ratings: no difference between conditions. Neither: why is empty
};

enum class Decision : std::uint8_t { NotComputed, NotShown, Shown, Opposite };

struct HypothesisResult {
  std::size_t hypothesis = 0;  // of Study::hypotheses
  Tested test;
  std::optional<double> p_holm;  // which decides: over all hypotheses that were tested, less the primary one
  bool primary = false;          // its own p decides, which p_holm is then
  bool held_back = false;        // not shown for the sole reason that the primary hypothesis is not
  std::optional<TestResult> beside;  // Hypothesis::beside, where it finds the difference too; decides nothing
  std::optional<bool> as_expected;   // what the test found has the direction that was given
  bool one_sided = false;
  Decision decision = Decision::NotComputed;
};

/// Whether a test of means rests on solid ground.
struct AssumptionCheck {
  std::size_t variable = 0, factor = 0;
  std::string test;       // "Shapiro-Wilk"
  std::string of;         // what it would speak against: "differences are normal", "groups vary alike"
  std::string statistic;  // "W", "F"
  double value = 0.0, p = 1.0;
  std::string why;  // there is no result; otherwise empty
};

/// All that a report tells of the data. Indices are those of the study's own lists.
struct Analysis {
  ParticipantSummary participants;
  std::vector<ResultTable> tables;
  std::vector<VarianceAnalysis> variances;  // of measured variables, where there are several factors
  CorrelationTable correlations;
  std::vector<QuestionSummary> questions;  // all of the study
  std::vector<HypothesisResult> hypotheses;
  std::vector<AssumptionCheck> checks;
  std::vector<std::string> warnings;  // sentences
};

/// Works out what the data of a study say. People are the units: means are of people's means, and a person
/// counts in a test who has a number in every condition. Never fails: what cannot be computed (too few
/// people, no variance, a test that does not fit its variables) says why.
Analysis analyse(const StudyData& data);

}  // namespace icome::study
