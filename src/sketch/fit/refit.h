#pragma once
#include <vector>

#include "sketch/fit/cubic_fit.h"
#include "sketch/fit/smooth_spline.h"

namespace icome::sketch {

/// Few cubics within a distance of a path between two of its points, turning without a break from one to the
/// next. First cubics that may break, each as long as it can be: for the distance and for several times it.
/// Then these with common directions, moved to where the distances are least, cut where that is needed, and
/// with joints taken out and rows of segments shortened by one where that is possible: what takes fewer of
/// both beginnings. `within` is in the path's units; places between those looked at may be a little farther.
std::vector<CubicBezier> few_cubics(const StrokePath& path, std::size_t first, std::size_t last,
                                    double within);

/// Cubics with their ends on points of the path, each within a distance of its part and as long as was found.
/// Dynamic programming, which lets one be shorter for the sake of the next, may find fewer.
std::vector<CubicBezier> fewest_breaking_cubics(const StrokePath& path, std::size_t first, std::size_t last,
                                                double within);

}  // namespace icome::sketch
