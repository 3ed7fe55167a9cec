#pragma once
#include <optional>

#include "geometry/contour/dual_contouring.h"

namespace icome::geometry {

/// Where the surface crosses the segment from `inner`, which is inside, to `outer`, which is not. Made fit
/// for arithmetic where the solid's answer is not (not finite, beside the segment): then the place is found
/// by asking `inside`, and the segment's direction stands for a normal that is none.
SurfacePoint find_crossing(const SampledSolid& solid, const Vector3& inner, const Vector3& outer);

/// The nearest crossing of the surface found along the line through `point`, either way, in a few steps of
/// growing length up to `reach`. Nothing when none is found or `direction` (unit) is zero.
std::optional<SurfacePoint> search_along(const SampledSolid& solid, const Vector3& point,
                                         const Vector3& direction, double reach);

/// The same in many steps, which also finds slivers of solid or space close to the point.
std::optional<SurfacePoint> search_finely_along(const SampledSolid& solid, const Vector3& point,
                                                const Vector3& direction, double reach);

}  // namespace icome::geometry
