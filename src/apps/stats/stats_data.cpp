#include "apps/stats/stats_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "apps/stats/stats_text.h"
#include "io/file_bytes.h"
#include "stats/tables/sums.h"
#include "stats/tables/table_reader.h"

namespace icome::apps {
namespace {

constexpr std::uint64_t kLargestDataFile = 4ULL << 30U;  // bytes

base::Result<std::vector<double>> finite_column(const stats::DataTable& table, const std::string& name,
                                                std::vector<std::string>& warnings) {
  auto values = number_column(table, name);
  if (!values) return values;
  const std::size_t missing = std::erase_if(*values, [](double value) { return std::isnan(value); });
  if (missing > 0)
    warnings.push_back(fmt::format("{} of {} left out: missing.", count_text(missing, "value"), name));
  return values;
}

Samples between_columns(const StatsOptions& options) {
  Samples samples;
  samples.response = "value";
  samples.factor = "column";
  samples.names = options.columns;
  return samples;
}

/// Response and factor, row by row.
struct LongForm {
  std::vector<double> values;
  stats::Factor factor;
};

base::Result<LongForm> read_long_form(const stats::DataTable& table, const StatsOptions& options) {
  if (options.response.empty()) return tl::unexpected(missing_option(table, "--response or two --column"));
  const std::vector<std::string>& named = options.factors.empty() ? options.within : options.factors;
  if (named.size() != 1) return tl::unexpected(missing_option(table, "one --factor"));
  auto values = number_column(table, options.response);
  if (!values) return tl::unexpected(values.error());
  auto factor = factor_column(table, named.front(), options);
  if (!factor) return tl::unexpected(factor.error());
  return LongForm{std::move(*values), std::move(*factor)};
}

/// The values of a person in each group: sums and counts, to average.
struct PersonCells {
  std::vector<double> sum;
  std::vector<std::size_t> count;
};

void tell_of_people(Samples& samples, std::size_t incomplete, bool averaged, const std::string& subject) {
  if (incomplete > 0)
    samples.warnings.push_back(fmt::format("{} of {} left out: without a value in every group.",
                                           count_text(incomplete, "level"), subject));
  if (averaged)
    samples.warnings.push_back(fmt::format("Several values of one {} in a group were averaged.", subject));
}

base::Result<Samples> matched_by_subject(const stats::DataTable& table, const StatsOptions& options) {
  const auto data = read_long_form(table, options);
  if (!data) return tl::unexpected(data.error());
  if (options.subject.empty())
    return tl::unexpected(missing_option(table, "--subject, whose values belong together,"));
  const auto subject = factor_column(table, options.subject, options);
  if (!subject) return tl::unexpected(subject.error());
  const std::size_t groups = data->factor.levels.size();
  std::vector<PersonCells> people(subject->levels.size(),
                                  {std::vector<double>(groups), std::vector<std::size_t>(groups)});
  bool averaged = false;
  for (std::size_t row = 0; row < data->values.size(); ++row) {
    const int person = subject->of[row], group = data->factor.of[row];
    if (person == stats::kNoLevel || group == stats::kNoLevel || std::isnan(data->values[row])) continue;
    PersonCells& cells = people[std::size_t(person)];
    cells.sum[std::size_t(group)] += data->values[row];
    averaged = ++cells.count[std::size_t(group)] > 1 || averaged;
  }
  Samples samples;
  samples.response = options.response;
  samples.factor = data->factor.name;
  samples.names = data->factor.levels;
  samples.values.resize(groups);
  std::size_t incomplete = 0;
  for (const PersonCells& cells : people) {
    if (std::ranges::count(cells.count, std::size_t{0}) > 0) {
      ++incomplete;
      continue;
    }
    for (std::size_t i = 0; i < groups; ++i)
      samples.values[i].push_back(cells.sum[i] / double(cells.count[i]));
  }
  tell_of_people(samples, incomplete, averaged, options.subject);
  return samples;
}

base::Result<Samples> matched_by_row(const stats::DataTable& table, const StatsOptions& options) {
  std::vector<std::vector<double>> columns;
  for (const std::string& name : options.columns) {
    auto values = number_column(table, name);
    if (!values) return tl::unexpected(values.error());
    columns.push_back(std::move(*values));
  }
  Samples samples = between_columns(options);
  samples.values.resize(columns.size());
  std::size_t incomplete = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (std::ranges::any_of(columns, [&](const auto& column) { return std::isnan(column[row]); })) {
      ++incomplete;
      continue;
    }
    for (std::size_t i = 0; i < columns.size(); ++i) samples.values[i].push_back(columns[i][row]);
  }
  if (incomplete > 0)
    samples.warnings.push_back(
        fmt::format("{} left out: without a value in every column.", count_text(incomplete, "row")));
  return samples;
}

/// The factor with its levels in that order, which names each once.
stats::Factor reordered(stats::Factor factor, const std::vector<int>& order) {
  std::vector<int> place(factor.levels.size());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[std::size_t(order[i])] = int(i);
    names.push_back(factor.levels[std::size_t(order[i])]);
  }
  factor.levels = std::move(names);
  for (int& level : factor.of)
    if (level != stats::kNoLevel) level = place[std::size_t(level)];
  return factor;
}

