#pragma once
#include <string>
#include <vector>

#include "interaction/operations/arguments.h"
#include "world/edit/edit.h"

namespace icome::interaction {

// What operations that make or move objects ask in the same words: `turn` is one vector, along the axis and
// as long as the angle in degrees; lengths are metres in the parent's frame.

/// The largest coordinate (m) and the largest angle about one axis (degrees) that operations take.
inline constexpr double kFarthestPlace = 1e9;
inline constexpr double kLargestTurn = 1e6;
/// The least and the most that one scaling does.
inline constexpr double kSmallestScale = 1e-6;
inline constexpr double kLargestScale = 1e6;

/// A place or a way, within kFarthestPlace; [0, 0, 0] where nothing is said.
Parameter place_parameter(std::string name, std::string meaning);
/// An optional place, which has() tells.
Parameter optional_place_parameter(std::string name, std::string meaning);
/// `turn`, [0, 0, 0] where nothing is said.
Parameter turn_parameter(std::string meaning);
/// `scale`, along x, y and z, and `factor`, along all three, at least `least`; scale_of() reads them.
std::vector<Parameter> scale_parameters(double least = kSmallestScale);

/// Right-handed about the vector, by as many degrees as it is long; exact for quarter turns about an axis of
/// the frame. Precondition: finite.
base::Matrix3 turn_of(const Vector3& degrees);

/// Fails where both scale and factor are said.
base::Result<Vector3> scale_of(const Arguments& arguments);

/// Where something new stands, and what it is called: name, at, turn, scale and factor, parent, material.
std::vector<Parameter> placement_parameters();

/// The same of what has no shape: name, at, turn and parent.
std::vector<Parameter> rigid_placement_parameters();

/// parent_from_object of these parameters: scaled, turned, then moved.
base::Result<base::Affine3> placement(const Arguments& arguments);

/// An object of these parameters, still without a shape. Called `kind`, or with a number behind it, where no
/// name is said. Fails for an empty or endless name, and for a material that is not there; one of the library
/// is made by what is added to `edits`.
base::Result<world::PhysicalObject> placed_object(const world::World& world, const Arguments& arguments,
                                                  const std::string& kind, world::IdSource& ids,
                                                  world::EditGroup& edits);

/// The edit that makes an object behind its siblings.
world::CreateObject create_last(const world::World& world, world::ObjectId id, world::PhysicalObject object);

/// The name if no object has it, else the name with the first number behind it that makes one which no
/// object has: "stair 2". A number that it ends in is counted on.
std::string unused_name(const world::World& world, const std::string& wanted);
/// As many different ones.
std::vector<std::string> unused_names(const world::World& world, const std::string& wanted,
                                      std::size_t count);

/// A name that is fit for an object; fails for an empty one, for control characters and for over 1000 bytes.
base::Result<void> check_name(const std::string& name);

}  // namespace icome::interaction
