#include "stats/models/studentized_range.h"

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "stats/models/scale_average.h"
#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

enum class RangeTail : std::uint8_t { Below, Above };

// A tail of the range of k standard normal values at w. The greatest is z, the others lie from z - w to z:
//   P(range <= w) = k integral of phi(z) (Phi(z) - Phi(z - w))^(k - 1),
// and P(range > w) is the rest up to k integral of phi(z) Phi(z)^(k - 1) = 1, taken inside so as to keep
// the digits of small tails. The trapezoidal rule converges exponentially: the integrand is analytic and
// falls off like phi.
double normal_range_tail(double w, double groups, RangeTail tail) {
  const double step = groups <= 10.0 ? 0.25 : 0.125;
  const double centre = tail == RangeTail::Above ? step * std::round(0.5 * w / step) : 0.0;
  const auto reach = static_cast<int>(9.5 / step);
  const double others = groups - 1.0;
  double total = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    const double z = centre + i * step;
    const double log_phi = -0.5 * z * z;
    const double below = normal_above(-z);
    const double outside = std::log1p(-std::min(1.0, normal_above(w - z) / below));
    const double inside_all = others * outside;  // ln of the share of Phi(z) within the range, to that power
    const double log_below = others * std::log(below);
    if (tail == RangeTail::Below)
      total += std::exp(log_phi + log_below + inside_all);
    else
      total -= std::exp(log_phi + log_below) * std::expm1(inside_all);
  }
  return groups * total * step / std::sqrt(2.0 * std::numbers::pi);
}

double range_tail(double q, double groups, double df, RangeTail tail) {
  if (std::isnan(q) || !(groups >= 2.0 && groups <= 1000.0) || !(df >= 1.0))
    return std::numeric_limits<double>::quiet_NaN();
  if (q <= 0.0) return tail == RangeTail::Above ? 1.0 : 0.0;
  if (std::isinf(q)) return tail == RangeTail::Above ? 0.0 : 1.0;
  // The range of many means hardly varies, so that its tail falls steeply.
  const double step = groups <= 60.0 ? 0.08 : 0.04;
  const double share =
      average_over_scale(df, step, [&](double u) { return normal_range_tail(q * u, groups, tail); });
  return std::min(1.0, share);
}

}  // namespace

double studentized_range_below(double q, double groups, double df) {
  return range_tail(q, groups, df, RangeTail::Below);
}

double studentized_range_above(double q, double groups, double df) {
  return range_tail(q, groups, df, RangeTail::Above);
}

double studentized_range_quantile(double probability, double groups, double df) {
  if (!(probability >= 0.0 && probability < 1.0) || std::isnan(studentized_range_below(1.0, groups, df)))
    return std::numeric_limits<double>::quiet_NaN();
  if (probability == 0.0) return 0.0;
  const auto excess = [&](double q) {
    return probability < 0.5 ? studentized_range_below(q, groups, df) - probability
                             : (1.0 - probability) - studentized_range_above(q, groups, df);
  };
  double high = 4.0;
  while (excess(high) < 0.0) high *= 2.0;
  std::uintmax_t iterations = 200;
  const auto bracket = boost::math::tools::toms748_solve(
      excess, 0.0, high, boost::math::tools::eps_tolerance<double>(46), iterations);
  return 0.5 * (bracket.first + bracket.second);
}

}  // namespace icome::stats
