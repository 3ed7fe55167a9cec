#include "session/hands/surroundings.h"

#include <algorithm>
#include <cassert>

namespace icome::session {
namespace {

/// Effort to prepare, once, all standing shapes that are not prepared yet.
std::uint64_t effort_to_make(world::CollisionIndex& index) {
  std::uint64_t units = 0;
  for (const auto& it : index.standing()) units += it.shape->effort_to_make();
  return units;
}

}  // namespace

Surroundings::~Surroundings() {
  if (work_) work_->give_up();
}

void Surroundings::follow(const world::Changes* changes) {
  if (work_) work_->is_stale_ = true;
  if (!changes) {
    around_.reset();
    objects_.clear();
    geometries_.clear();
  }
  if (!changes || !around_) return;
  objects_.insert(changes->objects.begin(), changes->objects.end());
  geometries_.insert(changes->geometries.begin(), changes->geometries.end());
}

Surroundings::Around& Surroundings::around() {
  assert(!are_lent());
  if (!around_) {
    around_ = std::make_shared<Around>(world_);
    return *around_;
  }
  if (objects_.empty() && geometries_.empty()) return *around_;
  world::Changes changes;
  changes.objects.assign(objects_.begin(), objects_.end());
  changes.geometries.assign(geometries_.begin(), geometries_.end());
  // Tables keep no order that could be repeated.
  std::ranges::sort(changes.objects);
  std::ranges::sort(changes.geometries);
  objects_.clear();
  geometries_.clear();
  around_->index.follow(world_, changes);
  around_->finder.follow(changes);
  return *around_;
}

world::CollisionIndex& Surroundings::index() { return around().index; }

interaction::SnapFinder& Surroundings::finder() { return around().finder; }

std::shared_ptr<Surroundings::Work> Surroundings::work_out(const interaction::StoppedDrag& drag,
                                                           const base::Vector3& wanted,
                                                           const interaction::DragRules& rules,
                                                           std::uint64_t effort) {
  (void)around();
  work_ = std::make_shared<Work>();
  // The world is asked for nothing but the places that things snap to.
  auto world = std::make_shared<const world::World>(rules.snaps.any() ? world_ : world::World());
  using Found = interaction::StoppedDrag::Found;
  const auto look = [around = around_, world = std::move(world), drag, wanted, rules, effort,
                     given_up = &work_->given_up_]() -> base::Result<Found> {
    for (;;) {
      const std::uint64_t to_make = effort_to_make(around->index);
      world::Effort left(effort, given_up);
      auto found = drag.find(*world, around->index, around->finder, wanted, rules, &left);
      const bool in_vain = found && found->spent && found->move.move.offset.isZero(0.0) && !*given_up;
      // If all of it went into preparing shapes, they are ready now, and the way can be looked at.
      if (!in_vain || effort_to_make(around->index) == to_make) return found;
    }
  };
  work_->task_ = std::make_unique<BackgroundTask<Found>>(look);
  return work_;
}

}  // namespace icome::session
