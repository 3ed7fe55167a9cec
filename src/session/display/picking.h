#pragma once
#include <optional>

#include "haptics/contact/haptic_scene.h"
#include "interaction/mouse_hand.h"

namespace icome::session {

/// The first thing that a ray meets.
struct PickedThing {
  base::ObjectId object;           // in the haptic scene
  interaction::PickedPoint place;  // world frame of the scene
};

/// The first touchable surface that the ray meets, from its front or its back, with objects as they are
/// `elapsed` seconds after the moment of their poses; nothing where there is none. Uses the trees that the
/// servo uses, and the shapes themselves: a surface is met as it is, not as it is drawn. Shapes without an
/// end, such as planes, are met up to a thousand times as far as their origin.
std::optional<PickedThing> pick(const haptics::HapticScene& scene, const interaction::Ray& ray,
                                double elapsed = 0.0);

}  // namespace icome::session
