#include "interaction/operations/objects/object_operations.h"

#include <algorithm>
#include <iterator>

namespace icome::interaction {

std::vector<Operation> object_operations() {
  std::vector<Operation> all;
  for (auto group : {duplicate_operations, hierarchy_operations, move_operations, arrange_operations})
    std::ranges::move(group(), std::back_inserter(all));
  return all;
}

Parameter moved_objects_parameter() {
  return {.name = "objects",
          .kind = ParameterKind::Objects,
          .meaning = "what is moved, with all below",
          .required = true};
}

Parameter needed(Parameter parameter) {
  parameter.required = true;
  parameter.fallback = {};
  return parameter;
}

}  // namespace icome::interaction
