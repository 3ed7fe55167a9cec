#pragma once
#include "interaction/techniques/technique_input.h"

namespace icome::interaction {

/// A world in miniature (thesis 2.2.2; Stoakley, Conway and Pausch 1995): a small copy of the world that
/// stands above the other hand and turns with it; without that hand it floats before the person, turned as
/// the world is. A person's head is followed where it turns to, not where it nods; a camera that stands for
/// one (on a desk) is followed wherever it looks, or it would lose sight of the copy.
struct MiniatureSettings {
  double size = 0.4;            // m, its longest side; 0.2 to 0.6
  double above_hand = 0.05;     // m, from the other hand to its floor
  double before = 0.45;         // m, ahead of the eyes, while no hand holds it
  double below = 0.25;          // m, under the eyes, likewise
  bool keeps_in_sight = false;  // its middle is placed by the eyes' own axes, not its floor by level ones
  base::Bounds shown = {};      // m, of the world; empty: all that there is
};

/// The map from a place of the world to its copy; both in the world's frame. `all` is the box around the
/// world; where that is empty and the settings say nothing, a box of 1 m around the origin is shown.
base::Affine3 copy_from_world(const MiniatureSettings& settings, const base::Bounds& all,
                              const TechniqueInput& input, const base::Affine3& world_from_room);

}  // namespace icome::interaction
