#pragma once
#include <optional>
#include <span>
#include <vector>

#include "base/vector.h"

namespace icome::interaction {

// Figures of pointing tasks as ISO 9241-411 has them, with the Shannon form of Fitts' law (MacKenzie 1992).

/// One movement from the last target to the next, and the place of the selection; world frame, m.
struct FittsTrial {
  base::Vector3 start = base::Vector3::Zero();
  base::Vector3 target = base::Vector3::Zero();    // its centre
  base::Vector3 endpoint = base::Vector3::Zero();  // of the pointer, when the button went down
  double time = 0.0;                               // s
  bool hit = true;
};

/// log2(amplitude / width + 1), bits; amplitude >= 0, width > 0.
double index_of_difficulty(double amplitude, double width);

/// Mean and standard deviation (of the sample; 0 for less than two).
struct MeanAndDeviation {
  double mean = 0.0, deviation = 0.0;
};
MeanAndDeviation mean_and_deviation(std::span<const double> values);

/// Figures of one person in one condition. Endpoints are projected on the way from start to target.
struct EffectiveFigures {
  double width;       // m: 4.133 standard deviations of the endpoints
  double amplitude;   // m: mean of the ways really gone
  double throughput;  // bit/s: log2(amplitude / width + 1) over the mean time
};
/// The figures of trials; nothing for less than two, and where all ended in the same place or took no time.
std::optional<EffectiveFigures> effective_figures(std::span<const FittsTrial> trials);

/// A straight line through points by least squares.
struct FittedLine {
  double intercept;  // s
  double slope;      // s/bit
  double r_squared;  // 1 where all points lie on it
};
/// The line of times (y) on indices of difficulty (x). Nothing where all x are the same.
std::optional<FittedLine> fitted_line(std::span<const base::Vector2> points);

}  // namespace icome::interaction
