#include "session/surroundings.h"

#include <algorithm>

namespace icome::session {

void Surroundings::follow(const world::Changes* changes) {
  if (!changes) {
    index_.reset();
    finder_ = interaction::SnapFinder();
    objects_.clear();
    geometries_.clear();
  }
  if (!changes || !index_) return;
  objects_.insert(changes->objects.begin(), changes->objects.end());
  geometries_.insert(changes->geometries.begin(), changes->geometries.end());
}

void Surroundings::catch_up() {
  if (!index_) {
    index_.emplace(world_);
    return;
  }
  if (objects_.empty() && geometries_.empty()) return;
  world::Changes changes;
  changes.objects.assign(objects_.begin(), objects_.end());
  changes.geometries.assign(geometries_.begin(), geometries_.end());
  // Tables keep no order that could be repeated.
  std::ranges::sort(changes.objects);
  std::ranges::sort(changes.geometries);
  objects_.clear();
  geometries_.clear();
  index_->follow(world_, changes);
  finder_.follow(changes);
}

world::CollisionIndex& Surroundings::index() {
  catch_up();
  return *index_;
}

interaction::SnapFinder& Surroundings::finder() {
  catch_up();
  return finder_;
}

}  // namespace icome::session
