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

/// A motion of an answer. Null where it makes no sense, which is refused with the reader, or takes more
/// memory than there is.
world::MotionPointer motion_of(const flat::Motion& motion, world::FlatReader& reader,
                               io::MemoryBudget& memory);

/// What the motions of an answer were made of.
VrmlMoving what_moves(const flat::Scene& scene, world::FlatReader& reader);

}  // namespace icome::files
