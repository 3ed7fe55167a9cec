#pragma once
#include <string>
#include <vector>

#include "interaction/operations/arguments.h"
#include "world/edit/edit.h"

namespace icome::interaction {

// Parameters that operations which make or move objects have in common: `turn` is one vector, along the
// axis and as long as the angle in degrees; lengths are metres in the parent's frame.

/// The largest coordinate (m) and the largest angle about one axis (degrees) that operations take.
inline constexpr double kFarthestPlace = 1e9;
inline constexpr double kLargestTurn = 1e6;
/// The least and the greatest factor of one scaling.
inline constexpr double kSmallestScale = 1e-6;
inline constexpr double kLargestScale = 1e6;

/// A point or a displacement, within kFarthestPlace; [0, 0, 0] where none is given.
Parameter place_parameter(std::string name, std::string meaning);
/// An optional place; has() tells whether it was given.
Parameter optional_place_parameter(std::string name, std::string meaning);
/// `turn`, [0, 0, 0] where none is given.
Parameter turn_parameter(std::string meaning);
/// `scale`, along x, y and z, and `factor`, along all three, at least `least`; scale_of() reads them.
std::vector<Parameter> scale_parameters(double least = kSmallestScale);

/// The rotation about the vector, right-handed, by as many degrees as it is long; exact for quarter turns
/// about an axis of the frame. Precondition: finite.
base::Matrix3 turn_of(const Vector3& degrees);

/// The factors along x, y and z, 1 where none are given. Fails where both scale and factor are given.
base::Result<Vector3> scale_of(const Arguments& arguments);

/// The parameters of a new object: name, at, turn, scale and factor, parent, material.
std::vector<Parameter> placement_parameters();

/// The parameters of a new object without a shape: name, at, turn and parent.
std::vector<Parameter> rigid_placement_parameters();

/// parent_from_object of these parameters: scaled, turned, then moved.
base::Result<base::Affine3> placement(const Arguments& arguments);

/// An object of these parameters, still without a shape. Called `kind`, or with a number behind it, where no
/// name is given. Fails for an empty or overlong name, and for an unknown material; the edits that make one
/// of the library are added to `edits`.
base::Result<world::PhysicalObject> placed_object(const world::World& world, const Arguments& arguments,
                                                  const std::string& kind, world::IdSource& ids,
                                                  world::EditGroup& edits);

/// The edit that makes an object behind its siblings.
world::CreateObject create_last(const world::World& world, world::ObjectId id, world::PhysicalObject object);

/// The name if no object has it, else the name with the first number behind it that makes one which no
/// object has: "stair 2". The count goes on from a number at the name's end.
std::string unused_name(const world::World& world, const std::string& wanted);
/// As many different unused names as are asked for.
std::vector<std::string> unused_names(const world::World& world, const std::string& wanted,
                                      std::size_t count);

/// Checks a name for an object; fails for an empty one, for control characters and for over 1000 bytes.
base::Result<void> check_name(const std::string& name);

}  // namespace icome::interaction
