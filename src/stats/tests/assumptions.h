#pragma once
#include <span>
#include <vector>

#include "base/result.h"

namespace icome::stats {

/// A test of the hypothesis that variances are equal. A small p speaks against it.
struct VarianceTest {
  double statistic = 0.0;  // F, or Bartlett's K squared
  double df = 0.0;         // groups less 1
  double error_df = 0.0;   // of F; 0 for Bartlett's
  double p = 1.0;
};

/// Analysis of variance of the distances from each group's mean (Levene 1960). At least two groups of two
/// finite values, not all of the same distance.
base::Result<VarianceTest> levene_test(const std::vector<std::vector<double>>& groups);
/// Levene's test from each group's median (Brown and Forsythe 1974), which keeps its level for skewed data.
base::Result<VarianceTest> brown_forsythe_test(const std::vector<std::vector<double>>& groups);
/// Bartlett's test (1937), for normal data only. Each group must have some variance.
base::Result<VarianceTest> bartlett_test(const std::vector<std::vector<double>>& groups);

struct ShapiroWilk {
  double w = 1.0;  // near 1 for normal data
  double p = 1.0;
};
/// Are values normally distributed? (Shapiro and Wilk 1965; coefficients and p by Royston 1995, AS R94.)
/// 3 to 5000 finite values, not all the same.
base::Result<ShapiroWilk> shapiro_wilk(std::span<const double> values);

}  // namespace icome::stats
