#include <fmt/format.h>

#include <cmath>

#include "apps/stats/stats_data.h"
#include "apps/stats/stats_report.h"
#include "apps/stats/stats_text.h"
#include "base/utf8.h"
#include "stats/tests/correlation.h"

namespace icome::apps {
namespace {

constexpr std::size_t kMostCorrelated = 1000;

stats::CorrelationSettings correlation_settings(const StatsOptions& options) {
  stats::CorrelationSettings settings;
  settings.confidence = options.confidence;
  settings.alternative = options.alternative == "less"      ? stats::Alternative::Less
                         : options.alternative == "greater" ? stats::Alternative::Greater
                                                            : stats::Alternative::TwoSided;
  return settings;
}

base::Result<StatsChart> scatter_of(const Samples& pairs, const std::string& title,
                                    const StatsOptions& options) {
  const auto kind = chart_kind(options, {ChartKind::Scatter, ChartKind::Matrix});
  if (!kind) return tl::unexpected(kind.error());
  StatsChart chart;
  chart.kind = *kind;
  chart.title = title;
  chart.x_label = pairs.names[0];
  chart.y_label = pairs.names[1];
  chart.confidence = options.confidence;
  chart.line = options.test == "pearson";
  for (std::size_t i = 0; i < pairs.values[0].size(); ++i)
    chart.points.emplace_back(pairs.values[0][i], pairs.values[1][i]);
  return chart;
}

base::Result<StatsReport> pearson_report(const Samples& pairs, const StatsOptions& options) {
  const auto test = stats::pearson(pairs.values[0], pairs.values[1], correlation_settings(options));
  if (!test) return tl::unexpected(test.error());
  StatsReport report;
  report.json = {{"test", "Pearson"},
                 {"x", base::as_utf8(pairs.names[0])},
                 {"y", base::as_utf8(pairs.names[1])},
                 {"n", pairs.values[0].size()},
                 {"r", test->r},
                 {"t", test->t},
                 {"df", test->df},
                 {"p", test->p},
                 {"confidence", options.confidence},
                 {"interval", {test->interval.low, test->interval.high}},
                 {"critical_r", test->critical_r}};
  const std::string sentence =
      fmt::format("r({}) = {}, {}", df_text(test->df), share_text(test->r), p_text(test->p));
  report.text = fmt::format(
      "Pearson's correlation of {} and {}, {}\n\n  {}, {} CI [{}, {}]\n  critical r: {} ({}, two-sided)\n",
      pairs.names[0], pairs.names[1], count_text(pairs.values[0].size(), "pair"), sentence,
      percent_text(options.confidence), share_text(test->interval.low), share_text(test->interval.high),
      share_text(test->critical_r, 3), percent_text(1.0 - options.confidence));
  if (options.plot.empty()) return report;
  auto chart = scatter_of(pairs, "Pearson's correlation: " + sentence, options);
  if (!chart) return tl::unexpected(chart.error());
  report.chart = std::move(*chart);
  return report;
}

base::Result<StatsReport> spearman_report(const Samples& pairs, const StatsOptions& options) {
  const auto test =
      stats::spearman(pairs.values[0], pairs.values[1], correlation_settings(options).alternative);
  if (!test) return tl::unexpected(test.error());
  StatsReport report;
  report.json = {{"test", "Spearman"},
                 {"x", base::as_utf8(pairs.names[0])},
                 {"y", base::as_utf8(pairs.names[1])},
                 {"n", pairs.values[0].size()},
                 {"rho", test->rho},
                 {"s", test->s},
                 {"p", test->p},
                 {"exact", test->exact}};
  const std::string sentence =
      fmt::format("\u03c1 = {}, {}{}", share_text(test->rho), p_text(test->p), test->exact ? ", exact" : "");
  report.text = fmt::format("Spearman's rank correlation of {} and {}, {}\n\n  {}\n", pairs.names[0],
                            pairs.names[1], count_text(pairs.values[0].size(), "pair"), sentence);
  if (options.plot.empty()) return report;
  auto chart = scatter_of(pairs, "Spearman's correlation: " + sentence, options);
  if (!chart) return tl::unexpected(chart.error());
  report.chart = std::move(*chart);
  return report;
}

/// A square of numbers as JSON.
template <typename Matrix>
StatsJson matrix_json(const Matrix& matrix) {
  StatsJson rows = StatsJson::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    StatsJson row = StatsJson::array();
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) row.push_back(matrix(i, k));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// A correlation as it stands below the diagonal: "-.45***".
std::string starred(double r, double p) {
  return share_text(r) + (p < 0.001 ? "***" : p < 0.01 ? "** " : p < 0.05 ? "*  " : "   ");
}

std::string matrix_text(const std::vector<std::string>& names, const stats::CorrelationMatrix& matrix) {
  std::vector<std::string> headings = {""};
  for (std::size_t i = 0; i < names.size(); ++i) headings.push_back(std::to_string(i + 1) + "   ");
  TextTable table(headings);
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::vector<std::string> row = {fmt::format("{}  {}", i + 1, names[i])};
    for (std::size_t k = 0; k < names.size(); ++k)
      row.push_back(k > i    ? std::string()
                    : k == i ? std::string("1   ")
                             : starred(matrix.r(Eigen::Index(i), Eigen::Index(k)),
                                       matrix.p(Eigen::Index(i), Eigen::Index(k))));
    table.add(std::move(row));
  }
  return table.text() + "\n  * p < .05, ** p < .01, *** p < .001, not adjusted for the number of pairs\n";
}

base::Result<StatsReport> matrix_report(const stats::DataTable& table, const StatsOptions& options) {
  std::vector<std::vector<double>> columns;
  for (const std::string& name : options.columns) {
    auto values = number_column(table, name);
    if (!values) return tl::unexpected(values.error());
    columns.push_back(std::move(*values));
  }
  const bool is_pearson = options.test == "pearson";
  const auto matrix = stats::correlation_matrix(
      columns, is_pearson ? stats::CorrelationKind::Pearson : stats::CorrelationKind::Spearman);
  if (!matrix) return tl::unexpected(matrix.error());
  StatsReport report;
  StatsJson names = StatsJson::array();
  for (const std::string& name : options.columns) names.push_back(base::as_utf8(name));
  report.json = {{"test", is_pearson ? "Pearson" : "Spearman"},
                 {"columns", std::move(names)},
                 {is_pearson ? "r" : "rho", matrix_json(matrix->r)},
                 {"p", matrix_json(matrix->p)},
                 {"n", matrix_json(matrix->counts)}};
  const std::string name = is_pearson ? "Pearson's correlations" : "Spearman's rank correlations";
  report.text = fmt::format("{} of {} columns, {}\n\n{}", name, options.columns.size(),
                            count_text(table.rows(), "row"), matrix_text(options.columns, *matrix));
  const auto fewest = std::size_t(matrix->counts.minCoeff());
  if (fewest < table.rows())
    report.warnings.push_back(fmt::format(
        "Values are missing: each correlation is of the rows that have both, {} at least.", fewest));
  if (options.plot.empty()) return report;
  const auto kind = chart_kind(options, {ChartKind::Matrix});
  if (!kind) return tl::unexpected(kind.error());
  StatsChart chart;
  chart.kind = *kind;
  chart.title = name;
  chart.groups = options.columns;
  chart.matrix = matrix->r;
  chart.p = matrix->p;
  report.chart = std::move(chart);
  return report;
}

}  // namespace