/// The levels in the order in which they appear in the data.
std::vector<int> levels_of_data(const stats::Factor& factor) {
  std::vector<int> order;
  std::vector<bool> seen(factor.levels.size());
  for (const int level : factor.of) {
    if (level == stats::kNoLevel || seen[std::size_t(level)]) continue;
    seen[std::size_t(level)] = true;
    order.push_back(level);
  }
  return order;
}

/// The texts between commas; between quotation marks one may hold commas, and "" is a mark.
std::vector<std::string> parted_by_commas(std::string_view text) {
  std::vector<std::string> parts(1);
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"' && quoted && i + 1 < text.size() && text[i + 1] == '"')
      parts.back() += text[++i];
    else if (text[i] == '"' && (quoted || parts.back().empty()))
      quoted = !quoted;
    else if (text[i] == ',' && !quoted)
      parts.emplace_back();
    else
      parts.back() += text[i];
  }
  return parts;
}

/// The factor with its levels in the order that `told` gives; fails unless that names each of them once.
base::Result<stats::Factor> told_order(const stats::DataTable& table, stats::Factor factor,
                                       std::string_view told) {
  std::string names;
  for (const std::string& level : factor.levels)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", stats::quoted_cell(level));
  const auto wrong = [&](const std::string& what) {
    return base::fail(fmt::format("{}: --levels of {}: {}; name each of these once: {}.", table.source(),
                                  stats::quoted_cell(factor.name), what, names));
  };
  std::vector<int> order;
  for (const std::string& name : parted_by_commas(told)) {
    const auto level = std::ranges::find(factor.levels, name);
    if (level == factor.levels.end()) return wrong(fmt::format("there is no {}", stats::quoted_cell(name)));
    order.push_back(int(level - factor.levels.begin()));
    if (std::ranges::count(order, order.back()) > 1)
      return wrong(fmt::format("{} is there twice", stats::quoted_cell(name)));
  }
  if (order.size() < factor.levels.size())
    return wrong(fmt::format("{} of {} are named", order.size(), factor.levels.size()));
  return reordered(std::move(factor), order);
}

/// Fails where --levels names no factor of the test, which would go unnoticed.
base::Result<void> check_told_levels(const stats::DataTable& table, const StatsOptions& options) {
  std::vector<std::string> used = options.factors;
  used.insert(used.end(), options.within.begin(), options.within.end());
  // Columns are factors in tests of counts; in others they are the groups themselves, in the order given.
  constexpr std::array kCountTests = {"chisq", "fisher", "binomial", "mcnemar"};
  if (std::ranges::find(kCountTests, options.test) != kCountTests.end())
    used.insert(used.end(), options.columns.begin(), options.columns.end());
  for (const std::string& told : options.levels) {
    const auto names = [&](const std::string& name) {
      return told == name ||
             (told.starts_with(name) && told.size() > name.size() && told[name.size()] == '=');
    };
    if (std::ranges::none_of(used, names))
      return base::fail(
          fmt::format("{}: --levels {} names no factor of this test; write --levels "
                      "COLUMN=first,second,... of one of its factors.",
                      table.source(), stats::quoted_cell(told)));
  }
  return {};
}

}  // namespace

