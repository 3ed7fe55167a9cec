#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "study/definition/study.h"

namespace icome::study {

/// The most conditions for which a study can use all orders (720).
constexpr std::size_t kMostFullConditions = 6;
/// The most conditions that a person could sit through.
constexpr std::size_t kMostConditions = 64;

/// The number of people in a group after which the orders begin anew; a group's size should be a multiple of
/// it: full n!, Latin square n or, of an odd n > 1, 2n; random and fixed 1. `conditions` is at least 1, and
/// for `full` at most kMostFullConditions.
std::size_t order_count(OrderMethod method, std::size_t conditions);

/// The order in which the `person`-th one (from 0) of the `group`-th group meets the conditions 0 ...
/// conditions - 1.
///
/// Full: all orders; each `conditions` people in turn have every condition once at every position.
/// Latin square: Williams's designs (1949), in which every condition also comes equally often just before
/// every other; one square of an even number of conditions, two of an odd one.
/// Random: all orders are equally likely, drawn by the seed, and always the same for the same person.
/// Fixed: 0, 1, 2, ...
std::vector<std::size_t> condition_order(OrderMethod method, std::size_t conditions, std::size_t group,
                                         std::size_t person, std::uint64_t seed);

}  // namespace icome::study
