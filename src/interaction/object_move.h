#pragma once
#include <span>
#include <vector>

#include "base/vector.h"
#include "world/edit/edit.h"

namespace icome::interaction {

/// The objects that exist and are not below another of them, each once and in the given order: a change of
/// these carries all others along.
std::vector<world::ObjectId> topmost(const world::World& world, std::span<const world::ObjectId> objects);

/// Objects that are moved together. Keeps their places at the start, so that the last of many steps leaves
/// them where the hand is, without the rounding of earlier steps.
class ObjectMove {
 public:
  /// An object that is selected along with one above it moves once. An object whose parents shrink space to
  /// nothing is left out.
  ObjectMove(const world::World& world, std::span<const world::ObjectId> objects);

  /// Is there nothing to move?
  bool empty() const { return starts_.empty(); }
  const std::vector<world::ObjectId>& objects() const { return objects_; }
  /// Moves all of them by the offset (m, world frame) from where they stood at the start.
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
