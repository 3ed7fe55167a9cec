#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/stats/stats_data.h"
#include "apps/stats/stats_report.h"
#include "apps/stats/stats_text.h"
#include "base/parse_number.h"
#include "base/utf8.h"
#include "stats/tests/binomial_test.h"
#include "stats/tests/contingency.h"
#include "stats/tests/fisher_exact.h"

namespace icome::apps {
namespace {

/// Counts with the names of what was counted.
struct Counted {
  std::string row_factor, column_factor;
  std::vector<std::string> rows, columns;  // one row for a goodness of fit
  stats::CountTable counts;
  std::string source;
  std::vector<std::string> warnings;
};

std::string_view take_until(std::string_view& text, char end) {
  const std::size_t length = std::min(text.find(end), text.size());
  const std::string_view taken = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  return taken;
}

/// Reads counts such as "63,180/16,180".
base::Result<Counted> counts_in_words(std::string_view text) {
  Counted result;
  result.source = "--counts";
  result.row_factor = "row";
  result.column_factor = "column";
  while (!text.empty()) {
    std::string_view line = take_until(text, '/');
    std::vector<double> row;
    do {
      const std::string_view cell = take_until(line, ',');
      const auto count = base::parse_finite(cell);
      if (!count)
        return base::fail(fmt::format("--counts: {} is no count; write 63,180/16,180: rows parted by /.",
                                      stats::quoted_cell(cell)));
      row.push_back(*count);
    } while (!line.empty());
    result.counts.push_back(std::move(row));
  }
  if (result.counts.empty()) return base::fail("--counts is empty; write 63,180/16,180: rows parted by /.");
  if (result.counts.size() == 1) result.column_factor = "category";
  for (const auto& row : result.counts)
    if (row.size() != result.counts.front().size())
      return base::fail("--counts: all rows must have as many counts; write 63,180/16,180.");
  for (std::size_t i = 0; i < result.counts.size(); ++i) result.rows.push_back(std::to_string(i + 1));
  for (std::size_t i = 0; i < result.counts.front().size(); ++i)
    result.columns.push_back(std::to_string(i + 1));
  return result;
}

base::Result<Counted> counts_in_table(const stats::DataTable& table, const StatsOptions& options) {
  const std::vector<std::string>& names = options.factors.empty() ? options.columns : options.factors;
  if (names.empty() || names.size() > 2) return tl::unexpected(missing_option(table, "one or two --factor"));
  std::vector<stats::Factor> factors;
  for (const std::string& name : names) {
    auto factor = factor_column(table, name, options);
    if (!factor) return tl::unexpected(factor.error());
    factors.push_back(std::move(*factor));
  }
  std::vector<double> weights(table.rows(), 1.0);
  if (!options.weight.empty()) {
    auto column = number_column(table, options.weight);
    if (!column) return tl::unexpected(column.error());
    weights = std::move(*column);
  }
  Counted result;
  result.source = table.source();
  const bool two = factors.size() == 2;
  const stats::Factor& last = factors.back();
  result.row_factor = two ? factors[0].name : std::string();
  result.column_factor = last.name;
  result.rows = two ? factors[0].levels : std::vector<std::string>{"count"};
  result.columns = last.levels;
  if (result.rows.size() * result.columns.size() > 1'000'000)
    return base::fail(fmt::format(
        "{}: more than a million combinations of levels; are these nominal columns?", table.source()));
  result.counts.assign(result.rows.size(), std::vector<double>(result.columns.size(), 0.0));
  std::size_t missing = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const int i = two ? factors[0].of[row] : 0, k = last.of[row];
    if (i == stats::kNoLevel || k == stats::kNoLevel || std::isnan(weights[row])) {
      ++missing;
      continue;
    }
    result.counts[std::size_t(i)][std::size_t(k)] += weights[row];
  }
  if (missing > 0)
    result.warnings.push_back(fmt::format("{} left out: missing.", count_text(missing, "row")));
  return result;
}

base::Result<Counted> read_counts(const StatsOptions& asked) {
  if (!asked.counts.empty()) return counts_in_words(asked.counts);
  StatsOptions options = asked;
  const auto table = open_table(options);
  if (!table) return tl::unexpected(table.error());
  return counts_in_table(*table, options);
}

std::string counts_text(const Counted& counted) {
  std::vector<std::string> headings = {counted.row_factor};
  headings.insert(headings.end(), counted.columns.begin(), counted.columns.end());
  headings.emplace_back("total");
  TextTable table(headings);
  for (std::size_t i = 0; i < counted.rows.size(); ++i) {
    std::vector<std::string> row = {counted.rows[i]};
    double total = 0.0;
    for (const double count : counted.counts[i]) {
      row.push_back(fmt::format("{:g}", count));
      total += count;
    }
    row.push_back(fmt::format("{:.10g}", total));
    table.add(std::move(row));
  }
  return table.text();
}

StatsJson names_json(const std::vector<std::string>& names) {
  StatsJson json = StatsJson::array();
  for (const std::string& name : names) json.push_back(base::as_utf8(name));
  return json;
}

double total_of(const Counted& counted) {
  double total = 0.0;
  for (const auto& row : counted.counts)
    for (const double count : row) total += count;
  return total;
}

base::Result<StatsReport> counts_report(const Counted& counted, StatsJson json, const std::string& name,
                                        const std::string& sentence, const StatsOptions& options) {
  StatsReport report;
  report.warnings = counted.warnings;
  report.json = std::move(json);
  report.json["n"] = total_of(counted);
  report.json["rows"] = names_json(counted.rows);
  report.json["columns"] = names_json(counted.columns);
  report.json["observed"] = counted.counts;
  report.text = fmt::format("{}\n\n{}\n  {}\n", name, counts_text(counted), sentence);
  if (options.plot.empty()) return report;
  const auto kind = chart_kind(options, {ChartKind::Shares});
  if (!kind) return tl::unexpected(kind.error());
  StatsChart chart;
  chart.kind = *kind;
  chart.title = fmt::format("{}: {}", name, sentence);
  // One bar for each row, divided by columns; for a goodness of fit one for each column.
  const bool one = counted.rows.size() == 1;
  chart.groups = one ? counted.columns : counted.rows;
  chart.x_label = one ? counted.column_factor : counted.row_factor;
  chart.y_label = one ? "count" : "share";
  chart.series = one ? std::vector<std::string>{""} : counted.columns;
  chart.series_label = one ? "" : counted.column_factor;
  chart.values.assign(chart.series.size(), std::vector<std::vector<double>>(chart.groups.size()));
  for (std::size_t i = 0; i < counted.rows.size(); ++i)
    for (std::size_t k = 0; k < counted.columns.size(); ++k)
      chart.values[one ? 0 : k][one ? k : i] = {counted.counts[i][k]};
  report.chart = std::move(chart);
  return report;
}

/// Gives rows and columns the same levels in the same order, also those that only one of them has.
void make_square(Counted& counted) {
  std::vector<std::string> levels = counted.rows;
  for (const std::string& name : counted.columns)
    if (std::ranges::find(levels, name) == levels.end()) levels.push_back(name);
  const auto place = [&](const std::string& name) {
    return std::size_t(std::ranges::find(levels, name) - levels.begin());
  };
  stats::CountTable counts(levels.size(), std::vector<double>(levels.size(), 0.0));
  for (std::size_t i = 0; i < counted.rows.size(); ++i)
    for (std::size_t k = 0; k < counted.columns.size(); ++k)
      counts[place(counted.rows[i])][place(counted.columns[k])] = counted.counts[i][k];
  counted.rows = counted.columns = levels;
  counted.counts = std::move(counts);
}

stats::Alternative counts_alternative(const StatsOptions& options) {
  if (options.alternative == "less") return stats::Alternative::Less;
  return options.alternative == "greater" ? stats::Alternative::Greater : stats::Alternative::TwoSided;
}

void add_expected(StatsJson& json, const stats::ChiSquared& test) {
  json["w"] = test.w;
  json["expected"] = test.expected;
  json["residuals"] = test.residuals;
}

}  // namespace

