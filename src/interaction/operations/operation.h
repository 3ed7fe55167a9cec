#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "interaction/operations/arguments.h"
#include "world/edit/edit.h"

namespace icome::interaction {

/// What an operation would do, ready to be performed.
struct Plan {
  world::Edit edit;
  std::vector<world::ObjectId> objects = {};  // that were made or changed: what is to be selected then
  std::string note = {};                      // what people should know: "4 objects use this shape"
};

/// A tool by its name: the same in menus, scripts, the undo list and speech. All that it does is in the plan,
/// which it makes of the world as it is, and of nothing else.
struct Operation {
  std::string name;     // "extrude", in scripts
  std::string title;    // "Extrude", in menus and in the undo list
  std::string group;    // "Shape", what it stands with in menus and help
  std::string summary;  // a sentence
  std::vector<Parameter> parameters;
  base::Result<Plan> (*plan)(const world::World& world, const Arguments& arguments,
                             world::IdSource& ids) = nullptr;  // null: the runner's own, such as undo
};

/// All operations, in the order of help and menus.
const std::vector<Operation>& operations();

/// The operation of that name; fails with the names that come near.
base::Result<const Operation*> find_operation(std::string_view name);

/// What kind of thing is to be said for a parameter, for people: "[x, y, z]".
std::string kind_of(const Parameter& parameter);

/// What people read of an operation: its summary, and a line or more for every parameter.
std::string help_of(const Operation& operation);

// The groups that make up operations(), one source file each.
std::vector<Operation> shape_operations();    // create, reshape, extrude, repeat
std::vector<Operation> vertex_operations();   // drag, subdivide, refine, deform
std::vector<Operation> object_operations();   // copy and clone, move, turn, align, group, delete
std::vector<Operation> solid_operations();    // combine, take apart, move and change parts
std::vector<Operation> look_operations();     // colour, material, feel
std::vector<Operation> effect_operations();   // effect
std::vector<Operation> texture_operations();  // texture

}  // namespace icome::interaction
