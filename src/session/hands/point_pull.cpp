#include "session/hands/point_pull.h"

#include <utility>

#include "session/session.h"

namespace icome::session {

base::Result<PointPull> PointPull::take(Session& session, const interaction::ShapingHandle& handle) {
  if (!session.hands().shaping()) return base::fail("Points of shapes are not what is dragged now.");
  auto drag = session.hands().shaping()->take(session.world(), handle);
  if (!drag) return tl::unexpected(drag.error());
  return PointPull({handle, std::make_shared<const interaction::PointDrag>(std::move(*drag))});
}

base::Result<void> PointPull::to(Session& session, const base::Vector3& offset) {
  if (offset == moved_) return {};
  const world::Edit edit = marked_.drag->by(offset);
  auto done =
      performed_ ? session.history().extend(edit) : session.history().perform(edit, marked_.drag->name());
  if (!done) return done;
  performed_ = true;
  moved_ = offset;
  if (session.hands().shaping()) session.hands().shaping()->moved(session.world(), marked_.handle, offset);
  return {};
}

base::Result<void> PointPull::finish(Session& session) {
  if (!performed_) return {};
  const auto last = marked_.drag->last(moved_);
  if (!last) return {};
  auto done = session.history().extend(*last);
  if (done && session.hands().shaping())
    session.hands().shaping()->moved(session.world(), marked_.handle, moved_);
  return done;
}

base::Result<void> PointPull::cancel(Session& session) {
  if (!std::exchange(performed_, false)) return {};
  auto undone = session.history().undo();
  if (undone && session.hands().shaping())
    session.hands().shaping()->moved(session.world(), marked_.handle, base::Vector3::Zero());
  return undone;
}

}  // namespace icome::session
