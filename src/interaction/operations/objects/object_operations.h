#pragma once
#include <vector>

#include "interaction/operations/operation.h"

namespace icome::interaction {

// The groups that make up object_operations(), one source file each.
std::vector<Operation> duplicate_operations();  // clone, copy, duplicate along a path
std::vector<Operation> hierarchy_operations();  // delete, rename, group, ungroup, put
std::vector<Operation> move_operations();       // move, land
std::vector<Operation> arrange_operations();    // turn, scale, place, align, distribute

/// `objects`: the objects to be moved.
Parameter moved_objects_parameter();
/// The parameter made a required one, without a fallback.
Parameter needed(Parameter parameter);

}  // namespace icome::interaction
