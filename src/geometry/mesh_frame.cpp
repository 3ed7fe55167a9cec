#include "geometry/mesh_frame.h"

#include <cmath>

namespace icome::geometry {

Vector3 bring_near(TriangleMesh& mesh) {
  constexpr double kFar = 64.0;  // sizes from the origin
  const Bounds box = bounds(mesh);
  const double size = box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
  Vector3 middle = Vector3::Zero();
  if (!(size > 0.0) || !std::isfinite(size)) return middle;
  // Far out, coordinates have no digits as small as differences of them have; and the middle has none smaller
  // than about the size: differences from it need no rounding.
  const double grid = std::ldexp(1.0, std::ilogb(size));
  const Vector3 centre = box.center();
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(centre[axis]) > kFar * size) middle[axis] = grid * std::round(centre[axis] / grid);
  }
  if (!middle.isZero(0.0)) {
    for (Vector3& position : mesh.positions) position -= middle;
  }
  return middle;
}

}  // namespace icome::geometry
