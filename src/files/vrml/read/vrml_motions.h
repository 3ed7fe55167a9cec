#pragma once
#include "files/vrml/read/vrml_scanner.h"
#include "io/memory_budget.h"
#include "world/edit/flat_bytes.h"
#include "world/world.h"

namespace icome::files {

namespace flat {
struct Motion;
struct Scene;
}  // namespace flat

/// A motion of an answer. Null where it is invalid, which the reader is told as a fault, or takes more
/// memory than there is.
world::MotionPointer motion_of(const flat::Motion& motion, world::FlatReader& reader,
                               io::MemoryBudget& memory);

/// The sources of the motions in an answer.
VrmlMoving what_moves(const flat::Scene& scene, world::FlatReader& reader);

}  // namespace icome::files
