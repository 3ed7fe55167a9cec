#pragma once
#include <string>
#include <vector>

#include "study/definition/study.h"

namespace icome::study {

/// One level of each of several factors, as numbers of the levels; empty where there is no factor.
using Crossing = std::vector<std::size_t>;

/// The factors of one kind, in the order of the study.
std::vector<const IndependentVariable*> factors_of(const Study& study, bool between);

/// Every combination of levels of the factors of one kind, the last factor varying fastest: the conditions
/// that each person has (within), or the groups of people (between). One empty crossing where there is no
/// such factor.
std::vector<Crossing> crossings(const Study& study, bool between);

/// The number of crossings() up to `limit`; more than that count as `limit` + 1.
std::size_t crossing_count(const Study& study, bool between, std::size_t limit);

/// "with, near": the ids of its levels; "all" for the empty crossing.
std::string crossing_name(const Study& study, bool between, const Crossing& crossing);

}  // namespace icome::study
