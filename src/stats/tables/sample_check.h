#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::stats {

/// What every test refuses, in one sentence; `test` begins it, `what` names the sample ("the first group").
/// Nothing when there are at least `least` values and all are finite.
std::optional<base::Error> complaint(std::string_view test, std::string_view what,
                                     std::span<const double> values, std::size_t least);
/// The same for each of at least two groups, "group 1" being the first.
std::optional<base::Error> complaint(std::string_view test, const std::vector<std::vector<double>>& groups,
                                     std::size_t least);
/// Of a confidence level outside (0, 1), or within 1e-9 of 1.
std::optional<base::Error> confidence_complaint(std::string_view test, double confidence);

/// All values are equal (or there are none).
bool constant(std::span<const double> values);
/// A group after the other.
std::vector<double> joined(const std::vector<std::vector<double>>& groups);

}  // namespace icome::stats
