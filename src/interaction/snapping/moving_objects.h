#pragma once
#include <span>
#include <vector>

#include "interaction/snapping/passage.h"
#include "world/collision/collisions.h"

namespace icome::interaction {

/// What keeps objects from going on.
struct Contact {
  world::ObjectId moved;
  world::ObjectId other;  // none: an obstacle that is not of the world
  Vector3 normal;         // unit, against the way; world frame
};

/// Objects that move together, with all below them, among all others of a world. The index must not follow
/// an edit while it lives, nor the world's frame be left: `at` is how far they are off where they stand (m,
/// world frame).
class MovingObjects {
 public:
  /// Objects that the index does not hold are passed over. The effort (null: there is no end to it) lives on.
  MovingObjects(world::CollisionIndex& index, std::span<const world::ObjectId> objects,
                world::Effort* effort = nullptr);

  /// What is asked now, and was since it was spent, is not known: they keep where they are.
  bool is_spent() const { return effort_ && effort_->is_spent(); }

  /// Something that stands besides what the world holds, such as a floor. The shape must live on.
  void add_obstacle(world::CollisionShape& shape, const Affine3& world_from_shape);

  /// Around those of them that have an end, as they stand.
  const base::Bounds& bounds() const { return bounds_; }
  /// The diagonal of that, m; 1 where nothing has an end.
  double size() const { return bounds_.isEmpty() ? 1.0 : bounds_.diagonal().norm(); }
  bool empty() const { return moved_.empty(); }

  /// The share of `step` that they can go from `at`; 1: all of it. They stop before what they would come to
  /// overlap; see stop() for what they overlap already. `tolerance` in m.
  double free_share(const Vector3& at, const Vector3& step, double tolerance) const;

  /// What they touch at `at`, or within a few tolerances (m), that is in the way of `step`: of each direction
  /// one, 16 at most.
  std::vector<Contact> contacts(const Vector3& at, const Vector3& step, double tolerance) const;

  /// One of them and something that it may meet.
  struct Pair {
    Passing passing;
    world::ObjectId moved, other;

    /// How far triangles may be off the two, together, m.
    double deviation() const {
      return passing.moved->deviation(passing.world_from_moved) +
             passing.other->deviation(passing.world_from_other);
    }
  };
  /// All pairs whose boxes are within `reach` (m) of each other at `at`.
  std::vector<Pair> beside(const Vector3& at, double reach) const {
    return pairs(at, Vector3::Zero(), reach);
  }
  /// How far triangles may be off those of them, and of what their boxes meet, that are off the most, m.
  double deviation(const Vector3& at) const;

  /// Do they overlap anything at `at`?
  bool overlap(const Vector3& at) const;

  /// How far they can surely not fall along `direction` (unit) without leaving all others behind, m; zero
  /// where there are none.
  double way_past_all(const Vector3& direction) const;

 private:
  using Standing = world::CollisionIndex::Standing;

  /// All that they may meet on the way, or come within `reach` of.
  std::vector<Pair> pairs(const Vector3& at, const Vector3& step, double reach) const;
  bool moves(world::ObjectId id) const;

  world::CollisionIndex& index_;
  world::Effort* effort_;            // may be null
  std::vector<Standing> moved_;      // in the order of ids
  std::vector<Standing> obstacles_;  // without ids
  base::Bounds bounds_;
};

}  // namespace icome::interaction
