#pragma once
#include <span>
#include <vector>

#include "base/result.h"
#include "interaction/snapping/moving_objects.h"

namespace icome::interaction {

/// Settings of collisions of moved objects (thesis 2.4.4: a vase does not pop through the table).
struct StopSettings {
  bool stop = true;         // else they go through everything
  bool slide = true;        // along what they meet, as near as they come to where they are wanted
  int most_slides = 16;     // turns of the way, usually 4 to 32
  double tolerance = 1e-6;  // of their size: how far before a surface they may stop, usually 1e-7 to 1e-4
};

struct StoppedMove {
  Vector3 offset = Vector3::Zero();    // m, world frame: how far they go from where they stand
  bool stopped = false;                // before they are where they are wanted
  std::vector<Contact> contacts = {};  // where they end, with what is in the way
  bool spent = false;                  // the effort was, on the way: they may be able to go on from there
};

/// The move of objects that are wanted `wanted` (m, world frame) off where they stand: they stop at the first
/// surface, however long the way and however thin the obstacle, and never come to overlap anything. Touching
/// is allowed. Objects that overlap something already may go where they come out of it, but no deeper; where
/// that is by no more than 3 % of their size, and they slide, they are taken out first. Objects go along with
/// those above them; those that the index does not hold are passed over. Fails for ways that are not finite
/// or longer than 1e6 times what moves, and for settings out of range.
base::Result<StoppedMove> stopped_move(world::CollisionIndex& index, std::span<const world::ObjectId> objects,
                                       const Vector3& wanted, const StopSettings& settings = {});

/// The move of objects that begin `from` off where they stand; the offset counts from where they stand.
/// Where their effort is spent, it is the last place on the way where they are known to be allowed.
base::Result<StoppedMove> stopped_move(const MovingObjects& objects, const Vector3& from,
                                       const Vector3& wanted, const StopSettings& settings = {});

/// Settings of landing.
struct LandSettings {
  Vector3 direction = -Vector3::UnitY();  // world frame, any length but 0
  bool floor = false;                     // also on the plane y = 0, where the direction leads down
  double tolerance = 1e-6;                // of their size, as in StopSettings
};

/// The move (m, world frame) of objects that fall until they rest on something. Fails where there is
/// nothing below, where they overlap something before they fall, and as stopped_move does.
base::Result<StoppedMove> landing(world::CollisionIndex& index, std::span<const world::ObjectId> objects,
                                  const LandSettings& settings = {});

}  // namespace icome::interaction
