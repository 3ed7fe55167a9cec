#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "interaction/operations/arguments.h"
#include "world/edit/edit.h"

namespace icome::interaction {

/// The effect of an operation, ready to be performed.
struct Plan {
  world::Edit edit;
  std::vector<world::ObjectId> objects = {};  // made or changed, to be selected afterwards
  std::string note = {};                      // a remark for people: "4 objects use this shape"
};

/// A named tool, the same in menus, scripts, the undo list and speech. All that it does is in the plan, which
/// it makes from the world as it is and its arguments alone.
struct Operation {
  std::string name;     // "extrude", in scripts
  std::string title;    // "Extrude", in menus and in the undo list
  std::string group;    // "Shape", its heading in menus and help
  std::string summary;  // a sentence
  std::vector<Parameter> parameters;
  base::Result<Plan> (*plan)(const world::World& world, const Arguments& arguments,
                             world::IdSource& ids) = nullptr;  // null: the runner's own, such as undo
};

/// All operations, in the order of help and menus.
const std::vector<Operation>& operations();

/// The operation of that name; fails with the names that come near.
base::Result<const Operation*> find_operation(std::string_view name);

/// The form of a parameter's values, for people: "[x, y, z]".
std::string kind_of(const Parameter& parameter);

/// The help text of an operation: its summary, and a line or more for every parameter.
std::string help_of(const Operation& operation);

// The groups that make up operations().
std::vector<Operation> shape_operations();    // create, reshape, extrude, repeat
std::vector<Operation> vertex_operations();   // drag, subdivide, ffd, refine, smooth, mesh, own-shape
std::vector<Operation> object_operations();   // all that duplicates, groups, moves and arranges objects
std::vector<Operation> solid_operations();    // combine, separate, move-operand, change-operator
std::vector<Operation> look_operations();     // colour, material, feel
std::vector<Operation> effect_operations();   // effect
std::vector<Operation> texture_operations();  // texture, move-projector

}  // namespace icome::interaction
