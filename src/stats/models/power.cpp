#include "stats/models/power.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

constexpr std::size_t kMostNeeded = 10'000'000;

std::optional<base::Error> alpha_complaint(double alpha) {
  // Below that the limit that belongs to alpha has no digits left.
  if (alpha >= 1e-9 && alpha < 1.0) return std::nullopt;
  return base::Error{
      fmt::format("power: an alpha of {} cannot be; give one between 0 and 1, such as 0.05", alpha)};
}

std::optional<base::Error> power_complaint(double power, double alpha) {
  if (auto error = alpha_complaint(alpha)) return error;
  if (power > alpha && power < 1.0) return std::nullopt;
  return base::Error{
      fmt::format("power: a power of {} cannot be asked for; give one above alpha and below 1, "
                  "such as 0.8",
                  power)};
}

std::optional<base::Error> effect_complaint(double effect) {
  if (std::isfinite(effect) && std::abs(effect) <= 1e6) return std::nullopt;
  return base::Error{
      fmt::format("power: an effect size of {} cannot be; give a usual one, such as 0.5", effect)};
}

double t_power(double delta, double df, const PowerSettings& settings) {
  const bool two_sided = settings.alternative == Alternative::TwoSided;
  const double limit = t_quantile(1.0 - settings.alpha * (two_sided ? 0.5 : 1.0), df);
  const double above = noncentral_t_below(-limit, df, -delta);  // P(T > limit), mirrored to keep its digits
  const double below = noncentral_t_below(-limit, df, delta);
  if (two_sided) return above + below;
  return settings.alternative == Alternative::Greater ? above : below;
}

// The smallest whole count from `least` on that reaches the power, which grows with the count.
template <typename PowerOf>
base::Result<std::size_t> count_reaching(double power, std::size_t least, PowerOf&& power_of) {
  const auto reaches = [&](std::size_t count) { return power_of(static_cast<double>(count)) >= power; };
  std::size_t below = least, enough = least;
  while (!reaches(enough)) {
    if (enough >= kMostNeeded)
      return base::fail("power: more than 1e7 values would be needed; look for a larger effect");
    below = enough;
    enough = std::min(2 * enough, kMostNeeded);
  }
  while (enough - below > 1) {
    const std::size_t middle = below + (enough - below) / 2;
    (reaches(middle) ? enough : below) = middle;
  }
  return enough;
}

// Is the non-central distribution so far beyond the limit that its series is long and the answer certain?
bool certain_to_exceed(double lambda, double limit) { return lambda > 1e5 && lambda > 50.0 * limit; }

double f_power(double groups, double count, double f, double alpha) {
  const double df = groups - 1.0, error_df = groups * (count - 1.0);
  const double lambda = groups * count * f * f;
  const double limit = f_quantile(1.0 - alpha, df, error_df);
  if (certain_to_exceed(lambda, limit * df)) return 1.0;
  return noncentral_f_above(limit, df, error_df, lambda);
}

double counts_power(double df, double total, double w, double alpha) {
  const double limit = chi_squared_quantile(1.0 - alpha, df);
  const double lambda = total * w * w;
  if (certain_to_exceed(lambda, limit)) return 1.0;
  return noncentral_chi_squared_above(limit, df, lambda);
}

std::optional<base::Error> groups_complaint(std::size_t groups) {
  if (groups >= 2 && groups <= 1000) return std::nullopt;
  return base::Error{fmt::format("power: {} groups; give 2 to 1000", groups)};
}

std::optional<base::Error> df_complaint(double df) {
  if (df >= 1.0 && df <= 1e6) return std::nullopt;
  return base::Error{fmt::format("power: {} degrees of freedom; give 1 to 1e6", df)};
}

std::optional<base::Error> size_complaint(double count, double least) {
  if (count >= least && count <= 1e9) return std::nullopt;
  return base::Error{fmt::format("power: a count of {}; give {} to 1e9", count, least)};
}

