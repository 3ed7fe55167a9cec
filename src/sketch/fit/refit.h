#pragma once
#include <vector>

#include "sketch/fit/cubic_fit.h"
#include "sketch/fit/smooth_spline.h"

namespace icome::sketch {

/// Few cubics within a distance of a path between two of its points, turning without a break from one to the
/// next. First the fewest cubics whose ends lie on the path and may break (each as long as it can be: since a
/// part of what can be fitted can be fitted, that is what dynamic programming would find); then these with
/// common directions, moved to where the distances are least, and cut or joined where that is needed or
/// possible. `within` is in the path's units; places between those looked at may be a little farther.
std::vector<CubicBezier> few_cubics(const StrokePath& path, std::size_t first, std::size_t last,
                                    double within);

/// The fewest cubics with their ends on points of the path, each within a distance of its part.
std::vector<CubicFit> fewest_breaking_cubics(const StrokePath& path, std::size_t first, std::size_t last,
                                             double within);

}  // namespace icome::sketch