base::Result<StatsReport> report_correlation(const StatsOptions& asked) {
  StatsOptions options = asked;
  const auto table = open_table(options);
  if (!table) return tl::unexpected(table.error());
  if (options.columns.empty())
    for (const stats::Column& column : table->columns())
      if (table->numeric(column)) options.columns.push_back(column.name());
  const std::size_t count = options.columns.size();
  if (count < 2) return tl::unexpected(missing_option(*table, "at least two --column of numbers"));
  if (count > kMostCorrelated)
    return base::fail(fmt::format("{}: {} columns are more than the {} that can be correlated at once.",
                                  table->source(), count, kMostCorrelated));
  const auto with_source = [&](base::Result<StatsReport> report) -> base::Result<StatsReport> {
    if (report || report.error().message.starts_with(table->source())) return report;
    return base::fail(fmt::format("{}: {}", table->source(), report.error().message));
  };
  if (count > 2 || options.plot_kind == "matrix") return with_source(matrix_report(*table, options));
  const auto pairs = read_matched_samples(*table, options);
  if (!pairs) return tl::unexpected(pairs.error());
  auto report = with_source(options.test == "pearson" ? pearson_report(*pairs, options)
                                                      : spearman_report(*pairs, options));
  if (report) report->warnings = pairs->warnings;
  return report;
}

}  // namespace icome::apps
