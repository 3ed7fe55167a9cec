#pragma once
#include <optional>

#include "speech/dialogue/references.h"

namespace icome::speech {

/// The box in the middle of which something of these bounds stands beside the reference, in the viewer's
/// frame: on the floor that it stands on, a quarter of its own size away. `side` as of the rule side. Where
/// `others` are in the way it stands farther away on that side; "near", on the first side that is free; "on",
/// at the free place on top that is nearest to the middle, or else on what lies there.
Vector3 middle_beside(const std::string& side, const Bounds& bounds, const Bounds& reference,
                      const ViewerAxes& axes, const std::vector<Bounds>& others);

/// The middle of the first free place for something of these bounds: the origin, then places round it.
Vector3 free_middle(const Bounds& bounds, const std::vector<Bounds>& others);

/// The place where something of these bounds is to have its middle (m, world frame), as a phrase of the rule
/// where says it; `moved` are left out of what is in the way. Fails as references do, and where the hand is
/// meant and there is none.
base::Result<Vector3> said_middle(const Phrase& where, const Bounds& bounds, References& references,
                                  const Situation& at, const std::vector<ObjectId>& moved);

/// The bounds of the top objects of the design, but for some.
std::vector<Bounds> bounds_of_others(const world::World& world, const std::vector<ObjectId>& but);

}  // namespace icome::speech
