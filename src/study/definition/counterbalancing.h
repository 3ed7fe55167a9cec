#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "study/definition/study.h"

namespace icome::study {

/// More conditions than this have too many orders (720) for a study to use them all.
constexpr std::size_t kMostFullConditions = 6;
/// More conditions than this are no study that a person could sit through.
constexpr std::size_t kMostConditions = 64;

/// After how many people of a group the orders begin anew, which is what a group's size should be a multiple
/// of: full n!, Latin square n or, of an odd n, 2n; random and fixed 1. `conditions` is at least 1, and for
/// `full` at most kMostFullConditions.
std::size_t order_count(OrderMethod method, std::size_t conditions);

/// The order in which the `person`-th one (from 0) of the `group`-th group meets the conditions 0 ...
/// conditions - 1.
///
/// Full: all orders; each `conditions` people in turn have every condition once at every position.
/// Latin square: Williams's designs (1949), in which every condition also comes equally often just before
/// every other; one square of an even number of conditions, two of an odd one.
/// Random: any order with the same chance, by the seed, the same again for the same person.
/// Fixed: 0, 1, 2, ...
std::vector<std::size_t> condition_order(OrderMethod method, std::size_t conditions, std::size_t group,
                                         std::size_t person, std::uint64_t seed);

}  // namespace icome::study
