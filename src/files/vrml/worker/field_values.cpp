#include "files/vrml/worker/field_values.h"

#include <Inventor/SbColor.h>
#include <Inventor/SbVec3f.h>
#include <Inventor/fields/SoField.h>
#include <Inventor/nodes/SoNode.h>

namespace icome::files {

std::array<double, 3> as_written(const SbVec3f& vector) {
  return {as_written(vector[0]), as_written(vector[1]), as_written(vector[2])};
}

std::array<float, 3> as_array(const SbColor& colour) { return {colour[0], colour[1], colour[2]}; }

const SoField* find_field(const SoNode& node, const char* name, const char* type) {
  const SoField* field = node.getField(name);
  return field && field->getTypeId().getName() == type ? field : nullptr;
}

}  // namespace icome::files
