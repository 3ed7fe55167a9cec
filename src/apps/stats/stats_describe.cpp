#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "apps/stats/stats_data.h"
#include "apps/stats/stats_report.h"
#include "apps/stats/stats_text.h"
#include "base/utf8.h"
#include "io/new_file.h"
#include "stats/tables/descriptives.h"

namespace icome::apps {
namespace {

using stats::Description;

constexpr std::size_t kMostNamedOutliers = 10;
constexpr std::size_t kMostModes = 3;

/// A column, or its part that belongs to a level of --factor.
struct Described {
  std::string name;
  std::vector<double> values;     // NaN: missing
  std::vector<std::size_t> at;    // lines of the file
  std::vector<std::size_t> rows;  // of the table
  std::size_t column = 0;         // index of its column among those described
};

StatsJson description_json(const Description& it) {
  return {{"n", it.n},
          {"missing", it.missing},
          {"mean", it.mean},
          {"median", it.median},
          {"modes", it.modes},
          {"sd", it.standard_deviation},
          {"variance", it.variance},
          {"minimum", it.minimum},
          {"lower_quartile", it.lower_quartile},
          {"upper_quartile", it.upper_quartile},
          {"maximum", it.maximum},
          {"skewness", it.skewness},
          {"excess_kurtosis", it.excess_kurtosis},
          {"standard_error", it.standard_error},
          {"confidence", it.confidence},
          {"mean_interval", {it.mean_low, it.mean_high}}};
}

std::string modes_text(const Description& it, int decimals) {
  if (it.modes.empty()) return "none";
  if (it.modes.size() > kMostModes) return fmt::format("{} values", it.modes.size());
  std::string text;
  for (const double mode : it.modes) text += (text.empty() ? "" : ", ") + fixed_text(mode, decimals);
  return text;
}

base::Result<std::vector<Described>> columns_to_describe(const stats::DataTable& table,
                                                         const StatsOptions& options) {
  std::vector<std::string> names = options.columns;
  if (!options.response.empty()) names.push_back(options.response);
  if (names.empty())
    for (const stats::Column& column : table.columns())
      if (table.numeric(column)) names.push_back(column.name());
  if (names.empty()) return tl::unexpected(missing_option(table, "a --column of numbers"));
  std::vector<Described> all;
  for (const std::string& name : names) {
    auto values = number_column(table, name);
    if (!values) return tl::unexpected(values.error());
    Described described{name, std::move(*values), {}, {}, all.size()};
    for (std::size_t row = 0; row < table.rows(); ++row) {
      described.at.push_back(table.line(row));
      described.rows.push_back(row);
    }
    all.push_back(std::move(described));
  }
  return all;
}

/// Splits each column by the levels of the factor.
std::vector<Described> parted(const std::vector<Described>& columns, const stats::Factor& factor) {
  std::vector<Described> all;
  for (const Described& column : columns) {
    const std::size_t first = all.size();
    for (const std::string& level : factor.levels)
      all.push_back({columns.size() > 1 ? fmt::format("{}, {}", column.name, level) : level,
                     {},
                     {},
                     {},
                     column.column});
    for (std::size_t row = 0; row < column.values.size(); ++row) {
      if (factor.of[row] == stats::kNoLevel) continue;
      Described& part = all[first + std::size_t(factor.of[row])];
      part.values.push_back(column.values[row]);
      part.at.push_back(column.at[row]);
      part.rows.push_back(row);
    }
  }
  return all;
}

/// The tables that describe prints, and its outliers.
struct DescribeTables {
  TextTable centre{{"", "n", "missing", "mean", "SD", "CI of the mean", "mode"}};
  TextTable spread{{"", "minimum", "quartile", "median", "quartile", "maximum", "skewness"}};
  std::string outliers;
};

void add_outliers(DescribeTables& tables, StatsJson& json, const Described& described,
                  const stats::OutlierReport& report) {
  json["outliers"] = StatsJson::array();
  const double sd = report.with.standard_deviation;
  std::string named;
  for (std::size_t i = 0; i < report.outliers.size(); ++i) {
    const std::size_t at = report.outliers[i];
    const double z = (described.values[at] - report.with.mean) / sd;
    json["outliers"].push_back({{"line", described.at[at]}, {"value", described.values[at]}, {"z", z}});
    if (i < kMostNamedOutliers)
      named += fmt::format("{}{} (line {}, z = {})", named.empty() ? "" : ", ",
                           figure(described.values[at], 4), described.at[at], fixed_text(z, 2));
  }
  if (report.outliers.size() > kMostNamedOutliers)
    named += fmt::format(" and {} more", report.outliers.size() - kMostNamedOutliers);
  json["without_outliers"] = report.without ? description_json(*report.without) : StatsJson(nullptr);
  if (report.outliers.empty()) return;
  tables.outliers += fmt::format("  {}: {}\n", described.name, named);
  if (!report.without) return;
  const int decimals = decimals_for(sd);
  tables.outliers += fmt::format("    without: n = {}, mean {}, SD {}; with: n = {}, mean {}, SD {}\n",
                                 report.without->n, fixed_text(report.without->mean, decimals),
                                 fixed_text(report.without->standard_deviation, decimals), report.with.n,
                                 fixed_text(report.with.mean, decimals), fixed_text(sd, decimals));
}

void add_description(DescribeTables& tables, const std::string& name, const Description& it) {
  const int decimals = decimals_for(it.standard_deviation);
  tables.centre.add({name, std::to_string(it.n), std::to_string(it.missing), fixed_text(it.mean, decimals),
                     fixed_text(it.standard_deviation, decimals),
                     interval_text(it.mean_low, it.mean_high, decimals), modes_text(it, decimals)});
  tables.spread.add({name, fixed_text(it.minimum, decimals), fixed_text(it.lower_quartile, decimals),
                     fixed_text(it.median, decimals), fixed_text(it.upper_quartile, decimals),
                     fixed_text(it.maximum, decimals), fixed_text(it.skewness, 2)});
}

base::Result<StatsChart> describe_chart(const std::vector<Described>& all, const StatsOptions& options) {
  const auto kind = chart_kind(options, {ChartKind::Box, ChartKind::Bars});
  if (!kind) return tl::unexpected(kind.error());
  Samples samples;
  samples.factor = options.factors.empty() ? "column" : options.factors.front();
  samples.response = all.size() == 1 ? all.front().name : "value";
  const std::size_t columns = options.columns.size() + (options.response.empty() ? 0U : 1U);
  if (!options.factors.empty() && columns == 1)
    samples.response = options.columns.empty() ? options.response : options.columns.front();
  for (const Described& described : all) {
    samples.names.push_back(described.name);
    samples.values.push_back(described.values);
    std::erase_if(samples.values.back(), [](double value) { return std::isnan(value); });
  }
  StatsChart chart = chart_of_samples(samples, *kind, options.confidence);
  std::size_t count = 0;
  for (const std::vector<double>& values : samples.values) count += values.size();
  chart.title = count_text(count, "value");
  return chart;
}

/// The text of a cell, in quotation marks where a table with that separator needs them.
std::string table_cell(std::string_view text, char separator) {
  const bool plain = text.find_first_of("\"\r\n") == std::string_view::npos &&
                     text.find(separator) == std::string_view::npos && !text.starts_with(' ') &&
                     !text.ends_with(' ');
  if (plain) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) cell.append(c == '"' ? 2 : 1, c);
  return cell + '"';
}

/// The wanted heading, numbered if a column has it already.
std::string free_heading(const std::string& wanted, const std::vector<std::string>& taken) {
  std::string heading = wanted;
  for (int i = 2; std::ranges::find(taken, heading) != taken.end(); ++i)
    heading = fmt::format("{} ({})", wanted, i);
  return heading;
}

/// A column of z scores for each described column, NaN where there is none.
std::vector<std::vector<double>> z_columns(const stats::DataTable& table, const std::vector<Described>& all,
                                           std::size_t columns, std::vector<std::string>& warnings) {
  std::vector<std::vector<double>> scores(
      columns, std::vector<double>(table.rows(), std::numeric_limits<double>::quiet_NaN()));
  for (const Described& described : all) {
    const auto z = stats::z_scores(described.values);
    if (!z) {
      warnings.push_back(fmt::format("{} has no z scores: {}.", described.name, z.error().message));
      continue;
    }
    for (std::size_t i = 0; i < z->size(); ++i) scores[described.column][described.rows[i]] = (*z)[i];
  }
  return scores;
}

/// Writes the table as it was read, with the z scores beside it.
base::Result<void> add_z_scores(StatsReport& report, const stats::DataTable& table,
                                const std::vector<Described>& all, const std::vector<std::string>& names,
                                const std::filesystem::path& out) {
  auto file = io::NewFile::create(out);
  if (!file) return tl::unexpected(file.error());
  const bool comma = table.decimal_comma() && out.extension() == ".csv";
  const char separator = out.extension() == ".tsv" ? '\t' : (comma ? ';' : ',');
  const std::vector<std::vector<double>> scores = z_columns(table, all, names.size(), report.warnings);
  std::vector<std::string> headings;
  for (const stats::Column& column : table.columns()) headings.push_back(column.name());
  report.json["z_columns"] = StatsJson::array();
  for (const std::string& name : names) {
    headings.push_back(free_heading(fmt::format("z of {}", name), headings));
    report.json["z_columns"].push_back(base::as_utf8(headings.back()));
  }
  std::string line;
  const auto end_line = [&] {
    line.back() = '\n';
    file->write(line);
    line.clear();
  };
  for (const std::string& heading : headings) line += table_cell(heading, separator) + separator;
  end_line();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (const stats::Column& column : table.columns())
      line += table_cell(column.cell(row), separator) + separator;
    for (const std::vector<double>& of : scores) {
      std::string number = std::isnan(of[row]) ? std::string() : fmt::format("{}", of[row]);
      if (comma) std::ranges::replace(number, '.', ',');
      line += number + separator;
    }
    end_line();
  }
  report.text += fmt::format("\nz scores: {} in {}\n",
                             fmt::join(std::span(headings).last(names.size()), ", "), out.string());
  return file->finish();
}

}  // namespace

