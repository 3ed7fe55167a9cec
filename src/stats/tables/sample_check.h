#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::stats {

/// The error of every test for a sample that it refuses; `test` begins the sentence, `what` names the sample
/// ("the first group"). Nothing when there are at least `least` values and all are finite.
std::optional<base::Error> complaint(std::string_view test, std::string_view what,
                                     std::span<const double> values, std::size_t least);
/// As complaint() of one sample, for each of at least two groups, the first being "group 1".
std::optional<base::Error> complaint(std::string_view test, const std::vector<std::vector<double>>& groups,
                                     std::size_t least);
/// The error for a confidence level outside (0, 1) or within 1e-9 of 1, otherwise nothing.
std::optional<base::Error> confidence_complaint(std::string_view test, double confidence);

/// Are all values equal? True also of no values.
bool constant(std::span<const double> values);
/// The values of all groups, one group after the other.
std::vector<double> joined(const std::vector<std::vector<double>>& groups);

}  // namespace icome::stats