base::Result<StatsReport> report_binomial(const StatsOptions& options) {
  const auto counted = read_counts(options);
  if (!counted) return tl::unexpected(counted.error());
  if (counted->counts.size() != 1 || counted->counts.front().size() != 2)
    return base::fail(fmt::format("{}: a binomial test counts two kinds of one --factor, and there are {}.",
                                  counted->source, counted->counts.size() * counted->counts.front().size()));
  stats::BinomialTestSettings settings;
  settings.probability = options.share;
  settings.confidence = options.confidence;
  settings.alternative = counts_alternative(options);
  const double first = counted->counts[0][0], total = first + counted->counts[0][1];
  const auto test = stats::binomial_test(first, total, settings);
  if (!test) return base::fail(fmt::format("{}: {}", counted->source, test.error().message));
  StatsJson json = {{"test", "binomial"},
                    {"alternative", options.alternative},
                    {"share", test->share},
                    {"null_share", options.share},
                    {"p", test->p},
                    {"confidence", options.confidence},
                    {"interval", {test->interval.low, test->interval.high}}};
  const std::string sentence = fmt::format(
      "{:.10g} of {:.10g} are {}: share {}, {} CI [{}, {}], against {:g} {}", first, total,
      counted->columns.front(), share_text(test->share), percent_text(options.confidence),
      share_text(test->interval.low), share_text(test->interval.high), options.share, p_text(test->p));
  return counts_report(*counted, std::move(json), "Binomial test", sentence, options);
}

