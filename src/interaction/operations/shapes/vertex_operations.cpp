#include "interaction/operations/shapes/vertex_operations.h"

namespace icome::interaction {

std::vector<Operation> vertex_operations() {
  return {drag_operation(),   subdivide_operation(), ffd_operation(),      refine_operation(),
          smooth_operation(), mesh_operation(),      own_shape_operation()};
}

}  // namespace icome::interaction
