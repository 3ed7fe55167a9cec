#pragma once
#include <map>
#include <string>

#include "stats_samples.h"

namespace icome::benchmarks {

/// F by term.
using FValues = std::map<std::string, double>;

// The sums that textbooks compute by hand: of the values and of their squares, in one pass, and differences
// of these. Nothing is checked.

/// A single factor.
FValues textbook_one_way(const StatsSample& sample);
/// Two factors, type II: reductions by least squares, from the normal equations.
FValues textbook_factorial(const StatsSample& sample);
/// A subject and two factors within subjects, an observation in each cell.
FValues textbook_repeated(const StatsSample& sample);

}  // namespace icome::benchmarks
