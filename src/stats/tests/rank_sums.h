#pragma once
#include <vector>

namespace icome::stats {

/// Exact null distributions of rank statistics without ties, as probabilities of each value from 0.

/// The distribution of U for groups of these sizes: the share of the orders that give each U from 0 to m n.
std::vector<double> rank_sum_distribution(int first_size, int second_size);
/// The distribution of the positive rank sum V of `count` differences, 0 to n (n + 1) / 2.
std::vector<double> signed_rank_distribution(int count);
/// The distribution of S, the sum of squared rank differences, at 0, 2, 4, ..., by enumeration; count <= 9.
std::vector<double> spearman_distribution(int count);

/// The sums of probabilities of places 0 to `value`, and from `value` on.
double share_up_to(const std::vector<double>& distribution, double value);
double share_from(const std::vector<double>& distribution, double value);

}  // namespace icome::stats
