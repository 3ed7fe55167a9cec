#pragma once
#include <array>

#include "base/vector.h"

namespace icome::interaction {

using base::Pose;
using base::Vector3;

/// One hand, or what it holds, as a tracker gives it. It points along its -z, y up.
struct HandInput {
  bool tracked = false;
  Pose room_from_hand = Pose::Identity();
  bool grab = false;    // button: selects, and holds what is selected
  bool travel = false;  // button: moves the person
  double reel = 0.0;    // [-1, 1]; > 0 pushes what is held on a ray away
};

/// The state of all devices at one moment: all that a technique reads besides the scene. Poses are in the
/// room's frame (m, y up), which stands somewhere in the world: travelling moves that place, and the hands
/// with it.
struct TechniqueInput {
  double time = 0.0;  // s, rises from step to step
  Pose room_from_head = Pose::Identity();
  std::array<HandInput, 2> hands = {};  // the one that points first, then the other
};

/// Are all numbers finite, and poses rigid and within 1e6 m? A technique ignores any other input.
bool makes_sense(const TechniqueInput& input);

}  // namespace icome::interaction
