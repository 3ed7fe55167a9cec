#include "stats/tests/rank_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>

#include "stats/tables/sample_check.h"
#include "stats/tests/rank_sums.h"
#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

constexpr std::size_t kExactBelow = 50;
constexpr std::size_t kMostExact = 100;

struct Ranked {
  std::vector<double> ranks;
  double tie_sum = 0.0;  // of t^3 - t over runs of t equal values
  std::size_t ties = 0;  // values in such runs
};

Ranked ranked(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  Ranked result;
  result.ranks.resize(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t i = begin; i < end; ++i)
      result.ranks[order[i]] = 0.5 * static_cast<double>(begin + 1 + end);
    const auto run = static_cast<double>(end - begin);
    result.tie_sum += run * run * run - run;
    if (end - begin > 1) result.ties += end - begin;
    begin = end;
  }
  return result;
}

double rank_sum_of(std::span<const double> all_ranks) {
  return std::accumulate(all_ranks.begin(), all_ranks.end(), 0.0);
}

// Is p to be exact? Fails when it is asked for but cannot be.
base::Result<bool> takes_exact(RankMethod method, std::size_t largest, bool ties_or_zeros) {
  if (method == RankMethod::Approximate) return false;
  if (method == RankMethod::Automatic) return largest < kExactBelow && !ties_or_zeros;
  if (ties_or_zeros)
    return base::fail("rank test: there are ties or zeros, so p cannot be exact; ask for the approximation");
  if (largest > kMostExact)
    return base::fail(
        fmt::format("rank test: p is exact for up to {} values; ask for the approximation", kMostExact));
  return true;
}

double exact_p(const std::vector<double>& distribution, double statistic, Alternative alternative) {
  const double less = share_up_to(distribution, statistic);
  const double greater = share_from(distribution, statistic);
  if (alternative == Alternative::Less) return less;
  if (alternative == Alternative::Greater) return greater;
  return std::min(1.0, 2.0 * std::min(less, greater));
}

double corrected_z(double excess, double sd, const RankTestSettings& settings) {
  double correction = 0.0;
  if (settings.continuity) {
    if (settings.alternative == Alternative::Greater) correction = 0.5;
    if (settings.alternative == Alternative::Less) correction = -0.5;
    if (settings.alternative == Alternative::TwoSided && excess != 0.0)
      correction = std::copysign(0.5, excess);
  }
  return (excess - correction) / sd;
}

std::optional<base::Error> shift_complaint(const RankTestSettings& settings) {
  if (std::isfinite(settings.null_shift)) return std::nullopt;
  return base::Error{"rank test: the shift to test against is not a finite number; give one, such as 0"};
}

}  // namespace

std::vector<double> ranks(std::span<const double> values) { return ranked(values).ranks; }

base::Result<RankTest> rank_sum_test(std::span<const double> first, std::span<const double> second,
                                     const RankTestSettings& settings) {
  constexpr std::string_view kName = "rank sum test";
  if (auto error = shift_complaint(settings)) return tl::unexpected(*error);
  if (auto error = complaint(kName, "the first group", first, 1)) return tl::unexpected(*error);
  if (auto error = complaint(kName, "the second group", second, 1)) return tl::unexpected(*error);
  std::vector<double> all(first.begin(), first.end());
  for (double& value : all) value -= settings.null_shift;
  all.insert(all.end(), second.begin(), second.end());
  if (constant(all))
    return base::fail(
        "rank sum test: all values are equal, so nothing can be tested; look at what was measured");
  const Ranked order = ranked(all);
  const auto exact = takes_exact(settings.method, std::max(first.size(), second.size()), order.ties > 0);
  if (!exact) return tl::unexpected(exact.error());

  const auto m = static_cast<double>(first.size()), n = static_cast<double>(second.size());
  RankTest test;
  test.exact = *exact;
  test.ties = order.ties;
  test.statistic = rank_sum_of(std::span(order.ranks).first(first.size())) - 0.5 * m * (m + 1.0);
  test.rank_biserial = 2.0 * test.statistic / (m * n) - 1.0;
  if (test.exact) {
    const auto distribution =
        rank_sum_distribution(static_cast<int>(first.size()), static_cast<int>(second.size()));
    test.p = exact_p(distribution, test.statistic, settings.alternative);
    return test;
  }
  const double total = m + n;
  const double sd = std::sqrt(m * n / 12.0 * (total + 1.0 - order.tie_sum / (total * (total - 1.0))));
  test.z = corrected_z(test.statistic - 0.5 * m * n, sd, settings);
  test.p = normal_p(test.z, settings.alternative);
  return test;
}

