#pragma once
#include <string>
#include <vector>

#include "apps/stats/stats_report.h"
#include "stats/tables/data_table.h"
#include "stats/tables/factor.h"

namespace icome::apps {

/// What an analysis of variance is asked about.
struct FactorialData {
  std::string response;
  std::vector<double> values;          // NaN: missing
  std::vector<stats::Factor> factors;  // between subjects
  std::vector<stats::Factor> within;   // within subjects
  stats::Factor subject;               // where there are such
};

/// The columns that the options name. Fails when one is not there or is named twice.
base::Result<FactorialData> read_factorial(const stats::DataTable& table, const StatsOptions& options);

/// One value a person and cell, the mean of theirs, as the analysis of repeated measures takes them. What
/// lacks a value, a level or a person is left out.
FactorialData people_means(const FactorialData& data);

/// Means and their intervals by cell, to text and JSON ("cells"). Of data with factors within subjects, which
/// are people_means(), within-subject intervals too (Cousineau 2005, Morey 2008), group by group.
void add_cells(StatsReport& report, const FactorialData& data, double confidence);

/// Brown and Forsythe's, Levene's and Shapiro and Wilk's tests, to text and JSON ("assumptions"). Residuals
/// are values less their cell's mean, for a model with all interactions, and less what the subject is above
/// the mean where there are subjects.
void add_assumptions(StatsReport& report, const FactorialData& data, bool full_model);

/// The values by factors, without a title: boxes of one factor, else lines of means. With factors within
/// subjects the intervals of means are within-subject ones.
base::Result<StatsChart> factorial_chart(const FactorialData& data, const StatsOptions& options);

}  // namespace icome::apps
