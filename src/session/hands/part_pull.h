#pragma once
#include <utility>

#include "interaction/shaping/placed_part.h"

namespace icome::session {

class Session;

/// A drag of an operand of a solid, or of the projector of a picture: one action to undo, however many steps
/// it has. The part is marked as long as it lasts. One thread (main) uses it.
class PartPull {
 public:
  /// Takes hold; nothing has moved yet. Fails as PartDrag::take() does.
  static base::Result<PartPull> take(Session& session, const interaction::PlacedPart& part);

  /// Carries the held part from where it was along with a motion of the world.
  base::Result<void> to(Session& session, const base::Affine3& motion);
  /// Lets go, and does what has to be done once at the end.
  base::Result<void> finish(Session& session);
  /// Brings it back to where it was, as if it had never been dragged.
  base::Result<void> cancel(Session& session);

  const interaction::PartDrag& drag() const { return drag_; }
  /// Has it moved, so that there is an action?
  bool performed() const { return performed_; }

 private:
  explicit PartPull(interaction::PartDrag drag) : drag_(std::move(drag)) {}
  base::Result<void> put(Session& session);

  interaction::PartDrag drag_;
  base::Affine3 motion_ = base::Affine3::Identity();  // so far
  bool performed_ = false;
  bool is_due_ = false;  // the motion is not an edit yet
};

}  // namespace icome::session
