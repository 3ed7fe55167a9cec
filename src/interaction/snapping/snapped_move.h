#pragma once
#include <optional>
#include <span>

#include "interaction/object_move.h"
#include "interaction/snapping/snap_finder.h"
#include "interaction/snapping/stopped_move.h"

namespace icome::interaction {

/// Rules for moved objects among those around them.
struct DragRules {
  StopSettings stops = {};
  SnapSettings snaps = {};
  SnapHandles handles = {};
  /// Unit, world frame: they keep to the line along it through where they were taken hold of.
  std::optional<Vector3> axis = {};
};

struct SnappedMove {
  StoppedMove move;                     // where the objects go, snapped
  Vector3 free = Vector3::Zero();       // m, world frame: where they would go without the snap
  std::optional<ObjectSnap> snap = {};  // what they snap to, if they get there
  std::vector<Contact> contacts = {};   // what keeps them from going on, at `free`
};

/// The move of stopped_move(), and then on to the best snap that is near there and can be reached without
/// going through anything. With an axis the objects stand on the line; on it they snap to where it meets a
/// face, or comes nearest to anything else. The grid comes before surfaces: objects go towards the grid's
/// place that is nearest to where they are wanted, and obstacles stop them short of it.
base::Result<SnappedMove> snapped_move(const world::World& world, world::CollisionIndex& index,
                                       SnapFinder& finder, std::span<const world::ObjectId> objects,
                                       const Vector3& wanted, const DragRules& rules = {});

/// The edit that lets objects fall until they rest on something; fails as landing() does.
base::Result<world::Edit> land_objects(const world::World& world, world::CollisionIndex& index,
                                       std::span<const world::ObjectId> objects,
                                       const LandSettings& settings = {});

/// Objects that a hand drags and that stop at surfaces: each edit puts them as near to the hand as they come
/// from where the last left them, without the rounding of those before it.
class StoppedDrag {
 public:
  StoppedDrag(const world::World& world, std::span<const world::ObjectId> objects) : move_(world, objects) {}

  bool empty() const { return move_.empty(); }

  /// The next edit, to be applied and followed by index and finder before the one after it, for a hand
  /// that is `wanted` (m, world frame) off where it took the objects. Fails as stopped_move does: nothing
  /// has changed then.
  base::Result<world::Edit> to(const world::World& world, world::CollisionIndex& index, SnapFinder& finder,
                               const Vector3& wanted, const DragRules& rules = {});

  /// to() in two parts: the move, which may take more effort (null: unlimited) than there is, and then the
  /// edit that makes it. A found move holds while neither the world nor this has changed. The world is only
  /// asked where things may snap.
  struct Found {
    SnappedMove move = {};
    Vector3 wanted = Vector3::Zero(), there = Vector3::Zero();  // where the hand is, and that on the line
    bool spent = false;                                         // the effort was: they may be able to go on
  };
  base::Result<Found> find(const world::World& world, world::CollisionIndex& index, SnapFinder& finder,
                           const Vector3& wanted, const DragRules& rules, world::Effort* effort) const;
  world::Edit take(const Found& found);

  const std::vector<world::ObjectId>& objects() const { return move_.objects(); }
  // Offsets, m, in the world's frame, from where the hand took them.
  const Vector3& wanted() const { return wanted_; }  // where the hand was last
  const Vector3& free() const { return free_; }      // how far surfaces let them go
  const Vector3& offset() const { return offset_; }  // where they are, snapped
  /// The contacts that keep them from where the hand is.
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// The snap that they have reached; nothing: none.
  const std::optional<ObjectSnap>& snap() const { return snap_; }

 private:
  base::Result<StoppedMove> back_to_line(const MovingObjects& moving, const DragRules& rules) const;

  ObjectMove move_;
  Vector3 wanted_ = Vector3::Zero(), free_ = Vector3::Zero(), offset_ = Vector3::Zero();
  std::vector<Contact> contacts_;
  std::optional<ObjectSnap> snap_;
};

}  // namespace icome::interaction
