#pragma once
#include <array>

class SbColor;
class SbVec3f;
class SoField;
class SoNode;

namespace icome::files {

/// The double that a float was written as: 0.1f becomes 0.1, since that is what the file says.
double as_written(float number);
std::array<double, 3> as_written(const SbVec3f& vector);

std::array<float, 3> as_array(const SbColor& colour);

/// The field of this name and type ("SFString"); null: the node has none.
const SoField* find_field(const SoNode& node, const char* name, const char* type);

}  // namespace icome::files
