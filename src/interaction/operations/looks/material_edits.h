#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "world/edit/edit.h"

namespace icome::interaction {

/// The objects with a shape to be seen and felt: those that are named, and all below the groups among
/// them, which have none. Each once. Fails, naming the object, where one holds no shape at all.
base::Result<std::vector<world::ObjectId>> with_shapes(const world::World& world,
                                                       std::span<const world::ObjectId> objects);

/// A change of the looks or the feel of some objects.
struct MaterialChange {
  std::function<void(world::Material& material)> change;
  std::string name;     // of a material made for objects that had none
  bool shared = false;  // changes the material for others, too
};

/// The edit that changes the materials of these objects, and of others only where `shared` says so: else a
/// material that others have as well is left to them, and one like it is made for these. Objects that had
/// the same material share the new one.
world::Edit change_materials(const world::World& world, std::span<const world::ObjectId> objects,
                             const MaterialChange& change, world::IdSource& ids);

/// A material, and the edit that makes it where it is not there yet.
struct ChosenMaterial {
  world::MaterialId id;
  world::EditGroup creation = {};
};

/// The material of the design of that name, or of "#" and its number; else the one of the library. Fails
/// saying what there is instead.
base::Result<ChosenMaterial> chosen_material(const world::World& world, const std::string& name,
                                             world::IdSource& ids);
/// The names that chosen_material() takes, for help.
std::string material_meaning();

}  // namespace icome::interaction
