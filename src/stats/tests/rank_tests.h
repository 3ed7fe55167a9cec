#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "stats/tests/hypothesis.h"

namespace icome::stats {

/// Each value's place in the sorted order, from 1; equal values share the mean of their places. Finite
/// values.
std::vector<double> ranks(std::span<const double> values);

/// The way to find the p value of a rank test.
enum class RankMethod : std::uint8_t {
  Automatic,    // exact for fewer than 50 values (a group) without ties and zeros, else approximate: R's rule
  Exact,        // an error where there are ties or zeros, or more than 100 values (a group)
  Approximate,  // normal, with the variance that ties leave
};

struct RankTestSettings {
  double null_shift = 0.0;  // of the first values above the second, in the unit of the values
  Alternative alternative = Alternative::TwoSided;
  RankMethod method = RankMethod::Automatic;
  bool continuity = true;  // takes half a rank off before the normal approximation
};

struct RankTest {
  double statistic = 0.0;  // rank sum: U of the first group (R's W); signed ranks: V, the positive rank sum
  double z = 0.0;          // of the normal approximation, continuity corrected if so set; 0 when exact
  double p = 1.0;
  bool exact = false;
  /// The share of pairs in favour of the first less the share against it (Kerby 2014): -1 to 1, 0 if equal.
  double rank_biserial = 0.0;
  std::size_t ties = 0;   // values that are equal to another one
  std::size_t zeros = 0;  // signed ranks: differences of 0, which are left out (Wilcoxon's way)
};

/// Is one group's value greater than the other's more often than not? Wilcoxon's rank sum test, which is Mann
/// and Whitney's U (1947). At least one finite value each; all of them the same is an error.
base::Result<RankTest> rank_sum_test(std::span<const double> first, std::span<const double> second,
                                     const RankTestSettings& settings = {});

/// Are differences as often and as far above `null_shift` as below? (Wilcoxon 1945.) At least one difference
/// other than that.
base::Result<RankTest> signed_rank_test(std::span<const double> differences,
                                        const RankTestSettings& settings = {});
/// The signed rank test of first less second, pair by pair.
base::Result<RankTest> signed_rank_test(std::span<const double> first, std::span<const double> second,
                                        const RankTestSettings& settings = {});

struct KruskalWallis {
  double h = 0.0;  // corrected for ties
  double df = 0.0;
  double p = 1.0;                // by chi-squared
  double epsilon_squared = 0.0;  // effect: H / (N - 1), 0 to 1 (Tomczak and Tomczak 2014)
  std::vector<double> mean_ranks;
};
/// Does at least one of two or more independent groups tend to greater values? (Kruskal and Wallis 1952.)
/// At least one finite value each, not all the same.
base::Result<KruskalWallis> kruskal_wallis(const std::vector<std::vector<double>>& groups);

struct Friedman {
  double chi_squared = 0.0;  // corrected for ties
  double df = 0.0;
  double p = 1.0;
  double kendall_w = 0.0;  // effect: concordance, 0 to 1 (Kendall and Babington Smith 1939)
  std::vector<double> mean_ranks;
};
/// Does at least one of two or more treatments tend to greater values within a block? (Friedman 1937.)
/// `blocks` holds a row for each person with a value for each treatment; at least two of each, and not
/// all of every row the same.
base::Result<Friedman> friedman(const std::vector<std::vector<double>>& blocks);

}  // namespace icome::stats
