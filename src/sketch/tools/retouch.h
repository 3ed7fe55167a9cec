#pragma once
#include "sketch/drawn.h"

namespace icome::sketch {

/// The curve with its width at `place` multiplied by `factor` (>= 0), and less and less changed up to `reach`
/// (m, > 0) along the line on both sides (thesis 4.5.5, change curve width). Width segments are cut where the
/// change begins, is greatest and ends.
Curve width_changed(const Curve& curve, double place, double factor, double reach);

/// The samples of a curve that smoothed() needs for a distance, and how many it may need: with more it would
/// take minutes.
double smoothing_samples(const Curve& curve, double distance);
constexpr double kMostSmoothingSamples = 50'000.0;

/// A smoother curve within `distance` (m, > 0) of the curve: fewer segments, and no corners but those that
/// take more than that. Its width follows the old one along its length. A closed curve stays closed.
/// Precondition: at most kMostSmoothingSamples.
Curve smoothed(const Curve& curve, double distance);

/// The place that lies a length (m, also negative) along the curve from `place`, or the end on the way there.
double place_along(const Curve& curve, double place, double length);

}  // namespace icome::sketch
