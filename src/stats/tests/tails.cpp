#include "stats/tests/tails.h"

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/non_central_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace icome::stats {
namespace {

// NaN or infinity in place of exceptions.
using Unthrowing = boost::math::policies::policy<
    boost::math::policies::domain_error<boost::math::policies::ignore_error>,
    boost::math::policies::pole_error<boost::math::policies::ignore_error>,
    boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
    boost::math::policies::evaluation_error<boost::math::policies::ignore_error>>;
using QuietNormal = boost::math::normal_distribution<double, Unthrowing>;
using QuietT = boost::math::students_t_distribution<double, Unthrowing>;
using QuietChiSquared = boost::math::chi_squared_distribution<double, Unthrowing>;
using QuietF = boost::math::fisher_f_distribution<double, Unthrowing>;
using QuietBeta = boost::math::beta_distribution<double, Unthrowing>;
using QuietNoncentralF = boost::math::non_central_f_distribution<double, Unthrowing>;
using QuietNoncentralChiSquared = boost::math::non_central_chi_squared_distribution<double, Unthrowing>;

template <typename Distribution>
double tail_above(const Distribution& distribution, double x) {
  return cdf(complement(distribution, x));
}

}  // namespace

double normal_above(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }
double normal_quantile(double probability) { return quantile(QuietNormal(), probability); }
double t_above(double t, double df) { return tail_above(QuietT(df), t); }
double t_quantile(double probability, double df) { return quantile(QuietT(df), probability); }

double chi_squared_above(double x, double df) {
  if (std::isinf(x)) return 0.0;
  return tail_above(QuietChiSquared(df), x);
}
double chi_squared_quantile(double probability, double df) {
  return quantile(QuietChiSquared(df), probability);
}

double f_above(double f, double df, double error_df) {
  if (std::isnan(f) || !(df > 0.0) || !(error_df > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(f)) return f > 0.0 ? 0.0 : 1.0;
  return f > 0.0 ? tail_above(QuietF(df, error_df), f) : 1.0;
}
double f_quantile(double probability, double df, double error_df) {
  return quantile(QuietF(df, error_df), probability);
}

double beta_quantile(double probability, double a, double b) {
  return quantile(QuietBeta(a, b), probability);
}

double noncentral_f_below(double f, double df, double error_df, double lambda) {
  if (!(f >= 0.0) || std::isinf(f) || !(df > 0.0) || !(error_df > 0.0))
    return std::numeric_limits<double>::quiet_NaN();
  if (lambda == 0.0) return 1.0 - f_above(f, df, error_df);
  return cdf(QuietNoncentralF(df, error_df, lambda), f);
}
double noncentral_f_above(double f, double df, double error_df, double lambda) {
  if (lambda == 0.0) return f_above(f, df, error_df);
  return tail_above(QuietNoncentralF(df, error_df, lambda), f);
}
double noncentral_chi_squared_above(double x, double df, double lambda) {
  if (lambda == 0.0) return chi_squared_above(x, df);
  return tail_above(QuietNoncentralChiSquared(df, lambda), x);
}

double normal_p(double z, Alternative alternative) {
  switch (alternative) {
    case Alternative::Less:
      return normal_above(-z);
    case Alternative::Greater:
      return normal_above(z);
    case Alternative::TwoSided:
      break;
  }
  return 2.0 * normal_above(std::abs(z));
}

double t_p(double t, double df, Alternative alternative) {
  switch (alternative) {
    case Alternative::Less:
      return t_above(-t, df);
    case Alternative::Greater:
      return t_above(t, df);
    case Alternative::TwoSided:
      break;
  }
  return 2.0 * t_above(std::abs(t), df);
}

}  // namespace icome::stats
