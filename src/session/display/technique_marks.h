#pragma once
#include "render/scene/scene_renderer.h"
#include "session/hands/technique_hand.h"

namespace icome::session {

/// The marks of a technique at work, drawn over the scene: the line of a ray to its hit, the cone of a
/// spotlight, the virtual hand where it is not the pointer itself, a box around the target, the place where
/// one would travel to, and the person's likeness in the miniature. Stage frame. The miniature itself is a
/// copy of the scene, and not one of these.
render::SceneOverlay technique_marks(TechniqueHand& hand, const Session& session);

}  // namespace icome::session
