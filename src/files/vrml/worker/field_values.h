#pragma once
#include <array>

#include "io/number_text.h"

class SbColor;
class SbVec3f;
class SoField;
class SoNode;

namespace icome::files {

using io::as_written;
/// The decimal numbers of the file: 0.1, where the float is 0.100000001.
std::array<double, 3> as_written(const SbVec3f& vector);

std::array<float, 3> as_array(const SbColor& colour);

/// The field of this name and type ("SFString"); null: the node has none.
const SoField* find_field(const SoNode& node, const char* name, const char* type);

}  // namespace icome::files
