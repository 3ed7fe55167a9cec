#include "stats/tests/fisher_exact.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>

#include "stats/tables/count_check.h"
#include "stats/tables/sample_check.h"

namespace icome::stats {
namespace {

constexpr double kInfiniteOdds = std::numeric_limits<double>::infinity();
constexpr double kLargestSupport = 1e6;

// The distribution of the first cell of a 2 x 2 table with given margins: Fisher's noncentral
// hypergeometric distribution, which the log of the odds ratio shifts.
class FirstCell {
 public:
  FirstCell(const CountTable& counts, const Margins& margins)
      : least_(std::max(0.0, margins.rows[0] - margins.columns[1])), seen_(counts[0][0] - least_) {
    const double most = std::min(margins.rows[0], margins.columns[0]);
    double log_weight = 0.0;
    for (double x = least_; x <= most; ++x) {
      log_weights_.push_back(log_weight);
      log_weight += std::log((margins.columns[0] - x) / (x + 1.0)) +
                    std::log((margins.rows[0] - x) / (margins.columns[1] - margins.rows[0] + x + 1.0));
    }
  }

  bool is_least() const { return seen_ == 0.0; }
  bool is_most() const { return seen_ + 1.0 == static_cast<double>(log_weights_.size()); }
  double seen() const { return seen_; }

  std::vector<double> shares(double log_odds) const {
    std::vector<double> shares = log_weights_;
    for (std::size_t i = 0; i < shares.size(); ++i) shares[i] += log_odds * static_cast<double>(i);
    const double greatest = *std::max_element(shares.begin(), shares.end());
    double total = 0.0;
    for (double& share : shares) total += share = std::exp(share - greatest);
    for (double& share : shares) share /= total;
    return shares;
  }

  double mean(double log_odds) const {
    const auto shares_now = shares(log_odds);
    double mean = 0.0;
    for (std::size_t i = 0; i < shares_now.size(); ++i) mean += static_cast<double>(i) * shares_now[i];
    return mean;
  }
  double at_most_seen(double log_odds) const {
    const auto shares_now = shares(log_odds);
    return sum_of(shares_now, 0, index());
  }
  double at_least_seen(double log_odds) const {
    const auto shares_now = shares(log_odds);
    return sum_of(shares_now, index(), shares_now.size() - 1);
  }
  double no_likelier_than_seen(double log_odds) const {
    const auto shares_now = shares(log_odds);
    const double most = shares_now[index()] * (1.0 + 1e-7);  // R's margin for equality but for rounding
    double sum = 0.0;
    for (const double share : shares_now)
      if (share <= most) sum += share;
    return std::min(1.0, sum);
  }

 private:
  std::size_t index() const { return static_cast<std::size_t>(seen_); }
  static double sum_of(const std::vector<double>& shares, std::size_t first, std::size_t last) {
    double sum = 0.0;
    for (std::size_t i = first; i <= last; ++i) sum += shares[i];
    return std::min(1.0, sum);
  }

  double least_;
  double seen_;  // counted from the least
  std::vector<double> log_weights_;
};

// The odds at which a rising function of the log odds is zero.
template <typename Function>
double odds_where_zero(Function&& rising) {
  double low = -1.0, high = 1.0;
  while (rising(low) > 0.0 && low > -700.0) low *= 2.0;
  while (rising(high) < 0.0 && high < 700.0) high *= 2.0;
  std::uintmax_t iterations = 200;
  const auto bracket = boost::math::tools::toms748_solve(
      rising, low, high, boost::math::tools::eps_tolerance<double>(46), iterations);
  return std::exp(0.5 * (bracket.first + bracket.second));
}

double likeliest_odds(const FirstCell& cell) {
  if (cell.is_least()) return 0.0;
  if (cell.is_most()) return kInfiniteOdds;
  return odds_where_zero([&](double log_odds) { return cell.mean(log_odds) - cell.seen(); });
}

ConfidenceInterval odds_interval(const FirstCell& cell, const FisherExactSettings& settings) {
  const bool two_sided = settings.alternative == Alternative::TwoSided;
  const double tail = (1.0 - settings.confidence) * (two_sided ? 0.5 : 1.0);
  ConfidenceInterval interval{0.0, kInfiniteOdds};
  if (settings.alternative != Alternative::Less && !cell.is_least())
    interval.low = odds_where_zero([&](double log_odds) { return cell.at_least_seen(log_odds) - tail; });
  if (settings.alternative != Alternative::Greater && !cell.is_most())
    interval.high = odds_where_zero([&](double log_odds) { return tail - cell.at_most_seen(log_odds); });
  return interval;
}

std::optional<base::Error> fisher_complaint(const CountTable& counts, const FisherExactSettings& settings) {
  constexpr std::string_view kName = "Fisher's exact test";
  if (auto error = table_complaint(kName, counts)) return error;
  if (auto error = confidence_complaint(kName, settings.confidence)) return error;
  if (counts.size() != 2 || counts.front().size() != 2)
    return base::Error{"Fisher's exact test: an odds ratio needs a table of 2 x 2; ask for the p value only"};
  if (!(settings.null_odds_ratio > 0.0 && std::isfinite(settings.null_odds_ratio)))
    return base::Error{"Fisher's exact test: the odds ratio to test against must be above 0, such as 1"};
  const Margins margins = margins_of(counts);
  if (std::min(margins.rows[0], margins.columns[0]) > kLargestSupport)
    return base::Error{"Fisher's exact test: too many counts; the chi-squared test is as good for these"};
  return std::nullopt;
}

}  // namespace

base::Result<FisherExact> fisher_exact_2x2(const CountTable& counts, const FisherExactSettings& settings) {
  if (auto error = fisher_complaint(counts, settings)) return tl::unexpected(*error);
  const FirstCell cell(counts, margins_of(counts));
  if (cell.is_least() && cell.is_most())
    return FisherExact{1.0, std::numeric_limits<double>::quiet_NaN(), {0.0, kInfiniteOdds}};
  FisherExact test;
  const double log_odds = std::log(settings.null_odds_ratio);
  if (settings.alternative == Alternative::Less) test.p = cell.at_most_seen(log_odds);
  if (settings.alternative == Alternative::Greater) test.p = cell.at_least_seen(log_odds);
  if (settings.alternative == Alternative::TwoSided) test.p = cell.no_likelier_than_seen(log_odds);
  test.odds_ratio = likeliest_odds(cell);
  test.interval = odds_interval(cell, settings);
  return test;
}

}  // namespace icome::stats
