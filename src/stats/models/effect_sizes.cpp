#include "stats/models/effect_sizes.h"

#include <fmt/format.h>

#include <cmath>

#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

/// The noncentrality at which f or less has this probability, which falls as the noncentrality grows. NaN
/// where the distribution cannot be computed.
double noncentrality_at(double f, double df, double error_df, double probability) {
  const auto tail = [&](double noncentrality) { return noncentral_f_below(f, df, error_df, noncentrality); };
  if (tail(0.0) <= probability) return 0.0;
  double low = 0.0, high = df * f + 1.0;
  while (tail(high) > probability) {
    low = high;
    high *= 2.0;
    if (high > 1e12) return std::nan("");
  }
  for (int step = 0; step < 200 && high - low > 1e-12 * high; ++step) {
    const double middle = low + (high - low) / 2.0;
    const double value = tail(middle);
    if (std::isnan(value)) return value;
    (value > probability ? low : high) = middle;
  }
  return low + (high - low) / 2.0;
}

}  // namespace

base::Result<EffectInterval> noncentrality_interval(double f, double df, double error_df, double confidence) {
  if (!(f >= 0.0) || std::isinf(f)) {
    return base::fail(fmt::format("there is no interval around an F of {}: see the table's warnings", f));
  }
  if (!(df > 0.0) || !(error_df > 0.0)) {
    return base::fail("an F has degrees of freedom above 0: give those of its row and of its error");
  }
  if (!(confidence > 0.0 && confidence < 1.0)) {
    return base::fail(fmt::format("a confidence of {} is not between 0 and 1: give, say, 0.9", confidence));
  }
  const double outside = (1.0 - confidence) / 2.0;
  const EffectInterval interval{noncentrality_at(f, df, error_df, 1.0 - outside),
                                noncentrality_at(f, df, error_df, outside)};
  if (std::isnan(interval.low) || std::isnan(interval.high)) {
    return base::fail(fmt::format("the interval around an F of {} is beyond what can be computed", f));
  }
  return interval;
}

base::Result<EffectInterval> partial_eta_sq_interval(double f, double df, double error_df,
                                                     double confidence) {
  const auto interval = noncentrality_interval(f, df, error_df, confidence);
  if (!interval) return interval;
  const double n = df + error_df + 1.0;
  return EffectInterval{interval->low / (interval->low + n), interval->high / (interval->high + n)};
}

base::Result<EffectInterval> eta_sq_interval(double share, double df, double error_df, double confidence) {
  if (!(share >= 0.0 && share < 1.0)) {
    return base::fail(
        fmt::format("a share of variance of {} is not from 0 to below 1: it has no interval", share));
  }
  return partial_eta_sq_interval(share / df * error_df / (1.0 - share), df, error_df, confidence);
}

base::Result<EffectInterval> share_interval(double f, double df, double error_df, double error_ms,
                                            double rest, double confidence) {
  const auto interval = noncentrality_interval(f, df, error_df, confidence);
  if (!interval) return interval;
  if (!(error_ms > 0.0) || !(rest > 0.0) || !std::isfinite(rest))
    return base::fail("there is no variance that the effect could be a share of: see the table's warnings");
  const auto share = [&](double noncentrality) {
    return noncentrality * error_ms / (noncentrality * error_ms + rest);
  };
  return EffectInterval{share(interval->low), share(interval->high)};
}

}  // namespace icome::stats
