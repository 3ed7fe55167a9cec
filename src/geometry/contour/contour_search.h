#pragma once
#include <optional>

#include "geometry/contour/dual_contouring.h"

namespace icome::geometry {

/// The crossing of the surface with the segment from `inner`, which is inside, to `outer`, which is not.
/// Unusable answers of the solid are replaced: a place that is not finite or beside the segment by bisection
/// with `inside`, a normal without direction by the segment's direction.
SurfacePoint find_crossing(const SampledSolid& solid, const Vector3& inner, const Vector3& outer);

/// The nearest crossing of the surface found along the line through `point`, either way, in a few steps of
/// growing length up to `reach`. Nothing when none is found or `direction` (unit) is zero.
std::optional<SurfacePoint> search_along(const SampledSolid& solid, const Vector3& point,
                                         const Vector3& direction, double reach);

/// Like search_along, but in many steps: also finds slivers of solid or space close to the point.
std::optional<SurfacePoint> search_finely_along(const SampledSolid& solid, const Vector3& point,
                                                const Vector3& direction, double reach);

}  // namespace icome::geometry
