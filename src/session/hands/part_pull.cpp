#include "session/hands/part_pull.h"

#include <utility>

#include "session/session.h"

namespace icome::session {

base::Result<PartPull> PartPull::take(Session& session, const interaction::PlacedPart& part) {
  auto drag = interaction::PartDrag::take(session.world(), part);
  if (!drag) return tl::unexpected(drag.error());
  session.stage().mark_part(MarkedPart{.part = part, .motion = base::Affine3::Identity()});
  return PartPull(std::move(*drag));
}

base::Result<void> PartPull::to(Session& session, const base::Affine3& motion) {
  if (motion.matrix() == motion_.matrix()) return {};
  motion_ = motion;
  is_due_ = true;
  if (drag_.is_live()) return put(session);
  session.stage().mark_part(MarkedPart{.part = drag_.part(), .motion = motion_});
  return {};
}

base::Result<void> PartPull::put(Session& session) {
  if (!std::exchange(is_due_, false)) return {};
  const auto edit = drag_.by(motion_);
  if (!edit) return tl::unexpected(edit.error());
  auto done = performed_ ? session.history().extend(*edit) : session.history().perform(*edit, drag_.name());
  performed_ = performed_ || done.has_value();
  return done;
}

base::Result<void> PartPull::finish(Session& session) {
  session.stage().mark_part(std::nullopt);
  return put(session);
}

base::Result<void> PartPull::cancel(Session& session) {
  session.stage().mark_part(std::nullopt);
  is_due_ = false;
  return std::exchange(performed_, false) ? session.history().undo() : base::Result<void>();
}

}  // namespace icome::session
