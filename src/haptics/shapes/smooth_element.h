#pragma once
// The functions of element.h for elements that are pieces of a geometry::SmoothSurface. Positions as there.
#include "haptics/shapes/element.h"

namespace icome::haptics {

Footing smooth_footing(const Element& element, const Vector3& position);
bool smooth_covers(const Element& element, const Vector3& position, const Tolerance& tolerance);
Vector3 smooth_settle(const Element& element, const Vector3& position, const Tolerance& tolerance);
std::optional<double> smooth_sweep(Element& element, const Vector3& start, const Vector3& step,
                                   const Tolerance& tolerance);

/// The result of settle() of element.h, and whether the walk there came to its end; the element remembers
/// the place, as the tip is likely to go there. Real-time safe.
struct SettledAhead {
  Vector3 place;
  bool sure;
};
SettledAhead settle_ahead(Element& element, const Vector3& position, const Tolerance& tolerance);

/// Makes the foot of `position` the one from which the next feet are found. Real-time safe.
void follow_projection(Element& element, const Vector3& position);

/// Is the position of a point tip within the surface's solid? False where that takes long to tell. Real-time
/// safe.
bool has_swallowed(const Element& element, const Vector3& position);

/// Velocity of the surface itself, along its normal, at `position` (m/s). Real-time safe.
Vector3 smooth_velocity(const Element& element, const Vector3& position);

}  // namespace icome::haptics
