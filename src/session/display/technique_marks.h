#pragma once
#include "render/scene/scene_renderer.h"
#include "session/hands/technique_hand.h"

namespace icome::session {

/// What is drawn over the scene of a technique at work: the line of a ray to what it meets, the cone of a
/// spotlight, the virtual hand where it is not the pointer itself, a box around what is pointed at, where one
/// would travel to, and the person's likeness in the miniature. Stage frame. The miniature itself is a copy
/// of the scene, and not of these.
render::SceneOverlay technique_marks(TechniqueHand& hand, const Session& session);

}  // namespace icome::session
