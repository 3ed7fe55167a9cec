#pragma once
#include "interaction/operations/operation.h"

namespace icome::interaction {

// What shape_operations() consists of.
Operation create_operation();
Operation reshape_operation();
Operation extrude_operation();
Operation repeat_operation();

}  // namespace icome::interaction
