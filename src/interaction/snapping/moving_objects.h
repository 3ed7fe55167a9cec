#pragma once
#include <span>
#include <vector>

#include "interaction/snapping/passage.h"
#include "world/collision/collisions.h"

namespace icome::interaction {

/// A contact that keeps objects from going on.
struct Contact {
  world::ObjectId moved;
  world::ObjectId other;  // none: an obstacle that is not of the world
  Vector3 normal;         // unit, against the way; world frame
};

/// Objects that move together, with all below them, among all others of a world. The index must not
/// follow an edit while this lives. All is in the world's frame: `at` is their offset from where they
/// stand (m).
class MovingObjects {
 public:
  /// Objects that the index does not hold are passed over. The effort (null: unlimited) must outlive this.
  MovingObjects(world::CollisionIndex& index, std::span<const world::ObjectId> objects,
                world::Effort* effort = nullptr);

  /// Is the effort spent? Answers given since then are not known to be true: they keep their place.
  bool is_spent() const { return effort_ && effort_->is_spent(); }

  /// Adds an obstacle besides those of the world, such as a floor. The shape must outlive this.
  void add_obstacle(world::CollisionShape& shape, const Affine3& world_from_shape);

  /// The box around those of them that are bounded, as they stand.
  const base::Bounds& bounds() const { return bounds_; }
  /// The diagonal of the bounds, m; 1 where nothing is bounded.
  double size() const { return bounds_.isEmpty() ? 1.0 : bounds_.diagonal().norm(); }
  bool empty() const { return moved_.empty(); }

  /// The share of `step` that they can go from `at`; 1: all of it. They stop before shapes that they would
  /// come to overlap; see stop() for those that they overlap already. `tolerance` in m.
  double free_share(const Vector3& at, const Vector3& step, double tolerance) const;

  /// The contacts at `at`, or within a few tolerances (m) of it, that are in the way of `step`: one for each
  /// direction, 16 at most.
  std::vector<Contact> contacts(const Vector3& at, const Vector3& step, double tolerance) const;

  /// One of the moved objects and something that it may meet.
  struct Pair {
    Passing passing;
    world::ObjectId moved, other;

    /// Deviation of the triangles from the two shapes, added up, m.
    double deviation() const {
      return passing.moved->deviation(passing.world_from_moved) +
             passing.other->deviation(passing.world_from_other);
    }
  };
  /// All pairs whose boxes are within `reach` (m) of each other at `at`.
  std::vector<Pair> beside(const Vector3& at, double reach) const {
    return pairs(at, Vector3::Zero(), reach);
  }
  /// The largest deviation of a pair whose boxes meet at `at`, m.
  double deviation(const Vector3& at) const;

  /// Do they overlap anything at `at`?
  bool overlap(const Vector3& at) const;

  /// Length of a way along `direction` (unit) on which they surely leave all others behind, m; zero where
  /// there are none.
  double way_past_all(const Vector3& direction) const;

 private:
  using Standing = world::CollisionIndex::Standing;

  /// All pairs that may meet on the way, or come within `reach` (m) of each other.
  std::vector<Pair> pairs(const Vector3& at, const Vector3& step, double reach) const;
  bool moves(world::ObjectId id) const;

  world::CollisionIndex& index_;
  world::Effort* effort_;            // may be null
  std::vector<Standing> moved_;      // in the order of ids
  std::vector<Standing> obstacles_;  // without ids
  base::Bounds bounds_;
};

}  // namespace icome::interaction
