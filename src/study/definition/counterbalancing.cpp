#include "study/definition/counterbalancing.h"

#include <algorithm>
#include <numeric>

#include "base/random.h"

namespace icome::study {
namespace {

using Order = std::vector<std::size_t>;

std::size_t factorial(std::size_t n) { return n < 2 ? 1 : n * factorial(n - 1); }

Order natural_order(std::size_t conditions) {
  Order order(conditions);
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

/// Every order is one that begins with condition 0, with a number added to all conditions: these
/// additions make a Latin square of each such order.
Order full_order(std::size_t conditions, std::size_t number) {
  Order order = natural_order(conditions);
  const std::size_t rounds = number / conditions;
  for (std::size_t i = 0; i < rounds; ++i) std::next_permutation(order.begin() + 1, order.end());
  for (std::size_t& condition : order) condition = (condition + number) % conditions;
  return order;
}

/// 0, 1, n-1, 2, n-2, ...: neighbours differ by every number once, so adding gives every pair of neighbours.
Order williams_order(std::size_t conditions, std::size_t number) {
  Order order(conditions);
  for (std::size_t i = 0; i < conditions; ++i)
    order[i] = ((i % 2 == 1 ? (i + 1) / 2 : conditions - i / 2) + number) % conditions;
  if (number >= conditions) std::ranges::reverse(order);
  return order;
}

Order shuffled_order(std::size_t conditions, std::size_t group, std::size_t person, std::uint64_t seed) {
  // Each number goes through the generator, so that neighbours have nothing in common.
  const std::uint64_t of_group = base::Random(seed).bits() ^ group;
  base::Random random(base::Random(of_group).bits() ^ person);
  Order order = natural_order(conditions);
  for (std::size_t left = conditions; left > 1; --left) std::swap(order[left - 1], order[random.index(left)]);
  return order;
}

}  // namespace

std::size_t order_count(OrderMethod method, std::size_t conditions) {
  switch (method) {
    case OrderMethod::Full:
      return factorial(conditions);
    case OrderMethod::LatinSquare:
      return conditions % 2 == 1 && conditions > 1 ? 2 * conditions : conditions;
    case OrderMethod::Random:
      break;
    case OrderMethod::Fixed:
      break;
  }
  return 1;
}

std::vector<std::size_t> condition_order(OrderMethod method, std::size_t conditions, std::size_t group,
                                         std::size_t person, std::uint64_t seed) {
  const std::size_t number = person % order_count(method, conditions);
  switch (method) {
    case OrderMethod::Full:
      return full_order(conditions, number);
    case OrderMethod::LatinSquare:
      return williams_order(conditions, number);
    case OrderMethod::Random:
      return shuffled_order(conditions, group, person, seed);
    case OrderMethod::Fixed:
      break;
  }
  return natural_order(conditions);
}

}  // namespace icome::study
