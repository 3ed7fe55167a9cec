#pragma once
#include <optional>

#include "haptics/contact/haptic_scene.h"

namespace icome::haptics {

/// Finds a place for a tip that is inside solids, as it may be at its start and when an object appears
/// around it: a place outside of every solid of the scene that is touched from the front, in the frame. The
/// nearest place on the surface of a solid that holds it, if no other solid holds that; else the first free
/// place in one of some directions, whichever comes soonest, from where the tip draws the SCP as near as it
/// can come. Nothing where the place is free already, or none was found. Each shape decides itself what is
/// inside (Shape::way_out). For single moments, not for every tick; real-time safe.
std::optional<Vector3> place_outside(const HapticScene& scene, const ContactRegion::Frame& frame,
                                     const Vector3& place);

}  // namespace icome::haptics
