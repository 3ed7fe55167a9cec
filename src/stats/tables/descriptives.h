#pragma once
#include <optional>
#include <span>
#include <vector>

#include "stats/tables/factor.h"

namespace icome::stats {

/// The descriptive statistics of a sample (thesis 6.4.1), in the unit of the values, the variance in its
/// square. NaN with too few values, or where values do not vary and the statistic divides by their spread.
struct Description {
  std::size_t n = 0;                // values that are not missing
  std::size_t missing = 0;          // NaN, left out
  double mean = 0.0;                // equation 6.1
  double median = 0.0;              // mean of the middle two of an even number
  std::vector<double> modes;        // most frequent values, ascending; none where none repeats
  double variance = 0.0;            // n - 1 in the denominator; NaN for one value
  double standard_deviation = 0.0;  // equation 6.2
  double minimum = 0.0, maximum = 0.0;
  double lower_quartile = 0.0;  // R's type 7, see quantile()
  double upper_quartile = 0.0;
  double skewness = 0.0;                   // G1, adjusted Fisher-Pearson (Joanes and Gill 1998), n > 2
  double excess_kurtosis = 0.0;            // G2 of the same paper, 0 for the normal distribution, n > 3
  double standard_error = 0.0;             // of the mean
  double confidence = 0.95;                // of the interval of the mean
  double mean_low = 0.0, mean_high = 0.0;  // interval of the mean, by Student's t
};

/// Describes a sample. Fails when no value is left after the missing ones (NaN), when one is infinite or
/// beyond 1e150, or when the confidence is not between 0 and 1.
base::Result<Description> describe(std::span<const double> values, double confidence = 0.95);

/// The quantile of a sample at a share, 0 <= share <= 1: linear between the order statistics at
/// share * (n - 1), which is type 7 of Hyndman and Fan (1996) and the default of R and NumPy. At least one
/// value, no NaN.
double quantile(std::span<const double> values, double share);

/// The distance of each value from the mean in standard deviations (equation 6.3); NaN stays NaN. Fails as
/// describe() does, and when the values do not vary.
base::Result<std::vector<double>> z_scores(std::span<const double> values);

/// A sample with and without its outliers, as the thesis asks (footnote 1 of 6.4.1).
struct OutlierReport {
  double limit = 2.0;                  // standard deviations
  std::vector<std::size_t> outliers;   // indices of the values, ascending
  Description with;                    // description of all values
  std::optional<Description> without;  // description of the others; none when all or none are outliers
};

/// Finds the values more than `limit` standard deviations from the mean; the rest is not searched again.
/// Values that do not vary have no outliers. Fails as describe() does, and when the limit is not above 0.
base::Result<OutlierReport> describe_outliers(std::span<const double> values, double limit = 2.0,
                                              double confidence = 0.95);

/// The description of the observations that share a level of every factor.
struct CellDescription {
  std::vector<int> levels;  // one for each factor: an index of its `levels`
  Description description;  // NaN counts as missing; n = 0 where all values are NaN
};

/// One description for every combination of levels that occurs, the last factor's levels running fastest.
/// Observations without a level are left out. Fails when a column is not as long as the values, and as
/// describe() does.
base::Result<std::vector<CellDescription>> describe_cells(std::span<const double> values,
                                                          std::span<const Factor> factors,
                                                          double confidence = 0.95);

}  // namespace icome::stats
