#pragma once
#include <cstddef>
#include <vector>

#include "base/function_ref.h"
#include "world/collision/collision_shape.h"

namespace icome::interaction {

using base::Affine3;
using base::Vector3;

/// A placed shape that goes straight past another, which stands still. Shares of the way count from 0 to 1,
/// and may be less or more: the way goes on behind and ahead.
struct Passing {
  world::CollisionShape* moved;  // never null, nor is `other`
  Affine3 world_from_moved;      // at share 0
  world::CollisionShape* other;
  Affine3 world_from_other;
  Vector3 step;                     // m, world frame
  world::Effort* effort = nullptr;  // null: unlimited

  Affine3 world_from_moved_at(double share) const {
    return Eigen::Translation3d(share * step) * world_from_moved;
  }
};

/// A box that reaches so much farther on all sides, m.
inline base::Bounds grown(const base::Bounds& box, double by) {
  return {box.min() - Vector3::Constant(by), box.max() + Vector3::Constant(by)};
}

/// A place where surfaces of the two come to touch, or cease to.
struct Touch {
  double share;
  Vector3 normal;  // unit, of the surfaces there, against the way; world frame
  Vector3 place;   // m, world frame: where they touch then
};

/// The largest distance that counts as none between the two, m: that of world::meeting.
double rounding_of(const Passing& passing, double until);

/// Calls `visit` for the touches of the two with shares from `from` to `until`, in no order: of corners with
/// faces and edges with edges, of balls with anything, of the foremost corner with a half-space. Exact:
/// between touches, whether the two overlap does not change. Some that only nearly touch are among them, and
/// the same may come several times; features that only slide along each other are not. `visit` returns the
/// share up to which it wants more. It ends early where its effort is spent.
void visit_touches(const Passing& passing, double from, double until,
                   base::FunctionRef<double(const Touch&)> visit);

/// The first touches, at most `most`, after `from` up to `until` in their order; those within `apart` of each
/// other, or of `from`, are one, the earliest.
std::vector<Touch> first_touches(const Passing& passing, double from, double until, double apart,
                                 std::size_t most);

}  // namespace icome::interaction
