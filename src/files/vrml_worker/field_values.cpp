#include "files/vrml_worker/field_values.h"

#include <Inventor/SbColor.h>
#include <Inventor/SbVec3f.h>
#include <Inventor/fields/SoField.h>
#include <Inventor/nodes/SoNode.h>

#include <charconv>

namespace icome::files {

double as_written(float number) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number);
  double value = 0.0;
  std::from_chars(text.data(), end, value);
  return value;
}

std::array<double, 3> as_written(const SbVec3f& vector) {
  return {as_written(vector[0]), as_written(vector[1]), as_written(vector[2])};
}

std::array<float, 3> as_array(const SbColor& colour) { return {colour[0], colour[1], colour[2]}; }

const SoField* find_field(const SoNode& node, const char* name, const char* type) {
  const SoField* field = node.getField(name);
  return field && field->getTypeId().getName() == type ? field : nullptr;
}

}  // namespace icome::files