base::Result<stats::DataTable> open_table(StatsOptions& options) {
  const auto bytes = io::read_bytes(options.data, kLargestDataFile);
  if (!bytes) return tl::unexpected(bytes.error());
  auto table = stats::read_any_table(*bytes, options.data.string());
  const bool unnamed = options.response.empty() && options.factors.empty() && options.columns.empty();
  if (table && unnamed && stats::is_nist_layout(*bytes) && table->columns().size() > 1) {
    options.response = table->columns().back().name();
    options.factors = {table->columns().front().name()};
  }
  if (table)
    if (const auto told = check_told_levels(*table, options); !told) return tl::unexpected(told.error());
  return table;
}

base::Result<std::vector<double>> number_column(const stats::DataTable& table, const std::string& name) {
  const auto column = table.find(name);
  if (!column) return tl::unexpected(column.error());
  return table.numbers(**column);
}

base::Result<stats::Factor> factor_column(const stats::DataTable& table, const std::string& name,
                                          const StatsOptions& options) {
  const auto column = table.find(name);
  if (!column) return tl::unexpected(column.error());
  stats::Levels levels = table.levels(**column);
  if (levels.names.size() > std::size_t(std::numeric_limits<int>::max()))
    return base::fail(fmt::format("{}: the column {} has too many levels.", table.source(), name));
  stats::Factor factor;
  factor.name = name;
  factor.levels = std::move(levels.names);
  factor.of.reserve(levels.of.size());
  for (const std::size_t level : levels.of)
    factor.of.push_back(level == stats::Levels::kMissing ? stats::kNoLevel : int(level));
  for (const std::string& told : options.levels) {
    if (told == name) return reordered(factor, levels_of_data(factor));
    if (told.starts_with(name) && told.size() > name.size() && told[name.size()] == '=')
      return told_order(table, std::move(factor), told.substr(name.size() + 1));
  }
  return factor;
}

base::Result<Samples> read_samples(const stats::DataTable& table, const StatsOptions& options) {
  Samples samples = between_columns(options);
  if (!options.columns.empty()) {
    for (const std::string& name : options.columns) {
      auto values = finite_column(table, name, samples.warnings);
      if (!values) return tl::unexpected(values.error());
      samples.values.push_back(std::move(*values));
    }
    return samples;
  }
  const auto data = read_long_form(table, options);
  if (!data) return tl::unexpected(data.error());
  samples.response = options.response;
  samples.factor = data->factor.name;
  samples.names = data->factor.levels;
  samples.values.resize(samples.names.size());
  std::size_t missing = 0;
  for (std::size_t row = 0; row < data->values.size(); ++row) {
    const int level = data->factor.of[row];
    if (level == stats::kNoLevel || std::isnan(data->values[row])) {
      ++missing;
      continue;
    }
    samples.values[std::size_t(level)].push_back(data->values[row]);
  }
  if (missing > 0)
    samples.warnings.push_back(
        fmt::format("{} left out: value or group is missing.", count_text(missing, "row")));
  return samples;
}

base::Result<Samples> read_matched_samples(const stats::DataTable& table, const StatsOptions& options) {
  return options.columns.empty() ? matched_by_subject(table, options) : matched_by_row(table, options);
}

StatsChart chart_of_samples(const Samples& samples, ChartKind kind, double confidence) {
  StatsChart chart;
  chart.kind = kind;
  chart.x_label = samples.factor == "column" ? std::string() : samples.factor;
  chart.y_label = samples.response;
  chart.groups = samples.names;
  chart.series = {""};
  chart.values = {samples.values};
  chart.confidence = confidence;
  return chart;
}

base::Result<ChartKind> chart_kind(const StatsOptions& options, const std::vector<ChartKind>& fitting) {
  if (options.plot_kind.empty()) return fitting.front();
  std::string names;
  for (const ChartKind kind : fitting) {
    const char* name = kChartKinds[std::size_t(kind)];
    if (options.plot_kind == name) return kind;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
  }
  return base::fail(fmt::format("--plot-kind {} does not fit what is asked for here; choose from: {}.",
                                options.plot_kind, names));
}

base::Error missing_option(const stats::DataTable& table, const std::string& option) {
  std::string names;
  for (const stats::Column& column : table.columns())
    names += fmt::format("{}{}", names.empty() ? "" : ", ", stats::quoted_cell(column.name()));
  return {fmt::format("{}: give {} by name; the columns are {}.", table.source(), option, names)};
}

}  // namespace icome::apps
