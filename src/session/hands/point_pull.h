#pragma once
#include <memory>
#include <optional>

#include "interaction/shaping/shaping.h"

namespace icome::session {

class Session;

/// A drag of a vertex, an edge, a face or a lattice's point, by mouse or hand: one action to undo, however
/// many steps it has. The session is shaping as long as it lasts. One thread (main) uses it.
class PointPull {
 public:
  /// Takes hold; nothing has moved yet. Fails as Shaping::take() does.
  static base::Result<PointPull> take(Session& session, const interaction::ShapingHandle& handle);

  /// Moves the held handle by the offset (m, stage frame) from where it was.
  base::Result<void> to(Session& session, const base::Vector3& offset);
  /// Lets go, and does what has to be done once at the end.
  base::Result<void> finish(Session& session);
  /// Brings it back to where it was, as if it had never been dragged.
  base::Result<void> cancel(Session& session);

  const interaction::MarkedHandle& marked() const { return marked_; }
  /// Has it moved, so that there is an action?
  bool performed() const { return performed_; }

 private:
  explicit PointPull(interaction::MarkedHandle marked) : marked_(std::move(marked)) {}

  interaction::MarkedHandle marked_;             // with its drag
  base::Vector3 moved_ = base::Vector3::Zero();  // m, so far
  bool performed_ = false;
};

}  // namespace icome::session
