#pragma once
#include <string>
#include <vector>

#include "apps/stats/stats_chart.h"
#include "apps/stats/stats_options.h"
#include "base/result.h"
#include "stats/tables/data_table.h"
#include "stats/tables/factor.h"

namespace icome::apps {

// Converts the table that a person names to the data that tests take.

/// Reads the options' data. In NIST's layout the columns are known: where the options name neither response
/// nor factors, the last column becomes the response and the first the factor.
base::Result<stats::DataTable> open_table(StatsOptions& options);

/// A column's numbers, NaN where one is missing.
base::Result<std::vector<double>> number_column(const stats::DataTable& table, const std::string& name);

/// A column's levels, in the order that --levels gives; else numbers ascending and texts as they come.
base::Result<stats::Factor> factor_column(const stats::DataTable& table, const std::string& name,
                                          const StatsOptions& options);

/// Values of two or more groups.
struct Samples {
  std::string response, factor;             // headings; of several columns "value" and "column"
  std::vector<std::string> names;           // of the groups
  std::vector<std::vector<double>> values;  // by group; without missing ones
  std::vector<std::string> warnings;        // about values left out
};

/// The groups of --response by --factor, or several of --column.
base::Result<Samples> read_samples(const stats::DataTable& table, const StatsOptions& options);

/// As read_samples(), but each value has partners in the other groups: values of one --subject, or of one row
/// where --column names the groups. All groups have equally many values; incomplete ones are left out.
base::Result<Samples> read_matched_samples(const stats::DataTable& table, const StatsOptions& options);

/// Groups for a chart, without its title.
StatsChart chart_of_samples(const Samples& samples, ChartKind kind, double confidence);

/// The kind that --plot-kind names, or the first of `fitting` without it. Fails, listing the fitting kinds.
base::Result<ChartKind> chart_kind(const StatsOptions& options, const std::vector<ChartKind>& fitting);

/// The error "give --response by name" where options lack what a test needs, with the columns there are.
base::Error missing_option(const stats::DataTable& table, const std::string& option);

}  // namespace icome::apps