double one_design_power(TDesign design, double count, double d, const PowerSettings& settings) {
  if (design == TDesign::TwoSample) return t_power(d * std::sqrt(0.5 * count), 2.0 * count - 2.0, settings);
  return t_power(d * std::sqrt(count), count - 1.0, settings);
}

}  // namespace

base::Result<double> t_test_power(TDesign design, double count, double d, const PowerSettings& settings) {
  if (auto error = alpha_complaint(settings.alpha)) return tl::unexpected(*error);
  if (auto error = effect_complaint(d)) return tl::unexpected(*error);
  if (auto error = size_complaint(count, 2.0)) return tl::unexpected(*error);
  return one_design_power(design, count, d, settings);
}

base::Result<double> t_test_power(double first_count, double second_count, double d,
                                  const PowerSettings& settings) {
  if (auto error = alpha_complaint(settings.alpha)) return tl::unexpected(*error);
  if (auto error = effect_complaint(d)) return tl::unexpected(*error);
  if (auto error = size_complaint(first_count, 1.0)) return tl::unexpected(*error);
  if (auto error = size_complaint(second_count, 1.0)) return tl::unexpected(*error);
  if (auto error = size_complaint(first_count + second_count, 3.0)) return tl::unexpected(*error);
  const double delta = d / std::sqrt(1.0 / first_count + 1.0 / second_count);
  return t_power(delta, first_count + second_count - 2.0, settings);
}

base::Result<std::size_t> t_test_count(TDesign design, double d, double power,
                                       const PowerSettings& settings) {
  if (auto error = power_complaint(power, settings.alpha)) return tl::unexpected(*error);
  if (auto error = effect_complaint(d)) return tl::unexpected(*error);
  const bool other_way = settings.alternative == Alternative::Less ? d > 0.0 : d < 0.0;
  if (other_way && settings.alternative != Alternative::TwoSided)
    return base::fail(fmt::format(
        "power: however many values, an effect of {} is not found by a test for the other direction; "
        "turn its sign or the alternative",
        d));
  return count_reaching(power, 2, [&](double count) { return one_design_power(design, count, d, settings); });
}

base::Result<double> anova_power(std::size_t groups, double count, double f, double alpha) {
  if (auto error = alpha_complaint(alpha)) return tl::unexpected(*error);
  if (auto error = effect_complaint(f)) return tl::unexpected(*error);
  if (auto error = groups_complaint(groups)) return tl::unexpected(*error);
  if (auto error = size_complaint(count, 2.0)) return tl::unexpected(*error);
  return f_power(static_cast<double>(groups), count, f, alpha);
}

base::Result<std::size_t> anova_count(std::size_t groups, double f, double power, double alpha) {
  if (auto error = power_complaint(power, alpha)) return tl::unexpected(*error);
  if (auto error = effect_complaint(f)) return tl::unexpected(*error);
  if (auto error = groups_complaint(groups)) return tl::unexpected(*error);
  return count_reaching(power, 2,
                        [&](double count) { return f_power(static_cast<double>(groups), count, f, alpha); });
}

base::Result<double> chi_squared_power(double df, double total, double w, double alpha) {
  if (auto error = alpha_complaint(alpha)) return tl::unexpected(*error);
  if (auto error = effect_complaint(w)) return tl::unexpected(*error);
  if (auto error = df_complaint(df)) return tl::unexpected(*error);
  if (auto error = size_complaint(total, 1.0)) return tl::unexpected(*error);
  return counts_power(df, total, w, alpha);
}

base::Result<std::size_t> chi_squared_count(double df, double w, double power, double alpha) {
  if (auto error = power_complaint(power, alpha)) return tl::unexpected(*error);
  if (auto error = effect_complaint(w)) return tl::unexpected(*error);
  if (auto error = df_complaint(df)) return tl::unexpected(*error);
  return count_reaching(power, 1, [&](double total) { return counts_power(df, total, w, alpha); });
}

}  // namespace icome::stats
