#pragma once
#include "session/session.h"

namespace icome::ui {

// Sharing of shapes and materials between the selected objects and others, and edits that end it. Each edit
// is one action to undo.

/// Does an object that is not selected share a shape with one that is?
bool shares_shapes(const session::Session& session);
/// Gives the selected objects shapes of their own. Those among them that share one go on sharing.
base::Result<void> make_own_shapes(session::Session& session);

/// Has a selected object no material, or one that it shares with others that are not selected?
bool needs_own_materials(const session::Session& session);
/// Gives them materials of their own; objects without one get a new one like the default, which they share.
base::Result<void> make_own_materials(session::Session& session);

/// Gives the selected objects this material; none: the default.
base::Result<void> choose_material(session::Session& session, world::MaterialId material);

}  // namespace icome::ui
