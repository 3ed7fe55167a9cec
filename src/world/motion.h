#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/result.h"
#include "world/edit/changes.h"
#include "world/world.h"

namespace icome::world {

/// Where an object is, by parts: what is in it is stretched along the stretch's axes, then turned, both about
/// the centre, then moved (a Transform of VRML 2.0, 6.52; nodes of glTF 2.0 have no centre and no axes).
struct PlaceParts {
  Vector3 translation = Vector3::Zero();                         // m
  base::Quaternion rotation = base::Quaternion::Identity();      // of unit length
  Vector3 scale = Vector3::Ones();                               // nowhere 0
  Vector3 centre = Vector3::Zero();                              // m
  base::Quaternion stretch_axes = base::Quaternion::Identity();  // of unit length

  bool operator==(const PlaceParts& other) const;
};
Affine3 affine(const PlaceParts& parts);

/// What is between two key frames. Of turns, Linear goes the shortest way at an even speed.
enum class Interpolation : std::uint8_t { Step, Linear, CubicSpline };

/// What one part of a place is over time (VRML 2.0, 4.6.8; glTF 2.0, 3.11).
struct KeyFrames {
  Interpolation interpolation = Interpolation::Linear;
  std::vector<double> times =
      {};  // s, from 0 on, never going back; where two are equal it jumps. None: at rest
  /// Three numbers of each, or x, y, z, w of a turn. Of CubicSpline three times as many: each value stands
  /// between the slopes (1/s) that lead to it and away from it.
  std::vector<double> values = {};
  double cycle = 1.0;  // s, > 0: then it begins anew, or stays as it is then
  bool loops = true;

  bool operator==(const KeyFrames& other) const = default;
};

/// How an object moves by itself: what its place is over time, part by part. Shared, never changed.
struct Motion {
  PlaceParts rest = {};  // also of the parts without key frames
  KeyFrames translation = {};
  KeyFrames rotation = {};
  KeyFrames scale = {};

  bool operator==(const Motion& other) const = default;
};

/// Says what is wrong with a motion that nobody could play.
base::Result<void> check_motion(const Motion& motion);

/// The parts of the place at a moment (s); before 0 it is as at 0. Key frames bring no scale nearer to 0 than
/// a millionth, or than the smallest at rest where that is less.
PlaceParts parts_at(const Motion& motion, double time);

/// Where an object is at a moment (s) that stands at `at_rest` when nothing moves: who has put it elsewhere
/// than the motion has it at rest has moved all of its way. Where that would flatten it, it is at rest.
Affine3 place_at(const Motion& motion, const Affine3& at_rest, double time);

/// The motion of an object that stands at `at_rest`, as one that is at rest there. None where the object was
/// stretched unevenly or mirrored since, which no key frames can say.
std::optional<Motion> moved_along(const Motion& motion, const Affine3& at_rest);

/// How long it goes on, or until it begins anew, s: the longest of its parts.
double duration(const Motion& motion);
bool loops(const Motion& motion);
std::size_t key_count(const Motion& motion);
/// The memory that a motion takes, itself included, bytes.
std::size_t bytes_of(const Motion& motion);

/// Those that have a motion, in the order of their ids.
std::vector<ObjectId> moving_objects(const World& world);

/// Where an object is in the world over time, by its own motion and by those of the objects above it.
class ObjectCourse {
 public:
  /// The object is in the world.
  ObjectCourse(const World& world, ObjectId id);
  bool moves() const;
  Affine3 world_from_object(double time) const;

 private:
  struct Link {
    Affine3 at_rest = Affine3::Identity();
    MotionPointer motion = nullptr;  // null: it stays
  };
  std::vector<Link> links_;  // from the world down
};

/// A world as it is at a moment of its motions: a copy whose moving objects are put where they are then.
class PosedWorld {
 public:
  /// Of this world at rest, at `time` (s).
  PosedWorld(const World& at_rest, double time);

  const World& world() const { return world_; }
  bool moves() const { return !movers_.empty(); }
  /// Goes on to another moment; gives what has moved.
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
