#include "stats/models/post_hoc.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "stats/models/studentized_range.h"
#include "stats/tables/sample_check.h"
#include "stats/tables/sums.h"
#include "stats/tests/t_tests.h"
#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

std::optional<base::Error> design_complaint(const MeansToCompare& design, double confidence) {
  constexpr std::string_view kName = "Tukey's test";
  if (auto error = confidence_complaint(kName, confidence)) return error;
  if (design.means.size() != design.counts.size())
    return base::Error{"Tukey's test: give a count for each mean"};
  if (design.means.size() > 1000) return base::Error{"Tukey's test: give at most 1000 means"};
  if (auto error = complaint(kName, "the list of means", design.means, 2)) return error;
  if (auto error = complaint(kName, "the list of counts", design.counts, 2)) return error;
  if (*std::min_element(design.counts.begin(), design.counts.end()) <= 0.0)
    return base::Error{"Tukey's test: a count is not above 0; leave out levels without values"};
  if (!(design.residual_ms > 0.0 && std::isfinite(design.residual_ms)))
    return base::Error{"Tukey's test: there is no variance within the groups; look at the means instead"};
  if (!(design.residual_df >= 1.0))
    return base::Error{"Tukey's test: no degree of freedom is left for the error; give more values"};
  return std::nullopt;
}

// The means and counts of groups, with their pooled variance as the error. Fails where that is zero.
base::Result<MeansToCompare> within_groups(std::string_view test,
                                           const std::vector<std::vector<double>>& groups) {
  if (auto error = complaint(test, groups, 1)) return tl::unexpected(*error);
  MeansToCompare design;
  double squares = 0.0, largest_mean = 0.0;
  for (const auto& group : groups) {
    design.means.push_back(mean(group));
    design.counts.push_back(static_cast<double>(group.size()));
    squares += squared_deviations(group);
    design.residual_df += design.counts.back() - 1.0;
    largest_mean = std::max(largest_mean, std::abs(design.means.back()));
  }
  if (design.residual_df < 1.0)
    return base::fail(fmt::format("{}: each group has a single value; give more", test));
  design.residual_ms = squares / design.residual_df;
  // Equal values leave no more than this by rounding.
  constexpr double kRounding = 10.0 * std::numeric_limits<double>::epsilon();
  if (!std::isfinite(squares))
    return base::fail(
        fmt::format("{}: the values are too large to square; give them in a larger unit", test));
  if (!(std::sqrt(design.residual_ms) > kRounding * largest_mean))
    return base::fail(
        fmt::format("{}: there is no variance within the groups; look at the means instead", test));
  return design;
}

std::vector<PairComparison> all_pairs(const std::vector<double>& means) {
  std::vector<PairComparison> pairs;
  for (std::size_t first = 0; first < means.size(); ++first) {
    for (std::size_t second = first + 1; second < means.size(); ++second) {
      PairComparison pair;
      pair.first = first;
      pair.second = second;
      pair.difference = means[second] - means[first];
      pairs.push_back(pair);
    }
  }
  return pairs;
}

base::Result<std::vector<PairComparison>> pooled_pairs(const std::vector<std::vector<double>>& groups,
                                                       double confidence) {
  const auto design = within_groups("pairwise t-tests", groups);
  if (!design) return tl::unexpected(design.error());
  std::vector<PairComparison> pairs = all_pairs(design->means);
  const double widest = t_quantile(0.5 + 0.5 * confidence, design->residual_df);
  for (PairComparison& pair : pairs) {
    const double counts = 1.0 / design->counts[pair.first] + 1.0 / design->counts[pair.second];
    const double error = std::sqrt(design->residual_ms * counts);
    pair.df = design->residual_df;
    pair.statistic = pair.difference / error;
    pair.interval = {pair.difference - widest * error, pair.difference + widest * error};
    pair.p = t_p(pair.statistic, pair.df, Alternative::TwoSided);
  }
  return pairs;
}

