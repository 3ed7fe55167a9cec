#pragma once
#include "interaction/operations/operation.h"

namespace icome::interaction {

// The operations that make up shape_operations().
Operation create_operation();
Operation reshape_operation();
Operation extrude_operation();
Operation repeat_operation();

}  // namespace icome::interaction