base::Result<RankTest> signed_rank_test(std::span<const double> differences,
                                        const RankTestSettings& settings) {
  if (auto error = shift_complaint(settings)) return tl::unexpected(*error);
  if (auto error = complaint("signed rank test", "the differences", differences, 1))
    return tl::unexpected(*error);
  std::vector<double> left, sizes;
  for (const double difference : differences)
    if (difference != settings.null_shift) left.push_back(difference - settings.null_shift);
  if (left.empty())
    return base::fail(
        "signed rank test: no difference is left, so nothing can be tested; look at the values");
  for (const double difference : left) sizes.push_back(std::abs(difference));
  const Ranked order = ranked(sizes);
  RankTest test;
  test.ties = order.ties;
  test.zeros = differences.size() - left.size();
  const auto exact = takes_exact(settings.method, left.size(), test.ties + test.zeros > 0);
  if (!exact) return tl::unexpected(exact.error());

  test.exact = *exact;
  for (std::size_t i = 0; i < left.size(); ++i)
    if (left[i] > 0.0) test.statistic += order.ranks[i];
  const auto n = static_cast<double>(left.size());
  const double most = 0.5 * n * (n + 1.0);
  test.rank_biserial = 2.0 * test.statistic / most - 1.0;
  if (test.exact) {
    const auto distribution = signed_rank_distribution(static_cast<int>(left.size()));
    test.p = exact_p(distribution, test.statistic, settings.alternative);
    return test;
  }
  const double sd = std::sqrt(n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - order.tie_sum / 48.0);
  test.z = corrected_z(test.statistic - 0.5 * most, sd, settings);
  test.p = normal_p(test.z, settings.alternative);
  return test;
}

base::Result<RankTest> signed_rank_test(std::span<const double> first, std::span<const double> second,
                                        const RankTestSettings& settings) {
  if (first.size() != second.size())
    return base::fail(
        "signed rank test: pairs need as many first as second values; leave out those without a partner");
  if (auto error = complaint("signed rank test", "the first of the pairs", first, 1))
    return tl::unexpected(*error);
  if (auto error = complaint("signed rank test", "the second of the pairs", second, 1))
    return tl::unexpected(*error);
  std::vector<double> differences(first.size());
  std::transform(first.begin(), first.end(), second.begin(), differences.begin(), std::minus<>());
  return signed_rank_test(differences, settings);
}

base::Result<KruskalWallis> kruskal_wallis(const std::vector<std::vector<double>>& groups) {
  if (auto error = complaint("Kruskal-Wallis test", groups, 1)) return tl::unexpected(*error);
  const std::vector<double> all = joined(groups);
  if (constant(all))
    return base::fail(
        "Kruskal-Wallis test: all values are equal, so nothing can be tested; look at what was measured");
  const Ranked order = ranked(all);
  const auto total = static_cast<double>(all.size());
  KruskalWallis test;
  double between = 0.0;
  std::size_t begin = 0;
  for (const auto& group : groups) {
    const auto n = static_cast<double>(group.size());
    test.mean_ranks.push_back(rank_sum_of(std::span(order.ranks).subspan(begin, group.size())) / n);
    const double deviation = test.mean_ranks.back() - 0.5 * (total + 1.0);
    between += n * deviation * deviation;
    begin += group.size();
  }
  const double untied = 1.0 - order.tie_sum / (total * total * total - total);
  test.h = 12.0 * between / (total * (total + 1.0)) / untied;
  test.df = static_cast<double>(groups.size()) - 1.0;
  test.p = chi_squared_above(test.h, test.df);
  test.epsilon_squared = test.h / (total - 1.0);
  return test;
}

base::Result<Friedman> friedman(const std::vector<std::vector<double>>& blocks) {
  constexpr std::string_view kName = "Friedman test";
  if (auto error = complaint(kName, blocks, 2)) return tl::unexpected(*error);
  const std::size_t treatments = blocks.front().size();
  const auto n = static_cast<double>(blocks.size()), k = static_cast<double>(treatments);
  Friedman test;
  test.mean_ranks.assign(treatments, 0.0);
  double tie_sum = 0.0;
  for (std::size_t row = 0; row < blocks.size(); ++row) {
    if (blocks[row].size() != treatments)
      return base::fail(
          fmt::format("Friedman test: row {} has {} values and row 1 has {}; leave out people who lack one",
                      row + 1, blocks[row].size(), treatments));
    const Ranked order = ranked(blocks[row]);
    tie_sum += order.tie_sum;
    for (std::size_t i = 0; i < treatments; ++i) test.mean_ranks[i] += order.ranks[i] / n;
  }
  const double spread = n * k * (k + 1.0) - tie_sum / (k - 1.0);
  if (spread <= 0.0)
    return base::fail(
        "Friedman test: all values of each row are equal, so nothing can be tested; look at what was "
        "measured");
  double between = 0.0;
  for (const double mean_rank : test.mean_ranks) {
    const double deviation = n * (mean_rank - 0.5 * (k + 1.0));
    between += deviation * deviation;
  }
  test.chi_squared = 12.0 * between / spread;
  test.df = k - 1.0;
  test.p = chi_squared_above(test.chi_squared, test.df);
  test.kendall_w = test.chi_squared / (n * test.df);
  return test;
}

}  // namespace icome::stats
