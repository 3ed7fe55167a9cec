#pragma once
#include "world/shape/geometry.h"

namespace icome::world {

/// The default distance, m, by which triangles may be off the shape that they approximate: 1/1000 of its
/// size, or 1/100 where it is sampled, which takes time by its volume.
double usual_tolerance(const Geometry& shape);

/// The deviation of triangles of that tolerance from the shape, m: where it is sampled, far less than the
/// cells of the grid. Not for parts that the triangles lack.
double usual_deviation(const Geometry& shape);

}  // namespace icome::world
