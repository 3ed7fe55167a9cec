#pragma once
#include <vector>

#include "base/result.h"
#include "stats/tests/hypothesis.h"

namespace icome::stats {

/// Removes the overall differences between people from their values (a row for each person) in several
/// conditions: each row is moved to the mean of all (Cousineau 2005), and distances from the condition's mean
/// grow by sqrt(c / (c - 1)) for c conditions, to restore the variance that the moving removes (Morey 2008).
/// The conditions' means stay. Fails without rows, with fewer than two conditions, and on rows of different
/// lengths or a value that is not finite.
base::Result<std::vector<std::vector<double>>> without_person_differences(
    const std::vector<std::vector<double>>& rows);

/// A condition's mean and its within-subject confidence interval.
struct WithinInterval {
  double mean = 0.0;
  ConfidenceInterval interval;
};
/// Student's t intervals of without_person_differences(), one for each condition. They show how certain
/// the differences between conditions are, unlike those of plain values if everybody has all conditions.
/// Fails as that does, with fewer than two rows, and when the confidence is not between 0 and 1.
base::Result<std::vector<WithinInterval>> within_intervals(const std::vector<std::vector<double>>& rows,
                                                           double confidence = 0.95);

}  // namespace icome::stats
