#include "interaction/head/head_motion.h"

namespace icome::interaction {

void HeadMotion::set_rest(const base::Pose& tracker_from_rest) {
  tracker_from_rest_ = tracker_from_rest;
  has_rest_ = true;
}

void HeadMotion::recentre() {
  if (!filter_.is_empty()) set_rest(filter_.steady().pose());
}

base::Pose HeadMotion::steady_from_rest() const {
  return tracker_from_rest_.inverse() * filter_.ahead().pose();
}

base::Pose HeadMotion::moved(const base::Pose& tracker_from_head, double time) {
  filter_.take(tracker_from_head, time);
  if (!has_rest_) recentre();
  return transferred(steady_from_rest(), transfer_);
}

}  // namespace icome::interaction
