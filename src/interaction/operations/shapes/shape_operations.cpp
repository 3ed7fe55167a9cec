#include "interaction/operations/shapes/shape_operations.h"

namespace icome::interaction {

std::vector<Operation> shape_operations() {
  return {create_operation(), reshape_operation(), extrude_operation(), repeat_operation()};
}

}  // namespace icome::interaction
