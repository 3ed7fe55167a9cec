#include "apps/stats/stats_factors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "apps/stats/stats_data.h"
#include "apps/stats/stats_text.h"
#include "base/utf8.h"
#include "stats/models/within_intervals.h"
#include "stats/tables/cells.h"
#include "stats/tables/descriptives.h"
#include "stats/tables/sums.h"
#include "stats/tests/assumptions.h"

namespace icome::apps {
namespace {

constexpr std::size_t kMostCellLines = 40;
constexpr std::size_t kMostSeries = 8;

std::vector<stats::Factor> all_factors(const FactorialData& data) {
  std::vector<stats::Factor> all = data.factors;
  all.insert(all.end(), data.within.begin(), data.within.end());
  return all;
}

std::string joined_levels(const std::vector<int>& levels, std::span<const stats::Factor> factors,
                          const char* between) {
  std::string text;
  for (std::size_t i = 0; i < factors.size(); ++i)
    text += (i > 0 ? between : "") + factors[i].levels[std::size_t(levels[i])];
  return text;
}

/// The complete observations, and the cell of each.
struct CellsOfFactors {
  std::vector<double> values;
  std::vector<int> cell;
  std::vector<int> subject;  // empty without subjects
  std::vector<std::vector<int>> combinations;
};

CellsOfFactors cells_of(const FactorialData& data, std::span<const stats::Factor> factors) {
  CellsOfFactors result;
  const std::vector<int> cell = stats::combined_levels(factors, data.values.size(), result.combinations);
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const int subject = data.subject.of.empty() ? 0 : data.subject.of[i];
    if (cell[i] == stats::kNoLevel || subject == stats::kNoLevel || std::isnan(data.values[i])) continue;
    result.values.push_back(data.values[i]);
    result.cell.push_back(cell[i]);
    if (!data.subject.of.empty()) result.subject.push_back(subject);
  }
  return result;
}

/// Subtracts from each value the mean of its group.
void take_means_off(std::vector<double>& values, std::span<const int> group_of) {
  const int groups = group_of.empty() ? 0 : 1 + *std::ranges::max_element(group_of);
  const stats::GroupedValues grouped = stats::grouped(values, group_of, std::size_t(groups));
  std::vector<double> means(std::size_t(groups), 0.0);
  for (std::size_t i = 0; i < means.size(); ++i)
    if (!grouped.group(i).empty()) means[i] = stats::mean(grouped.group(i));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= means[std::size_t(group_of[i])];
}

/// The groups that Levene's test compares: values of each cell between subjects, or the subjects' means.
std::vector<std::vector<double>> groups_between(const FactorialData& data) {
  const CellsOfFactors cells = cells_of(data, data.factors);
  std::vector<std::vector<double>> groups(cells.combinations.size());
  if (cells.subject.empty()) {
    for (std::size_t i = 0; i < cells.values.size(); ++i)
      groups[std::size_t(cells.cell[i])].push_back(cells.values[i]);
  } else {
    const stats::GroupedValues people =
        stats::grouped(cells.values, cells.subject, data.subject.levels.size());
    std::vector<int> cell_of(data.subject.levels.size(), 0);
    for (std::size_t i = 0; i < cells.cell.size(); ++i)
      cell_of[std::size_t(cells.subject[i])] = cells.cell[i];
    for (std::size_t i = 0; i < cell_of.size(); ++i)
      if (!people.group(i).empty()) groups[std::size_t(cell_of[i])].push_back(stats::mean(people.group(i)));
  }
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  return groups;
}

StatsJson variance_json(const base::Result<stats::VarianceTest>& test) {
  if (!test) return nullptr;
  return {{"f", test->statistic}, {"df", test->df}, {"error_df", test->error_df}, {"p", test->p}};
}

const char* verdict(double p) { return p < 0.05 ? "in doubt" : "nothing against it"; }

void add_variances(StatsReport& report, StatsJson& json, const FactorialData& data) {
  if (data.factors.empty()) return;
  const auto groups = groups_between(data);
  const auto median = stats::brown_forsythe_test(groups);
  const auto mean = stats::levene_test(groups);
  json["brown_forsythe"] = variance_json(median);
  json["levene"] = variance_json(mean);
  for (const auto& [test, name] : {std::pair(&median, "Brown-Forsythe"), {&mean, "Levene"}}) {
    report.text +=
        *test ? fmt::format("  equal variances, {}: F({}, {}) = {}, {}; {}\n", name, df_text((*test)->df),
                            df_text((*test)->error_df), fixed_text((*test)->statistic, 2), p_text((*test)->p),
                            verdict((*test)->p))
              : fmt::format("  equal variances, {}: not tested: {}\n", name, test->error().message);
  }
}

void add_normality(StatsReport& report, StatsJson& json, const FactorialData& data) {
  const std::vector<stats::Factor> factors = all_factors(data);
  CellsOfFactors cells = cells_of(data, factors);
  take_means_off(cells.values, cells.cell);
  if (!cells.subject.empty()) take_means_off(cells.values, cells.subject);
  const auto test = stats::shapiro_wilk(cells.values);
  json["shapiro_wilk"] =
      test ? StatsJson{{"w", test->w}, {"p", test->p}, {"n", cells.values.size()}} : StatsJson(nullptr);
  report.text +=
      test ? fmt::format("  normal residuals, Shapiro-Wilk: W = {}, {}; {}\n", share_text(test->w, 3),
                         p_text(test->p), verdict(test->p))
           : fmt::format("  normal residuals, Shapiro-Wilk: not tested: {}\n", test.error().message);
}

/// The observations of people with one in each cell within subjects, less the differences between people and
/// with Morey's growth, group by group; NaN for all others.
std::vector<double> without_people(const FactorialData& data) {
  std::vector<std::vector<int>> groups, columns;
  const std::size_t count = data.values.size();
  const std::vector<int> group =
      data.factors.empty() ? std::vector<int>(count, 0) : stats::combined_levels(data.factors, count, groups);
  const std::vector<int> column = stats::combined_levels(data.within, count, columns);
  // For each group and person, the observation in each column.
  std::map<std::pair<int, int>, std::vector<std::size_t>> people;
  for (std::size_t i = 0; i < count; ++i) {
    if (group[i] == stats::kNoLevel || column[i] == stats::kNoLevel || std::isnan(data.values[i])) continue;
    auto& row = people[{group[i], data.subject.of[i]}];
    row.resize(columns.size(), count);
    row[std::size_t(column[i])] = i;
  }
  std::map<int, std::vector<const std::vector<std::size_t>*>> rows;
  for (const auto& [who, row] : people)
    if (std::ranges::find(row, count) == row.end()) rows[who.first].push_back(&row);
  std::vector<double> moved(count, std::numeric_limits<double>::quiet_NaN());
  for (const auto& [number, of_group] : rows) {
    std::vector<std::vector<double>> values;
    for (const std::vector<std::size_t>* row : of_group) {
      values.emplace_back();
      for (const std::size_t at : *row) values.back().push_back(data.values[at]);
    }
    const auto left = stats::without_person_differences(values);
    if (!left) continue;
    for (std::size_t row = 0; row < of_group.size(); ++row)
      for (std::size_t i = 0; i < of_group[row]->size(); ++i) moved[(*of_group[row])[i]] = (*left)[row][i];
  }
  return moved;
}

/// Descriptions by cell, in the order of describe_cells() of the values themselves: their intervals of means
/// are within-subject ones. Empty where there are no factors within subjects.
std::vector<stats::CellDescription> within_cells(const FactorialData& data,
                                                 std::span<const stats::Factor> factors, double confidence) {
  if (data.within.empty()) return {};
  auto cells = stats::describe_cells(without_people(data), factors, confidence);
  return cells ? std::move(*cells) : std::vector<stats::CellDescription>();
}

StatsJson cell_json(const stats::CellDescription& cell, std::span<const stats::Factor> factors) {
  StatsJson levels = StatsJson::object();
  for (std::size_t i = 0; i < factors.size(); ++i)
    levels[base::as_utf8(factors[i].name)] = base::as_utf8(factors[i].levels[std::size_t(cell.levels[i])]);
  const stats::Description& it = cell.description;
  return {{"levels", levels},
          {"n", it.n},
          {"mean", it.mean},
          {"sd", it.standard_deviation},
          {"mean_interval", {it.mean_low, it.mean_high}}};
}

/// Assigns the observations to the series of a chart.
void set_series(StatsChart& chart, const CellsOfFactors& cells, std::span<const stats::Factor> all,
                std::size_t series_factors) {
  const std::span<const stats::Factor> others = all.subspan(1, series_factors);
  std::vector<std::string> names;
  for (const std::vector<int>& levels : cells.combinations) {
    const std::vector<int> rest(levels.begin() + 1, levels.begin() + 1 + std::ptrdiff_t(series_factors));
    const std::string name = joined_levels(rest, others, ", ");
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  chart.series = std::move(names);
  for (const stats::Factor& factor : others)
    chart.series_label += (chart.series_label.empty() ? "" : ", ") + factor.name;
  chart.values.assign(chart.series.size(), std::vector<std::vector<double>>(chart.groups.size()));
  for (std::size_t i = 0; i < cells.values.size(); ++i) {
    const std::vector<int>& levels = cells.combinations[std::size_t(cells.cell[i])];
    const std::vector<int> rest(levels.begin() + 1, levels.begin() + 1 + std::ptrdiff_t(series_factors));
    const auto series = std::ranges::find(chart.series, joined_levels(rest, others, ", "));
    chart.values[std::size_t(series - chart.series.begin())][std::size_t(levels[0])].push_back(
        cells.values[i]);
  }
}

}  // namespace

base::Result<FactorialData> read_factorial(const stats::DataTable& table, const StatsOptions& options) {
  if (options.response.empty()) return tl::unexpected(missing_option(table, "--response"));
  FactorialData data;
  data.response = options.response;
  auto values = number_column(table, options.response);
  if (!values) return tl::unexpected(values.error());
  data.values = std::move(*values);
  std::set<std::string> used = {options.response};
  const auto take = [&](const std::string& name) -> base::Result<stats::Factor> {
    if (!used.insert(name).second)
      return base::fail(fmt::format("{}: the column {} is named for two roles; name it once.", table.source(),
                                    stats::quoted_cell(name)));
    return factor_column(table, name, options);
  };
  for (const auto& [names, into] :
       {std::pair(&options.factors, &data.factors), {&options.within, &data.within}}) {
    for (const std::string& name : *names) {
      auto factor = take(name);
      if (!factor) return tl::unexpected(factor.error());
      factor->measured = std::ranges::count(options.measured, name) > 0;
      into->push_back(std::move(*factor));
    }
  }
  for (const std::string& name : options.measured)
    if (std::ranges::count(options.factors, name) == 0)
      return base::fail(fmt::format("--measured {} is no --factor of this analysis.", name));
  if (options.subject.empty()) return data;
  auto subject = take(options.subject);
  if (!subject) return tl::unexpected(subject.error());
  data.subject = std::move(*subject);
  return data;
}

FactorialData people_means(const FactorialData& data) {
  std::vector<stats::Factor> by = {data.subject};
  for (const auto* const factors : {&data.factors, &data.within})
    by.insert(by.end(), factors->begin(), factors->end());
  const CellsOfFactors cells = cells_of(data, by);
  const stats::GroupedValues grouped = stats::grouped(cells.values, cells.cell, cells.combinations.size());
  FactorialData means = data;
  means.values.clear();
  std::vector<stats::Factor*> into = {&means.subject};
  for (stats::Factor& factor : means.factors) into.push_back(&factor);
  for (stats::Factor& factor : means.within) into.push_back(&factor);
  for (stats::Factor* const factor : into) factor->of.clear();
  for (std::size_t i = 0; i < cells.combinations.size(); ++i) {
    if (grouped.group(i).empty()) continue;
    means.values.push_back(stats::mean(grouped.group(i)));
    for (std::size_t k = 0; k < into.size(); ++k) into[k]->of.push_back(cells.combinations[i][k]);
  }
  return means;
}

void add_cells(StatsReport& report, const FactorialData& data, double confidence) {
  const std::vector<stats::Factor> factors = all_factors(data);
  const auto cells = stats::describe_cells(data.values, factors, confidence);
  report.json["cells"] = StatsJson::array();
  if (!cells) return;
  std::vector<std::string> headings;
  for (const stats::Factor& factor : factors) headings.push_back(factor.name);
  for (const std::string& heading : {std::string("n"), std::string("mean"), std::string("SD"),
                                     fmt::format("{} CI of the mean", percent_text(confidence))})
    headings.push_back(heading);
  const auto within = within_cells(data, factors, confidence);
  const bool has_within = within.size() == cells->size();
  if (has_within) headings.push_back(fmt::format("within-subject {} CI", percent_text(confidence)));
  TextTable table(headings);
  double least_deviation = std::numeric_limits<double>::infinity();
  for (const stats::CellDescription& cell : *cells)
    if (cell.description.standard_deviation > 0.0)
      least_deviation = std::min(least_deviation, cell.description.standard_deviation);
  const int decimals = decimals_for(least_deviation);
  for (std::size_t i = 0; i < cells->size(); ++i) {
    StatsJson json = cell_json((*cells)[i], factors);
    if (has_within)
      json["within_interval"] = {within[i].description.mean_low, within[i].description.mean_high};
    report.json["cells"].push_back(std::move(json));
    if (i >= kMostCellLines) continue;
    const stats::Description& it = (*cells)[i].description;
    std::vector<std::string> row;
    for (std::size_t k = 0; k < factors.size(); ++k)
      row.push_back(factors[k].levels[std::size_t((*cells)[i].levels[k])]);
    row.insert(row.end(), {std::to_string(it.n), fixed_text(it.mean, decimals),
                           fixed_text(it.standard_deviation, decimals),
                           interval_text(it.mean_low, it.mean_high, decimals)});
    if (has_within)
      row.push_back(interval_text(within[i].description.mean_low, within[i].description.mean_high, decimals));
    table.add(std::move(row));
  }
  report.text += fmt::format("\nMeans\n{}", table.text());
  if (cells->size() > kMostCellLines)
    report.text += fmt::format("  and {} more; --json has all.\n", cells->size() - kMostCellLines);
}

void add_assumptions(StatsReport& report, const FactorialData& data, bool full_model) {
  report.text += "\nAssumptions\n";
  StatsJson json = StatsJson::object();
  add_variances(report, json, data);
  if (full_model)
    add_normality(report, json, data);
  else
    report.text += "  normal residuals: tested with all interactions only\n";
  report.json["assumptions"] = std::move(json);
}

base::Result<StatsChart> factorial_chart(const FactorialData& data, const StatsOptions& options) {
  std::vector<stats::Factor> all = data.within;
  all.insert(all.end(), data.factors.begin(), data.factors.end());
  const bool one = all.size() == 1;
  const auto kind = chart_kind(options, {one ? ChartKind::Box : ChartKind::Interaction,
                                         one ? ChartKind::Interaction : ChartKind::Box, ChartKind::Bars});
  if (!kind) return tl::unexpected(kind.error());
  std::size_t combinations = 1;
  for (std::size_t i = 1; i < all.size(); ++i) combinations *= all[i].levels.size();
  const std::size_t series_factors = combinations <= kMostSeries ? all.size() - 1 : 1;
  StatsChart chart;
  chart.kind = *kind;
  chart.x_label = all.front().name;
  chart.y_label = data.response;
  chart.groups = all.front().levels;
  chart.confidence = options.confidence;
  // The moved values are not independent if a mark pools several cells of each person.
  chart.within_people = !data.within.empty() && *kind != ChartKind::Box && series_factors + 1 == all.size();
  FactorialData drawn = data;
  if (chart.within_people) drawn.values = without_people(data);
  set_series(chart, cells_of(drawn, all), all, series_factors);
  return chart;
}

}  // namespace icome::apps
