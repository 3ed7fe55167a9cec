#pragma once
#include <algorithm>
#include <cmath>

namespace icome::stats {

/// x - (e^2x - 1) / 2, the exponent of the density of x = ln(s / sigma) per degree of freedom; keeps its
/// digits near 0.
inline double log_scale_exponent(double x) {
  if (std::abs(x) > 1e-3) return x - 0.5 * std::expm1(2.0 * x);
  return -x * x * (1.0 + x * (2.0 / 3.0 + x * (1.0 / 3.0 + x * (2.0 / 15.0 + x * (2.0 / 45.0)))));
}

/// The mean of `value(u)` where u = s / sigma, a standard deviation of `df` degrees of freedom over the true
/// one. The trapezoidal rule over ln u: the density falls off like e^(df ln u) to the left and doubly
/// exponentially to the right, so it converges exponentially (Trefethen and Weideman 2014). `widest_step`,
/// in ln u, is for values that change over less than about 1. df may be infinite.
template <typename Value>
double average_over_scale(double df, double widest_step, Value&& value) {
  constexpr double kNegligible = -41.0;  // e^-41 < 2e-18
  if (df > 1e15) return value(1.0);
  const double step = std::min(widest_step, 0.6 / std::sqrt(2.0 * df));
  double weights = 0.0, total = 0.0;
  const auto add = [&](double x) {
    const double exponent = df * log_scale_exponent(x);
    const double weight = std::exp(exponent);
    weights += weight;
    total += weight * value(std::exp(x));
    return exponent > kNegligible;
  };
  add(0.0);
  for (int i = 1; add(i * step);) ++i;
  for (int i = 1; add(-i * step);) ++i;
  return total / weights;
}

}  // namespace icome::stats
