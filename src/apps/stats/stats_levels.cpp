#include "apps/stats/stats_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/stats/stats_text.h"
#include "base/utf8.h"
#include "stats/models/level_comparisons.h"

namespace icome::apps {
namespace {

using stats::LevelComparisons;
using stats::LevelPair;
using stats::LevelSlice;

constexpr std::size_t kMostRows = 60;  // of a table in text

StatsJson level_pair_json(const LevelComparisons& compared, const LevelPair& pair) {
  StatsJson json = {{"first", base::as_utf8(compared.factor.levels[pair.first])},
                    {"second", base::as_utf8(compared.factor.levels[pair.second])},
                    {"difference", pair.difference},
                    {"t", pair.t},
                    {"df", pair.df},
                    {"interval", {pair.interval.low, pair.interval.high}},
                    {"p", pair.p},
                    {"p_adjusted", pair.p_holm},
                    {"d", pair.d},
                    {"d_interval", {pair.d_interval.low, pair.d_interval.high}}};
  if (!pair.why.empty()) json["why"] = pair.why;
  return json;
}

StatsJson pairs_json_of(const LevelComparisons& compared, const LevelSlice& slice) {
  StatsJson pairs = StatsJson::array();
  for (const LevelPair& pair : slice.pairs) pairs.push_back(level_pair_json(compared, pair));
  return pairs;
}

StatsJson compared_json(const LevelComparisons& compared) {
  return {{"factor", base::as_utf8(compared.factor.name)},
          {"test", compared.within ? "paired t-test" : "Welch's t-test"},
          {"adjustment", "Holm"}};
}

StatsJson slice_json(const LevelComparisons& compared, const LevelSlice& slice) {
  StatsJson at = StatsJson::object();
  for (std::size_t i = 0; i < slice.at.size(); ++i)
    at[base::as_utf8(compared.others[i].name)] =
        base::as_utf8(compared.others[i].levels[std::size_t(slice.at[i])]);
  StatsJson json = {{"at", at},
                    {"subjects", slice.subjects},
                    {"f", slice.f},
                    {"df", slice.df},
                    {"error_df", slice.error_df},
                    {"epsilon", slice.epsilon},
                    {"p", slice.p},
                    {"p_adjusted", slice.p_holm},
                    {"eta_sq", slice.eta_sq},
                    {"comparisons", pairs_json_of(compared, slice)}};
  if (!slice.why.empty()) json["why"] = slice.why;
  return json;
}

/// The levels of the other factors in a slice, a cell each.
std::vector<std::string> at_cells(const LevelComparisons& compared, const LevelSlice& slice) {
  std::vector<std::string> cells;
  for (std::size_t i = 0; i < slice.at.size(); ++i)
    cells.push_back(compared.others[i].levels[std::size_t(slice.at[i])]);
  return cells;
}

std::vector<std::string> other_names(const LevelComparisons& compared, bool sliced) {
  std::vector<std::string> names;
  for (std::size_t i = 0; sliced && i < compared.others.size(); ++i) names.push_back(compared.others[i].name);
  return names;
}

std::string more_text(std::size_t rows) {
  return rows > kMostRows ? fmt::format("  and {} more; --json has all.\n", rows - kMostRows) : std::string();
}

/// Decimals that show the narrowest interval, or the largest difference where there is none.
int decimals_of(const LevelComparisons& compared) {
  double narrowest = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (const LevelSlice& slice : compared.slices) {
    for (const LevelPair& pair : slice.pairs) {
      if (pair.why.empty()) narrowest = std::min(narrowest, pair.interval.high - pair.interval.low);
      if (std::isfinite(pair.difference)) largest = std::max(largest, std::abs(pair.difference));
    }
  }
  return decimals_for(std::isfinite(narrowest) ? narrowest : largest);
}

std::string pairs_table(const LevelComparisons& compared, bool sliced, double confidence) {
  std::vector<std::string> headings = other_names(compared, sliced);
  for (const std::string& heading :
       {std::string(sliced ? compared.factor.name : ""), std::string("difference"),
        fmt::format("{} CI", percent_text(confidence)), std::string("t"), std::string("df"), std::string("p"),
        std::string("p (Holm)"), std::string(compared.within ? "d_z" : "d_s")})
    headings.push_back(heading);
  TextTable table(headings);
  const int decimals = decimals_of(compared);
  std::size_t rows = 0;
  std::string untold;
  for (const LevelSlice& slice : compared.slices) {
    for (const LevelPair& pair : slice.pairs) {
      if (rows++ >= kMostRows) continue;
      const std::string name =
          fmt::format("{} - {}", compared.factor.levels[pair.second], compared.factor.levels[pair.first]);
      std::vector<std::string> row = at_cells(compared, slice);
      row.insert(row.end(), {name, fixed_text(pair.difference, decimals)});
      if (pair.why.empty())
        row.insert(row.end(),
                   {interval_text(pair.interval.low, pair.interval.high, decimals), fixed_text(pair.t, 2),
                    df_text(pair.df), p_cell(pair.p), p_cell(pair.p_holm), fixed_text(pair.d, 2)});
      else
        row.insert(row.end(), {"-", "-", "-", "-", "-", "-"});
      if (!pair.why.empty()) {
        std::string where;
        for (const std::string& cell : at_cells(compared, slice)) where += cell + ", ";
        untold += fmt::format("  {}{}: not tested: {}\n", where, name, pair.why);
      }
      table.add(std::move(row));
    }
  }
  return table.text() + more_text(rows) + untold;
}

std::string effects_table(const LevelComparisons& compared) {
  std::vector<std::string> headings = other_names(compared, true);
  for (const char* const heading : {"n", "F", "df", "error df", "p", "p (Holm)", "\u03b7\u00b2"})
    headings.emplace_back(heading);
  TextTable table(headings);
  std::string untold;
  for (std::size_t i = 0; i < compared.slices.size() && i < kMostRows; ++i) {
    const LevelSlice& slice = compared.slices[i];
    std::vector<std::string> row = at_cells(compared, slice);
    row.push_back(std::to_string(slice.subjects));
    if (slice.why.empty()) {
      row.insert(row.end(), {fixed_text(slice.f, 2), df_text(slice.df), df_text(slice.error_df),
                             p_cell(slice.p), p_cell(slice.p_holm), share_text(slice.eta_sq)});
    } else {
      row.insert(row.end(), {"-", "-", "-", "-", "-", "-"});
      std::string where;
      for (const std::string& cell : at_cells(compared, slice)) where += (where.empty() ? "" : ", ") + cell;
      untold += fmt::format("  {}: not tested: {}\n", where, slice.why);
    }
    table.add(std::move(row));
  }
  return table.text() + more_text(compared.slices.size()) + untold;
}

std::string pairs_title(const LevelComparisons& compared) {
  std::size_t count = 0;
  for (const LevelSlice& slice : compared.slices) count += slice.pairs.size();
  return fmt::format("{} of pairs, after Holm over {}",
                     compared.within ? "paired t-tests" : "Welch's t-tests", count);
}

base::Result<LevelComparisons> compared_levels_of(const FactorialData& data, const std::string& name,
                                                  stats::Slicing slicing, double confidence) {
  return stats::compare_levels(data.values, data.subject, data.within, data.factors, name, slicing,
                               confidence);
}

}  // namespace

base::Result<void> add_level_comparisons(StatsReport& report, const FactorialData& data,
                                         const StatsOptions& options) {
  if (!options.post_hoc.empty()) report.json["post_hoc"] = StatsJson::array();
  for (const std::string& name : options.post_hoc) {
    const auto compared = compared_levels_of(data, name, stats::Slicing::None, options.confidence);
    if (!compared) return tl::unexpected(compared.error());
    report.text += fmt::format("\n{}, averaged over all else: {}\n{}", name, pairs_title(*compared),
                               pairs_table(*compared, false, options.confidence));
    StatsJson json = compared_json(*compared);
    json["comparisons"] = pairs_json_of(*compared, compared->slices.front());
    report.json["post_hoc"].push_back(std::move(json));
  }
  if (!options.simple.empty()) report.json["simple_effects"] = StatsJson::array();
  for (const std::string& name : options.simple) {
    const auto compared = compared_levels_of(data, name, stats::Slicing::EveryOther, options.confidence);
    if (!compared) return tl::unexpected(compared.error());
    if (compared->others.empty())
      return base::fail(
          fmt::format("--simple {}: there is no other factor at whose levels it could be looked "
                      "at; --post-hoc compares its levels",
                      name));
    report.text += fmt::format(
        "\nSimple effects of {}: {}, p after Holm over {}\n{}\n{}, there: {}\n{}", name,
        compared->within ? "repeated measures at each level of the others, df after Greenhouse and Geisser"
                         : "Welch's test at each level of the others",
        compared->slices.size(), effects_table(*compared), name, pairs_title(*compared),
        pairs_table(*compared, true, options.confidence));
    StatsJson json = compared_json(*compared);
    json["effects"] = StatsJson::array();
    for (const LevelSlice& slice : compared->slices) json["effects"].push_back(slice_json(*compared, slice));
    report.json["simple_effects"].push_back(std::move(json));
  }
  return {};
}

}  // namespace icome::apps
