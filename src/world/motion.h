#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/result.h"
#include "world/edit/changes.h"
#include "world/world.h"

namespace icome::world {

/// The place of an object, by parts: it is stretched along the stretch's axes, then turned, both about the
/// centre, then moved (a Transform of VRML 2.0, 6.52; nodes of glTF 2.0 have no centre and no axes).
struct PlaceParts {
  Vector3 translation = Vector3::Zero();                         // m
  base::Quaternion rotation = base::Quaternion::Identity();      // of unit length
  Vector3 scale = Vector3::Ones();                               // none is 0
  Vector3 centre = Vector3::Zero();                              // m
  base::Quaternion stretch_axes = base::Quaternion::Identity();  // of unit length

  bool operator==(const PlaceParts& other) const;
};
Affine3 affine(const PlaceParts& parts);

/// Interpolation between two key frames. For turns, Linear goes the shortest way at an even speed.
enum class Interpolation : std::uint8_t { Step, Linear, CubicSpline };

/// The course of one part of a place over time (VRML 2.0, 4.6.8; glTF 2.0, 3.11).
struct KeyFrames {
  Interpolation interpolation = Interpolation::Linear;
  std::vector<double> times =
      {};  // s, from 0 on, never decreasing; at two equal times it jumps. None: at rest
  /// Three numbers for each time, or x, y, z, w of a turn. For CubicSpline three times as many: each value
  /// stands between the slopes (1/s) that lead to it and away from it.
  std::vector<double> values = {};
  double cycle = 1.0;  // s, > 0: then it begins anew, or keeps its last value
  bool loops = true;

  bool operator==(const KeyFrames& other) const = default;
};

/// The motion of an object by itself: the course of its place, part by part. Shared, never changed.
struct Motion {
  PlaceParts rest = {};  // also for the parts without key frames
  KeyFrames translation = {};
  KeyFrames rotation = {};
  KeyFrames scale = {};

  bool operator==(const Motion& other) const = default;
};

/// Fails for a motion that cannot be played, saying why.
base::Result<void> check_motion(const Motion& motion);

/// The parts of the place at a moment (s); before 0 as at 0. Key frames bring no scale nearer to 0 than a
/// millionth, or than the smallest at rest where that is less.
PlaceParts parts_at(const Motion& motion, double time);

/// The place at a moment (s) of an object that stands at `at_rest` when nothing moves; where that is not
/// the motion's place at rest, the whole path is moved along. `at_rest` where the place would be flat.
Affine3 place_at(const Motion& motion, const Affine3& at_rest, double time);

/// The motion of an object that stands at `at_rest`, changed to be at rest there. None where the object was
/// stretched unevenly or mirrored since, which no key frames can express.
std::optional<Motion> moved_along(const Motion& motion, const Affine3& at_rest);

/// Time until it ends or begins anew, s: the longest of its parts.
double duration(const Motion& motion);
bool loops(const Motion& motion);
std::size_t key_count(const Motion& motion);
/// The memory that a motion takes, itself included, bytes.
std::size_t bytes_of(const Motion& motion);

/// The objects that have a motion, in the order of their ids.
std::vector<ObjectId> moving_objects(const World& world);

/// The place of an object in the world over time, by its own motion and those of the objects above it.
class ObjectCourse {
 public:
  /// The object must be in the world.
  ObjectCourse(const World& world, ObjectId id);
  bool moves() const;
  Affine3 world_from_object(double time) const;

 private:
  struct Link {
    Affine3 at_rest = Affine3::Identity();
    MotionPointer motion = nullptr;  // null: no motion
  };
  std::vector<Link> links_;  // from the world down
};

/// A world at a moment of its motions: a copy whose moving objects are put at their places of that moment.
class PosedWorld {
 public:
  /// Poses the world `at_rest` for `time` (s).
  PosedWorld(const World& at_rest, double time);

  const World& world() const { return world_; }
  bool moves() const { return !movers_.empty(); }
  /// Goes to another moment; returns what has moved.
  Changes go_to(double time);

 private:
  struct Mover {
    ObjectId id;
    Affine3 at_rest;
    MotionPointer motion;
  };

  World world_;
  std::vector<Mover> movers_;  // in the order of their ids
};

}  // namespace icome::world
