#include "study/definition/counterbalancing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace icome::study {
namespace {

using Orders = std::vector<std::vector<std::size_t>>;

Orders cycle_of(OrderMethod method, std::size_t conditions) {
  Orders orders;
  for (std::size_t person = 0; person < order_count(method, conditions); ++person)
    orders.push_back(condition_order(method, conditions, 0, person, 1));
  return orders;
}

bool is_permutation_of_all(std::vector<std::size_t> order, std::size_t conditions) {
  std::ranges::sort(order);
  for (std::size_t i = 0; i < order.size(); ++i)
    if (order[i] != i) return false;
  return order.size() == conditions;
}

/// How often each condition is at each position; how often each comes just before each other.
using Counts = std::map<std::pair<std::size_t, std::size_t>, std::size_t>;

Counts positions_in(const Orders& orders) {
  Counts counts;
  for (const auto& order : orders)
    for (std::size_t i = 0; i < order.size(); ++i) ++counts[{order[i], i}];
  return counts;
}

Counts neighbours_in(const Orders& orders) {
  Counts counts;
  for (const auto& order : orders)
    for (std::size_t i = 0; i + 1 < order.size(); ++i) ++counts[{order[i], order[i + 1]}];
  return counts;
}

bool all_equal(const Counts& counts, std::size_t keys) {
  return counts.size() == keys &&
         std::ranges::all_of(counts, [&](const auto& one) { return one.second == counts.begin()->second; });
}

TEST(Counterbalancing, WilliamsSquaresBalancePositionsAndNeighbours) {
  for (std::size_t n = 1; n <= 13; ++n) {
    const Orders orders = cycle_of(OrderMethod::LatinSquare, n);
    EXPECT_EQ(orders.size(), n % 2 == 0 || n == 1 ? n : 2 * n) << n;
    for (const auto& order : orders) EXPECT_TRUE(is_permutation_of_all(order, n)) << n;
    EXPECT_TRUE(all_equal(positions_in(orders), n * n)) << n;
    EXPECT_TRUE(n == 1 || all_equal(neighbours_in(orders), n * (n - 1))) << n;
  }
}

TEST(Counterbalancing, FullHasEveryOrderOnce) {
  std::size_t factorial = 1;
  for (std::size_t n = 1; n <= kMostFullConditions; ++n) {
    factorial *= n;
    const Orders orders = cycle_of(OrderMethod::Full, n);
    EXPECT_EQ(orders.size(), factorial);
    EXPECT_EQ(std::set(orders.begin(), orders.end()).size(), factorial);
    for (const auto& order : orders) EXPECT_TRUE(is_permutation_of_all(order, n)) << n;
  }
}

/// A study that ends early is balanced in its positions all the same.
TEST(Counterbalancing, FullIsALatinSquareEveryFewPeople) {
  for (std::size_t n = 2; n <= 5; ++n) {
    const Orders orders = cycle_of(OrderMethod::Full, n);
    for (std::size_t first = 0; first < orders.size(); first += n)
      EXPECT_TRUE(all_equal(positions_in(Orders(orders.begin() + std::ptrdiff_t(first),
                                                orders.begin() + std::ptrdiff_t(first + n))),
                            n * n));
  }
}

TEST(Counterbalancing, OrdersBeginAnew) {
  EXPECT_EQ(condition_order(OrderMethod::LatinSquare, 2, 0, 0, 1),
            condition_order(OrderMethod::LatinSquare, 2, 1, 2, 9));
  EXPECT_NE(condition_order(OrderMethod::LatinSquare, 2, 0, 0, 1),
            condition_order(OrderMethod::LatinSquare, 2, 0, 1, 1));
}

TEST(Counterbalancing, FixedIsTheOrderOfTheFile) {
  EXPECT_EQ(condition_order(OrderMethod::Fixed, 3, 1, 7, 5), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(order_count(OrderMethod::Fixed, 3), 1U);
}

TEST(Counterbalancing, RandomIsTheSameForTheSamePersonAndSpreadOverAll) {
  std::map<std::vector<std::size_t>, int> seen;
  for (std::size_t person = 0; person < 6000; ++person) {
    const auto order = condition_order(OrderMethod::Random, 3, 2, person, 42);
    EXPECT_EQ(order, condition_order(OrderMethod::Random, 3, 2, person, 42));
    EXPECT_TRUE(is_permutation_of_all(order, 3));
    ++seen[order];
  }
  ASSERT_EQ(seen.size(), 6U);
  // 1000 are expected of each, with a standard deviation of 29.
  for (const auto& [order, count] : seen) EXPECT_NEAR(count, 1000, 5 * 29);
}

TEST(Counterbalancing, RandomDiffersBySeedAndGroup) {
  int by_seed = 0, by_group = 0;
  for (std::size_t person = 0; person < 100; ++person) {
    const auto order = condition_order(OrderMethod::Random, 6, 0, person, 1);
    by_seed += order != condition_order(OrderMethod::Random, 6, 0, person, 2) ? 1 : 0;
    by_group += order != condition_order(OrderMethod::Random, 6, 1, person, 1) ? 1 : 0;
  }
  EXPECT_GT(by_seed, 90);
  EXPECT_GT(by_group, 90);
}

}  // namespace
}  // namespace icome::study
