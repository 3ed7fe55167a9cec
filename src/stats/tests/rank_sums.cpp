#include "stats/tests/rank_sums.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace icome::stats {
namespace {

// Arguments are computed whole numbers, of which less than half a step is rounding.
constexpr double kRounding = 0.25;

}  // namespace

std::vector<double> rank_sum_distribution(int first_size, int second_size) {
  // With probability i / (i + j) the greatest value of all is one of the i of the first group, and exceeds
  // all j of the second then (Mann and Whitney 1947). Only positive terms: nothing cancels.
  std::vector<std::vector<double>> of_first(static_cast<std::size_t>(first_size) + 1, {1.0});
  for (int j = 1; j <= second_size; ++j) {
    for (int i = 1; i <= first_size; ++i) {
      auto& now = of_first[static_cast<std::size_t>(i)];
      const auto& one_less = of_first[static_cast<std::size_t>(i) - 1];
      const double first_share = static_cast<double>(i) / (i + j);
      for (double& share : now) share *= 1.0 - first_share;
      now.resize(static_cast<std::size_t>(i) * j + 1, 0.0);
      for (std::size_t u = 0; u < one_less.size(); ++u)
        now[u + static_cast<std::size_t>(j)] += first_share * one_less[u];
    }
  }
  return of_first.back();
}

std::vector<double> signed_rank_distribution(int count) {
  std::vector<double> shares = {1.0};
  for (int rank = 1; rank <= count; ++rank) {
    const std::size_t before = shares.size();
    for (double& share : shares) share *= 0.5;
    shares.resize(before + static_cast<std::size_t>(rank), 0.0);
    for (std::size_t v = before; v-- > 0;) shares[v + static_cast<std::size_t>(rank)] += shares[v];
  }
  return shares;
}

std::vector<double> spearman_distribution(int count) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::vector<double> shares(static_cast<std::size_t>((count * count * count - count) / 6) + 1, 0.0);
  double orders = 0.0;
  do {
    int s = 0;
    for (int i = 0; i < count; ++i) {
      const int difference = order[static_cast<std::size_t>(i)] - i;
      s += difference * difference;
    }
    shares[static_cast<std::size_t>(s / 2)] += 1.0;
    orders += 1.0;
  } while (std::next_permutation(order.begin(), order.end()));
  for (double& share : shares) share /= orders;
  return shares;
}

double share_up_to(const std::vector<double>& distribution, double value) {
  double total = 0.0;
  for (std::size_t i = 0; i < distribution.size() && static_cast<double>(i) <= value + kRounding; ++i)
    total += distribution[i];
  return std::min(1.0, total);
}

double share_from(const std::vector<double>& distribution, double value) {
  double total = 0.0;
  for (std::size_t i = distribution.size(); i-- > 0 && static_cast<double>(i) >= value - kRounding;)
    total += distribution[i];
  return std::min(1.0, total);
}

}  // namespace icome::stats
