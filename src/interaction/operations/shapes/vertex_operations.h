#pragma once
#include "interaction/operations/operation.h"

namespace icome::interaction {

// The operations on vertices and triangles, one source file each subject.

Operation drag_operation();
Operation subdivide_operation();
Operation refine_operation();  // loop_operations.cpp
Operation smooth_operation();  // loop_operations.cpp
Operation mesh_operation();    // own_operations.cpp
Operation own_shape_operation();
Operation ffd_operation();

}  // namespace icome::interaction
