#pragma once
#include <optional>
#include <unordered_set>

#include "interaction/snapping/snap_finder.h"
#include "world/changes.h"

namespace icome::session {

/// What is around things that are moved: what they stop at, and what they snap to. Made when it is first
/// asked for, and brought up to date when it is asked for again, so that edits take no time for it while
/// nothing is moved. Main's; the world outlives it.
class Surroundings {
 public:
  explicit Surroundings(const world::World& world) : world_(world) {}
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;

  /// The world has changed by these, or, when null, to another one.
  void follow(const world::Changes* changes);

  // As the world is now; both at the same edit.
  world::CollisionIndex& index();
  interaction::SnapFinder& finder();

 private:
  void catch_up();

  const world::World& world_;
  std::optional<world::CollisionIndex> index_;  // none: nobody has asked yet
  interaction::SnapFinder finder_;
  // What has changed since.
  std::unordered_set<world::ObjectId> objects_;
  std::unordered_set<world::GeometryId> geometries_;
};

}  // namespace icome::session
