#include "geometry/mesh/mesh_frame.h"

#include <cmath>

namespace icome::geometry {

Vector3 near_origin(const Bounds& bounds) {
  constexpr double kFar = 64.0;  // sizes from the origin
  const double size = bounds.isEmpty() ? 0.0 : bounds.sizes().maxCoeff();
  Vector3 middle = Vector3::Zero();
  if (!(size > 0.0) || !std::isfinite(size)) return middle;
  // Far out, coordinates have coarser last digits than their differences need; and the middle has none finer
  // than about the size: differences from it need no rounding.
  const double grid = std::ldexp(1.0, std::ilogb(size));
  const Vector3 centre = bounds.center();
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(centre[axis]) > kFar * size) middle[axis] = grid * std::round(centre[axis] / grid);
  }
  return middle;
}

Vector3 bring_near(TriangleMesh& mesh) {
  const Vector3 middle = near_origin(bounds(mesh));
  if (!middle.isZero(0.0)) {
    for (Vector3& position : mesh.positions) position -= middle;
  }
  return middle;
}

Vector3 bring_near(CsgTree& tree) {
  const Vector3 middle = near_origin(bounds(tree));
  if (middle.isZero(0.0)) return middle;
  base::Affine3 place = tree.node(tree.root()).parent_from_node;
  place.pretranslate(-middle);
  tree.set_transform(tree.root(), place);
  return middle;
}

}  // namespace icome::geometry
