#pragma once
#include <optional>

#include "geometry/primitive/primitive.h"

namespace icome::geometry {

/// The first t in [0, 1] at which start + t * step goes through the primitive's surface, from outside or from
/// within, in closed form; nothing where it does not, or touches without going through. Sizes as
/// parse_primitive accepts them. Real-time safe.
std::optional<double> first_crossing(const Primitive& primitive, const Vector3& start, const Vector3& step);

}  // namespace icome::geometry