base::Result<std::vector<PairComparison>> separate_pairs(const std::vector<std::vector<double>>& groups,
                                                         PairwiseError error, double confidence) {
  if (auto wrong = complaint("pairwise t-tests", groups, 2)) return tl::unexpected(*wrong);
  TTestSettings settings;
  settings.confidence = confidence;
  std::vector<PairComparison> pairs = all_pairs(std::vector<double>(groups.size(), 0.0));
  for (PairComparison& pair : pairs) {
    const auto& first = groups[pair.first];
    const auto& second = groups[pair.second];
    const auto test = error == PairwiseError::Paired ? paired_t_test(second, first, settings)
                                                     : welch_t_test(second, first, settings);
    if (!test)
      return base::fail(
          fmt::format("groups {} and {}: {}", pair.first + 1, pair.second + 1, test.error().message));
    pair.difference = test->difference;
    pair.statistic = test->t;
    pair.df = test->df;
    pair.interval = test->interval;
    pair.p = test->p;
  }
  return pairs;
}

void adjust(std::vector<PairComparison>& pairs, Adjustment adjustment) {
  if (adjustment == Adjustment::None) return;
  std::vector<double> p_values;
  for (const PairComparison& pair : pairs) p_values.push_back(pair.p);
  const std::vector<double> adjusted = adjustment == Adjustment::Holm ? holm(p_values) : bonferroni(p_values);
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].p = adjusted[i];
}

// The places of the p values that are not NaN, in ascending order of p.
std::vector<std::size_t> ascending_places(std::span<const double> p_values) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < p_values.size(); ++i)
    if (!std::isnan(p_values[i])) places.push_back(i);
  std::sort(places.begin(), places.end(),
            [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  return places;
}

}  // namespace

std::vector<double> holm(std::span<const double> p_values) {
  std::vector<double> adjusted(p_values.begin(), p_values.end());
  const std::vector<std::size_t> places = ascending_places(p_values);
  double greatest = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto left = static_cast<double>(places.size() - i);
    greatest = std::max(greatest, std::min(1.0, left * p_values[places[i]]));
    adjusted[places[i]] = greatest;
  }
  return adjusted;
}

std::vector<double> bonferroni(std::span<const double> p_values) {
  std::vector<double> adjusted(p_values.begin(), p_values.end());
  const std::vector<std::size_t> places = ascending_places(p_values);
  for (const std::size_t place : places)
    adjusted[place] = std::min(1.0, static_cast<double>(places.size()) * p_values[place]);
  return adjusted;
}

base::Result<std::vector<PairComparison>> tukey_hsd(const MeansToCompare& design, double confidence) {
  if (auto error = design_complaint(design, confidence)) return tl::unexpected(*error);
  const auto groups = static_cast<double>(design.means.size());
  const double widest = studentized_range_quantile(confidence, groups, design.residual_df);
  std::vector<PairComparison> pairs = all_pairs(design.means);
  for (PairComparison& pair : pairs) {
    const double counts = 1.0 / design.counts[pair.first] + 1.0 / design.counts[pair.second];
    const double error = std::sqrt(0.5 * design.residual_ms * counts);
    pair.df = design.residual_df;
    pair.statistic = pair.difference / error;
    pair.interval = {pair.difference - widest * error, pair.difference + widest * error};
    pair.p = studentized_range_above(std::abs(pair.statistic), groups, design.residual_df);
  }
  return pairs;
}

base::Result<std::vector<PairComparison>> tukey_hsd(const std::vector<std::vector<double>>& groups,
                                                    double confidence) {
  const auto design = within_groups("Tukey's test", groups);
  if (!design) return tl::unexpected(design.error());
  return tukey_hsd(*design, confidence);
}

base::Result<std::vector<PairComparison>> pairwise_t_tests(const std::vector<std::vector<double>>& groups,
                                                           Adjustment adjustment, PairwiseError error,
                                                           double confidence) {
  if (auto wrong = confidence_complaint("pairwise t-tests", confidence)) return tl::unexpected(*wrong);
  auto pairs = error == PairwiseError::Pooled ? pooled_pairs(groups, confidence)
                                              : separate_pairs(groups, error, confidence);
  if (pairs) adjust(*pairs, adjustment);
  return pairs;
}

}  // namespace icome::stats
