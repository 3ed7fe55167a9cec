#include "stats/f_distribution.h"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_f.hpp>
#include <cmath>
#include <limits>

namespace icome::stats {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// What cannot be computed is NaN, never thrown.
using Quiet = boost::math::policies::policy<
    boost::math::policies::domain_error<boost::math::policies::ignore_error>,
    boost::math::policies::pole_error<boost::math::policies::ignore_error>,
    boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
    boost::math::policies::evaluation_error<boost::math::policies::ignore_error>>;

}  // namespace

double f_upper_tail(double f, double df, double error_df) {
  if (std::isnan(f) || !(df > 0.0) || !(error_df > 0.0)) return kNan;
  if (std::isinf(f)) return f > 0.0 ? 0.0 : 1.0;
  if (f <= 0.0) return 1.0;
  return cdf(complement(boost::math::fisher_f_distribution<double, Quiet>(df, error_df), f));
}

double noncentral_f_lower_tail(double f, double df, double error_df, double noncentrality) {
  if (!(f >= 0.0) || std::isinf(f) || !(df > 0.0) || !(error_df > 0.0)) return kNan;
  if (noncentrality == 0.0) return f == 0.0 ? 0.0 : 1.0 - f_upper_tail(f, df, error_df);
  return cdf(boost::math::non_central_f_distribution<double, Quiet>(df, error_df, noncentrality), f);
}

}  // namespace icome::stats
