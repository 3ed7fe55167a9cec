#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <numbers>

#include "stats/models/scale_average.h"
#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

// T <= t is Z + delta <= t u, with Z normal and u = s / sigma. One of the two is averaged in closed form
// first, so that the trapezoidal rule over the other sees something smooth.
double average_of_normal(double t, double df, double delta) {
  const double step = std::min(0.12, 0.3 / (1.0 + std::abs(delta)));
  return average_over_scale(df, step, [&](double u) { return normal_above(delta - t * u); });
}

double average_of_scale(double t, double df, double delta) {
  constexpr double kStep = 0.125;
  double weights = 0.0, total = 0.0;
  for (int i = -72; i <= 72; ++i) {
    const double z = i * kStep;
    const double weight = std::exp(-0.5 * z * z);
    const double u = (z + delta) / t;
    weights += weight;
    total += weight * (u <= 0.0 ? 1.0 : boost::math::gamma_q(0.5 * df, 0.5 * df * u * u));
  }
  return total / weights;
}

double delta_with(double below, double t, double df) {
  const auto excess = [&](double delta) { return noncentral_t_below(t, df, delta) - below; };
  // The probability falls as delta grows.
  double reach = 2.0 + std::abs(t) * std::min(1.0, 4.0 / std::sqrt(2.0 * df));
  double low = t, high = t;
  for (; excess(low) < 0.0; reach *= 2.0) low -= reach;
  for (; excess(high) > 0.0; reach *= 2.0) high += reach;
  const double at_low = excess(low), at_high = excess(high);
  if (at_low == 0.0) return low;
  if (at_high == 0.0) return high;
  std::uintmax_t iterations = 200;
  const auto bracket = boost::math::tools::toms748_solve(
      excess, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(48), iterations);
  return 0.5 * (bracket.first + bracket.second);
}

}  // namespace

double noncentral_t_below(double t, double df, double delta) {
  if (!(df > 0.0) || std::isnan(t) || !std::isfinite(delta)) return std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(t)) return t > 0.0 ? 1.0 : 0.0;
  if (t < 0.0) return 1.0 - noncentral_t_below(-t, df, -delta);
  const bool scale_is_wide = t > std::sqrt(2.0 * df);
  if (scale_is_wide && std::abs(delta) > 12.0) return average_of_scale(t, df, delta);
  return average_of_normal(t, df, delta);
}

ConfidenceInterval t_noncentrality_interval(double t, double df, double confidence) {
  const double tail = 0.5 * (1.0 - confidence);
  return {delta_with(1.0 - tail, t, df), delta_with(tail, t, df)};
}

}  // namespace icome::stats
