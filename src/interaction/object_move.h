#pragma once
#include <span>
#include <vector>

#include "base/vector.h"
#include "world/edit/edit.h"

namespace icome::interaction {

/// Those of the objects that are there and not below another of them, each once and in the same order: what
/// is done to them is done to all.
std::vector<world::ObjectId> topmost(const world::World& world, std::span<const world::ObjectId> objects);

/// Objects that are moved together: where they stood when that began, so that the last of many steps leaves
/// them where the hand is, without the rounding of those before it.
class ObjectMove {
 public:
  /// An object that is selected along with one above it moves once. Where parents within parents shrink space
  /// to nothing, there is nowhere to go.
  ObjectMove(const world::World& world, std::span<const world::ObjectId> objects);

  /// There is nothing to move.
  bool empty() const { return starts_.empty(); }
  const std::vector<world::ObjectId>& objects() const { return objects_; }
  /// Puts all of them where they stood, moved by that much (m, world frame).
  world::Edit by(const base::Vector3& offset) const;

 private:
  struct Start {
    base::Affine3 parent_from_object;
    base::Matrix3 parent_from_world;  // of directions
  };
  std::vector<world::ObjectId> objects_;
  std::vector<Start> starts_;
};

}  // namespace icome::interaction
