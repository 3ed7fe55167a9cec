#include "textbook_sums.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace icome::benchmarks {
namespace {

using stats::Factor;

/// Counts and sums of the observations with equal levels.
struct Totals {
  Eigen::VectorXd n, sum;
  double squares = 0.0;  // of all values
};

/// Totals for each combination of the factors' levels; the last factor's level changes fastest.
Totals totals_of(const StatsSample& sample, const std::vector<const Factor*>& factors) {
  std::size_t cells = 1;
  for (const Factor* factor : factors) cells *= factor->levels.size();
  Totals totals{Eigen::VectorXd::Zero(Eigen::Index(cells)), Eigen::VectorXd::Zero(Eigen::Index(cells)), 0.0};
  for (std::size_t row = 0; row < sample.values.size(); ++row) {
    std::size_t cell = 0;
    for (const Factor* factor : factors) cell = cell * factor->levels.size() + std::size_t(factor->of[row]);
    const double value = sample.values[row];
    totals.n[Eigen::Index(cell)] += 1.0;
    totals.sum[Eigen::Index(cell)] += value;
    totals.squares += value * value;
  }
  return totals;
}

/// The sum of squares that the cells' means account for: the sum of T squared over n.
double accounted(const Totals& totals) { return totals.sum.cwiseAbs2().cwiseQuotient(totals.n).sum(); }

/// The sum of squares that a model of cells accounts for: b'X'y, with b from the normal equations.
double accounted(const Totals& totals, const Eigen::MatrixXd& x) {
  const Eigen::MatrixXd squared = x.transpose() * totals.n.asDiagonal() * x;
  const Eigen::VectorXd right = x.transpose() * totals.sum;
  return right.dot(squared.ldlt().solve(right));
}

/// Design matrix of the grand mean and the dummies of one factor or both.
Eigen::MatrixXd dummies(int a_levels, int b_levels, bool with_a, bool with_b) {
  const int a_columns = with_a ? a_levels - 1 : 0, b_columns = with_b ? b_levels - 1 : 0;
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(a_levels * b_levels, 1 + a_columns + b_columns);
  x.col(0).setOnes();
  for (int cell = 0; cell < x.rows(); ++cell) {
    const int a = cell / b_levels, b = cell % b_levels;
    if (with_a && a > 0) x(cell, a) = 1.0;
    if (with_b && b > 0) x(cell, a_columns + b) = 1.0;
  }
  return x;
}

}  // namespace

FValues textbook_one_way(const StatsSample& sample) {
  const Factor& factor = sample.factors[0];
  const Totals totals = totals_of(sample, {&factor});
  const auto n = double(sample.values.size()), levels = double(factor.levels.size());
  const double grand = totals.sum.sum();
  const double between = accounted(totals) - grand * grand / n;
  const double within = totals.squares - accounted(totals);
  return {{factor.name, between / (levels - 1.0) / (within / (n - levels))}};
}

FValues textbook_factorial(const StatsSample& sample) {
  const Factor &a = sample.factors[0], &b = sample.factors[1];
  const Totals totals = totals_of(sample, {&a, &b});
  const int a_levels = int(a.levels.size()), b_levels = int(b.levels.size());
  const double of_a = accounted(totals, dummies(a_levels, b_levels, true, false));
  const double of_b = accounted(totals, dummies(a_levels, b_levels, false, true));
  const double of_both = accounted(totals, dummies(a_levels, b_levels, true, true));
  const double of_cells = accounted(totals);
  const double a_df = a_levels - 1.0, b_df = b_levels - 1.0;
  const double ms = (totals.squares - of_cells) / (double(sample.values.size()) - a_levels * b_levels);
  return {{a.name, (of_both - of_b) / a_df / ms},
          {b.name, (of_both - of_a) / b_df / ms},
          {a.name + ":" + b.name, (of_cells - of_both) / (a_df * b_df) / ms}};
}

FValues textbook_repeated(const StatsSample& sample) {
  const Factor &s = sample.factors[0], &a = sample.factors[1], &b = sample.factors[2];
  const double grand = accounted(totals_of(sample, {}));
  const auto of = [&](const std::vector<const Factor*>& factors) {
    return accounted(totals_of(sample, factors));
  };
  const double of_s = of({&s}), of_a = of({&a}), of_b = of({&b});
  const double of_ab = of({&a, &b}), of_sa = of({&s, &a}), of_sb = of({&s, &b}), all = of({&s, &a, &b});
  const auto s_df = double(s.levels.size() - 1);
  return {{a.name, (of_a - grand) / ((of_sa - of_s - of_a + grand) / s_df)},
          {b.name, (of_b - grand) / ((of_sb - of_s - of_b + grand) / s_df)},
          {a.name + ":" + b.name, (of_ab - of_a - of_b + grand) /
                                      ((all - of_sa - of_sb - of_ab + of_s + of_a + of_b - grand) / s_df)}};
}

}  // namespace icome::benchmarks