base::Result<StatsReport> report_chi_squared(const StatsOptions& options) {
  auto counted = read_counts(options);
  if (!counted) return tl::unexpected(counted.error());
  const bool fit = counted->counts.size() == 1;
  if (!fit && !options.expected.empty())
    return base::fail("--expected is for the counts of one variable, and there are two.");
  stats::Contingency result;
  if (fit) {
    const auto test = stats::goodness_of_fit(counted->counts.front(), options.expected);
    if (!test) return base::fail(fmt::format("{}: {}", counted->source, test.error().message));
    static_cast<stats::ChiSquared&>(result) = *test;
  } else {
    auto test =
        stats::contingency_test(counted->counts, options.yates ? stats::Yates::On : stats::Yates::Off);
    if (!test) return base::fail(fmt::format("{}: {}", counted->source, test.error().message));
    result = std::move(*test);
  }
  StatsJson json = {{"test", fit ? "chi-squared goodness of fit" : "chi-squared"},
                    {"chi_squared", result.chi_squared},
                    {"df", result.df},
                    {"p", result.p}};
  add_expected(json, result);
  if (!fit) json["cramers_v"] = result.cramers_v;
  if (!result.warning.empty()) counted->warnings.push_back(result.warning);
  const std::string sentence =
      fmt::format("\u03c7\u00b2({}, N = {:g}) = {}, {}, {} = {}", df_text(result.df), total_of(*counted),
                  fixed_text(result.chi_squared, 2), p_text(result.p), fit ? "w" : "Cram\u00e9r's V",
                  share_text(fit ? result.w : result.cramers_v));
  const std::string name =
      fit ? fmt::format("Chi-squared test of goodness of fit{}",
                        options.expected.empty() ? ", equal shares" : "")
          : fmt::format("Chi-squared test of independence{}", options.yates ? ", Yates's correction" : "");
  return counts_report(*counted, std::move(json), name, sentence, options);
}

base::Result<StatsReport> report_fisher(const StatsOptions& options) {
  const auto counted = read_counts(options);
  if (!counted) return tl::unexpected(counted.error());
  const bool two_by_two = counted->counts.size() == 2 && counted->counts.front().size() == 2;
  StatsJson json = {{"test", "Fisher's exact test"}};
  std::string sentence;
  if (two_by_two) {
    stats::FisherExactSettings settings;
    settings.confidence = options.confidence;
    settings.alternative = counts_alternative(options);
    const auto test = stats::fisher_exact_2x2(counted->counts, settings);
    if (!test) return base::fail(fmt::format("{}: {}", counted->source, test.error().message));
    json["alternative"] = options.alternative;
    json["p"] = test->p;
    json["odds_ratio"] = test->odds_ratio;
    json["confidence"] = options.confidence;
    json["interval"] = {test->interval.low, test->interval.high};
    sentence = fmt::format("{}, odds ratio {}, {} CI {}", p_text(test->p), fixed_text(test->odds_ratio, 2),
                           percent_text(options.confidence),
                           interval_text(test->interval.low, test->interval.high, 2));
  } else {
    const auto p = stats::fisher_exact_p(counted->counts);
    if (!p) return base::fail(fmt::format("{}: {}", counted->source, p.error().message));
    json["p"] = *p;
    sentence = p_text(*p);
  }
  return counts_report(*counted, std::move(json), "Fisher's exact test", sentence, options);
}

base::Result<StatsReport> report_mcnemar(const StatsOptions& options) {
  auto counted = read_counts(options);
  if (!counted) return tl::unexpected(counted.error());
  make_square(*counted);
  const auto test =
      stats::mcnemar_test(counted->counts, options.yates ? stats::Yates::On : stats::Yates::Off);
  if (!test) return base::fail(fmt::format("{}: {}", counted->source, test.error().message));
  const bool corrected = options.yates && counted->counts.size() == 2;
  StatsJson json = {{"test", "McNemar"},
                    {"chi_squared", test->chi_squared},
                    {"df", test->df},
                    {"p", test->p},
                    {"yates", corrected},
                    {"exact_p", test->exact_p},
                    {"odds_ratio", test->odds_ratio}};
  std::string sentence = fmt::format("\u03c7\u00b2({}, N = {:g}) = {}, {}", df_text(test->df),
                                     total_of(*counted), fixed_text(test->chi_squared, 2), p_text(test->p));
  if (!std::isnan(test->exact_p)) sentence += fmt::format("; exact {}", p_text(test->exact_p));
  return counts_report(*counted, std::move(json),
                       corrected ? "McNemar's test, Yates's correction" : "McNemar's test", sentence,
                       options);
}

}  // namespace icome::apps
