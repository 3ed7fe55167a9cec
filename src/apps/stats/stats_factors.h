#pragma once
#include <string>
#include <vector>

#include "apps/stats/stats_report.h"
#include "stats/tables/data_table.h"
#include "stats/tables/factor.h"

namespace icome::apps {

/// The data of an analysis of variance.
struct FactorialData {
  std::string response;
  std::vector<double> values;          // NaN: missing
  std::vector<stats::Factor> factors;  // between subjects
  std::vector<stats::Factor> within;   // within subjects
  stats::Factor subject;               // of data with subjects
};

/// The columns that the options name. Fails when one is not there or is named twice.
base::Result<FactorialData> read_factorial(const stats::DataTable& table, const StatsOptions& options);

/// One value for each person and cell, their mean, as the analysis of repeated measures takes them.
/// Observations that lack a value, a level or a person are left out.
FactorialData people_means(const FactorialData& data);

/// Adds means and their intervals by cell to text and JSON ("cells"); for data with factors within subjects,
/// which are people_means(), within-subject intervals, too (Cousineau 2005, Morey 2008), group by group.
void add_cells(StatsReport& report, const FactorialData& data, double confidence);

/// Adds Brown and Forsythe's, Levene's and Shapiro and Wilk's tests to text and JSON ("assumptions").
/// Residuals are values less their cell's mean, for a model with all interactions, and, where there are
/// subjects, less their subject's mean residual.
void add_assumptions(StatsReport& report, const FactorialData& data, bool full_model);

/// A chart of the values by factors, without a title: boxes of one factor, else lines of means. With factors
/// within subjects the intervals of means are within-subject ones.
base::Result<StatsChart> factorial_chart(const FactorialData& data, const StatsOptions& options);

}  // namespace icome::apps
