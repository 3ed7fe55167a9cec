#pragma once
#include <vector>

#include "interaction/operations/operation.h"

namespace icome::interaction {

// What object_operations() consist of, one source file each.
std::vector<Operation> duplicate_operations();  // clone, copy, duplicate along a path
std::vector<Operation> hierarchy_operations();  // delete, rename, group, ungroup, put
std::vector<Operation> move_operations();       // move
std::vector<Operation> arrange_operations();    // turn, scale, place, align, distribute

/// `objects`, what is moved.
Parameter moved_objects_parameter();
/// The same parameter, but it must be said.
Parameter needed(Parameter parameter);

}  // namespace icome::interaction
