#pragma once
#include <array>

#include "files/vrml/worker/answer.h"

class SbRotation;
class SoNode;
class SoVRMLTransform;

namespace icome::files {

/// T C R SR S -SR -C of a Transform, in double: a 3 x 4 matrix, row after row. A Transform with a number
/// that is not finite does nothing.
std::array<double, 12> matrix_of(const SoVRMLTransform& transform);

/// The fields of a Transform one after the other, in the order of MotionParts::rest.
std::array<double, 17> rest_of(const SoVRMLTransform& transform);

/// A turn by the numbers in the file, as x, y, z, w: Coin keeps it in single precision.
std::array<double, 4> turn_as_written(const SbRotation& turn);

/// False: the node is neither a light nor a Viewpoint.
bool fill_light_or_viewpoint(const SoNode& node, NodeParts& parts);

}  // namespace icome::files
