#include "stats/models/sphericity.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>

namespace icome::stats {
namespace {

/// The probability of W or less in d dimensions: -n rho log W is chi-squared to first order, with a
/// second-order term (Box 1949; Anderson, An Introduction to Multivariate Statistical Analysis, 10.7.4).
double mauchly_p(double log_w, double d, double n) {
  const double df = d * (d + 1.0) / 2.0 - 1.0;
  const double rho = 1.0 - (2.0 * d * d + d + 2.0) / (6.0 * d * n);
  const double second = (d + 2.0) * (d - 1.0) * (d - 2.0) * (2.0 * d * d * d + 6.0 * d * d + 3.0 * d + 2.0) /
                        (288.0 * n * n * d * d * rho * rho);
  const double z = -n * rho * log_w;
  if (!(z >= 0.0) || std::isinf(z)) return std::numeric_limits<double>::quiet_NaN();
  const double p = cdf(complement(boost::math::chi_squared(df), z));
  const double corrected = p + second * (cdf(complement(boost::math::chi_squared(df + 4.0), z)) - p);
  return std::clamp(corrected, 0.0, 1.0);  // with hardly more subjects than d the second term is too large
}

}  // namespace

Sphericity sphericity_of(const Eigen::MatrixXd& residuals, int error_df) {
  const auto d = static_cast<double>(residuals.cols());
  const double n = error_df;
  Sphericity result;
  result.lower_bound = 1.0 / d;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(residuals.transpose() * residuals,
                                                              Eigen::EigenvaluesOnly);
  const Eigen::VectorXd& spreads = solver.eigenvalues();  // of the covariance, times n
  const double trace = spreads.sum();
  result.greenhouse_geisser = trace * trace / (d * spreads.squaredNorm());
  const double e = d * result.greenhouse_geisser;
  result.huynh_feldt = ((n + 1.0) * e - 2.0) / (d * (n - e));
  result.mauchly_w = result.p = std::numeric_limits<double>::quiet_NaN();
  if (n < d || !(spreads[0] > 1e-14 * spreads[spreads.size() - 1])) return result;
  const double log_w = (spreads / (trace / d)).array().log().sum();
  result.mauchly_w = std::exp(log_w);
  result.p = mauchly_p(log_w, d, n);
  return result;
}

}  // namespace icome::stats
