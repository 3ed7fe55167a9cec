#pragma once
#include "world/shape/geometry.h"

namespace icome::world {

/// How far triangles may be off a shape that is made of them, where nobody says it, m: 1/1000 of its size, or
/// 1/100 where it is sampled, which takes time by its volume.
double usual_tolerance(const Geometry& shape);

/// How far triangles of that tolerance may be off the shape, m: where it is sampled, far less than the cells
/// of the grid. Not for parts that the triangles lack.
double usual_deviation(const Geometry& shape);

}  // namespace icome::world
