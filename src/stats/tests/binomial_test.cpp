#include "stats/tests/binomial_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>

#include "stats/tables/count_check.h"
#include "stats/tables/sample_check.h"
#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

using Binomial = boost::math::binomial_distribution<double>;

double share_at_most(const Binomial& binomial, double successes) {
  return successes < 0.0 ? 0.0 : cdf(binomial, successes);
}

double share_at_least(const Binomial& binomial, double successes) {
  if (successes <= 0.0) return 1.0;
  return successes > binomial.trials() ? 0.0 : cdf(complement(binomial, successes - 1.0));
}

// The margin for outcomes that are as likely but for rounding, as in R.
constexpr double kAsLikely = 1.0 + 1e-7;

// The first of `begin`, begin + step, ... towards `end` whose probability is at most `most`, or one
// beyond. Found by halving, as the probabilities fall on the far side of the mean.
double first_unlikely(const Binomial& binomial, double most, double begin, double end) {
  const double step = begin <= end ? 1.0 : -1.0;
  double below = 0.0, above = std::abs(end - begin) + 1.0;
  while (below < above) {
    const double middle = std::floor(0.5 * (below + above));
    if (pdf(binomial, begin + step * middle) <= most)
      above = middle;
    else
      below = middle + 1.0;
  }
  return begin + step * below;
}

double two_sided_binomial_p(double successes, const Binomial& binomial) {
  const double mean = binomial.trials() * binomial.success_fraction();
  if (successes == mean) return 1.0;
  const double most = pdf(binomial, successes) * kAsLikely;
  if (successes < mean) {
    const double other = first_unlikely(binomial, most, std::ceil(mean), binomial.trials());
    return std::min(1.0, share_at_most(binomial, successes) + share_at_least(binomial, other));
  }
  const double other = first_unlikely(binomial, most, std::floor(mean), 0.0);
  return std::min(1.0, share_at_most(binomial, other) + share_at_least(binomial, successes));
}

double binomial_p(double successes, double trials, const BinomialTestSettings& settings) {
  const double probability = settings.probability;
  const Binomial binomial(trials, probability);
  if (settings.alternative == Alternative::Less) return share_at_most(binomial, successes);
  if (settings.alternative == Alternative::Greater) return share_at_least(binomial, successes);
  if (probability == 0.0) return successes == 0.0 ? 1.0 : 0.0;
  if (probability == 1.0) return successes == trials ? 1.0 : 0.0;
  return two_sided_binomial_p(successes, binomial);
}

ConfidenceInterval clopper_pearson(double successes, double trials, const BinomialTestSettings& settings) {
  const bool two_sided = settings.alternative == Alternative::TwoSided;
  const double tail = (1.0 - settings.confidence) * (two_sided ? 0.5 : 1.0);
  ConfidenceInterval interval{0.0, 1.0};
  if (settings.alternative != Alternative::Less && successes > 0.0)
    interval.low = beta_quantile(tail, successes, trials - successes + 1.0);
  if (settings.alternative != Alternative::Greater && successes < trials)
    interval.high = beta_quantile(1.0 - tail, successes + 1.0, trials - successes);
  return interval;
}

}  // namespace

base::Result<BinomialTest> binomial_test(double successes, double trials,
                                         const BinomialTestSettings& settings) {
  const std::array counts = {successes, trials};
  if (auto error = count_complaint("binomial test", counts)) return tl::unexpected(*error);
  if (auto error = confidence_complaint("binomial test", settings.confidence)) return tl::unexpected(*error);
  if (trials < 1.0 || trials > 1e9)
    return base::fail(fmt::format("binomial test: {} trials; give 1 to 1e9", trials));
  if (successes > trials)
    return base::fail(
        fmt::format("binomial test: {} successes of {} trials; give no more than trials", successes, trials));
  if (!(settings.probability >= 0.0 && settings.probability <= 1.0))
    return base::fail(fmt::format("binomial test: a probability of {} cannot be; give one from 0 to 1",
                                  settings.probability));
  BinomialTest test;
  test.share = successes / trials;
  test.p = binomial_p(successes, trials, settings);
  test.interval = clopper_pearson(successes, trials, settings);
  return test;
}

base::Result<BinomialTest> sign_test(double better, double worse, const BinomialTestSettings& settings) {
  const std::array counts = {better, worse};
  if (auto error = count_complaint("sign test", counts)) return tl::unexpected(*error);
  if (better + worse == 0.0)
    return base::fail("sign test: none is better or worse, so nothing can be tested; look at the counts");
  return binomial_test(better, better + worse, settings);
}

}  // namespace icome::stats
