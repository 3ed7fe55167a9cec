#pragma once
#include <optional>

#include "haptics/contact/haptic_scene.h"
#include "interaction/mouse_hand.h"

namespace icome::session {

/// What a ray meets first.
struct PickedThing {
  base::ObjectId object;           // in the haptic scene
  interaction::PickedPoint place;  // world frame of the scene
};

/// The first surface that the ray meets of what can be touched, seen from its front or its back, where
/// objects are `elapsed` seconds after the moment of their poses; nothing where there is none. Uses the trees
/// that the servo uses, and asks each shape itself: a surface is met as what it is, not as what is drawn of
/// it. What has no end, such as a plane, is met up to a thousand times as far as its origin.
std::optional<PickedThing> pick(const haptics::HapticScene& scene, const interaction::Ray& ray,
                                double elapsed = 0.0);

}  // namespace icome::session
