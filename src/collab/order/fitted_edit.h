#pragma once
#include "world/edit/shared_edit.h"

namespace icome::collab {

/// Performs an edit as world::perform_shared does, but an object that goes behind more siblings
/// than there are (any more) goes behind the last. The same edit on equal worlds gives equal worlds, so
/// servers and replicas that apply the same edits in the same order stay equal.
base::Result<world::SharedEdit> apply_fitted(world::World& world, const world::Edit& edit);

}  // namespace icome::collab
