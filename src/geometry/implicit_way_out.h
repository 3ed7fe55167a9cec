#pragma once
#include <optional>

#include "geometry/formula.h"
#include "geometry/primitive.h"

namespace icome::geometry {

/// A place on the formula's surface within the box near `point`, which is inside: the nearest of those that
/// rays in all directions lead to, followed down to the nearest place around. Nothing if no ray leads to
/// one. Real-time safe.
std::optional<SurfacePoint> implicit_way_out(const Formula& formula, const Bounds& box, const Vector3& point,
                                             double time);

}  // namespace icome::geometry