base::Result<StatsReport> report_describe(const StatsOptions& asked) {
  StatsOptions options = asked;
  const auto table = open_table(options);
  if (!table) return tl::unexpected(table.error());
  auto all = columns_to_describe(*table, options);
  if (!all) return tl::unexpected(all.error());
  std::vector<std::string> columns;
  for (const Described& described : *all) columns.push_back(described.name);
  if (options.factors.size() > 1) return base::fail("describe takes one --factor at most.");
  if (!options.factors.empty()) {
    const auto factor = factor_column(*table, options.factors.front(), options);
    if (!factor) return tl::unexpected(factor.error());
    all = parted(*all, *factor);
  }
  StatsReport report;
  report.json = {{"test", "describe"}, {"columns", StatsJson::array()}};
  DescribeTables tables;
  for (const Described& described : *all) {
    const auto outliers = stats::describe_outliers(described.values, 2.0, options.confidence);
    if (!outliers)
      return base::fail(fmt::format("{}: {}: {}", table->source(), described.name, outliers.error().message));
    StatsJson json = {{"name", base::as_utf8(described.name)}};
    json.append(description_json(outliers->with));
    add_description(tables, described.name, outliers->with);
    add_outliers(tables, json, described, *outliers);
    report.json["columns"].push_back(std::move(json));
  }
  report.text = fmt::format("{}, {}\n\n{}\n{}", table->source(), count_text(table->rows(), "row"),
                            tables.centre.text(), tables.spread.text());
  report.text += fmt::format("\nOutliers, more than 2 SD from the mean\n{}",
                             tables.outliers.empty() ? std::string("  none\n") : tables.outliers);
  if (!options.z_table.empty()) {
    if (const auto written = add_z_scores(report, *table, *all, columns, options.z_table); !written)
      return tl::unexpected(written.error());
  }
  if (options.plot.empty()) return report;
  auto chart = describe_chart(*all, options);
  if (!chart) return tl::unexpected(chart.error());
  report.chart = std::move(*chart);
  return report;
}

}  // namespace icome::apps
