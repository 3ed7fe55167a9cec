#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "stats/tests/hypothesis.h"

namespace icome::stats {

struct CorrelationSettings {
  Alternative alternative = Alternative::TwoSided;
  double confidence = 0.95;  // in (0, 1)
};

struct PearsonCorrelation {
  double r = 0.0;  // -1 to 1 (thesis 6.23)
  double t = 0.0;
  double df = 0.0;  // n - 2
  double p = 1.0;
  ConfidenceInterval interval;  // by Fisher's z; -1 to 1 of fewer than four pairs
  double critical_r = 0.0;      // |r| is significant above it at 1 - confidence, two-sided
};
/// Pearson's product-moment correlation. At least three finite pairs, neither variable constant.
base::Result<PearsonCorrelation> pearson(std::span<const double> x, std::span<const double> y,
                                         const CorrelationSettings& settings = {});

/// The r above which a correlation is significant, two-sided (thesis 6.4.4's lookup table): t / sqrt(df +
/// t^2). `alpha` in (0, 1), df > 0.
double critical_r(double df, double alpha = 0.05);

struct SpearmanCorrelation {
  double rho = 0.0;  // Pearson's r of the ranks
  double s = 0.0;    // sum of squared rank differences (of the untied formula where there are ties)
  double p = 1.0;
  bool exact = false;
};
/// Spearman's rank correlation. Without ties p is exact up to 9 pairs and by the series of Best and Roberts
/// (1975, AS 89) up to 1289; with ties or beyond that by t with n - 2 degrees of freedom, all as in R. At
/// least three finite pairs (two say nothing), neither variable constant.
base::Result<SpearmanCorrelation> spearman(std::span<const double> x, std::span<const double> y,
                                           Alternative alternative = Alternative::TwoSided);

enum class CorrelationKind : std::uint8_t { Pearson, Spearman };

/// The correlations of all pairs of variables; symmetric.
struct CorrelationMatrix {
  Eigen::MatrixXd r;       // 1 on the diagonal; NaN where there were too few pairs or a constant
  Eigen::MatrixXd p;       // two-sided, not adjusted; 0 on the diagonal, NaN where r is
  Eigen::MatrixXi counts;  // complete pairs
};
/// Correlates all pairs of columns. NaN is a missing value: each pair of columns uses the rows where both
/// have a value. Columns of the same length.
base::Result<CorrelationMatrix> correlation_matrix(const std::vector<std::vector<double>>& columns,
                                                   CorrelationKind kind = CorrelationKind::Pearson);

}  // namespace icome::stats
