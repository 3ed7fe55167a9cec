#pragma once
#include "bench_strokes.h"

namespace icome::benchmarks {

/// The greatest distance, both ways, of places close together on the line and on the curve, each held against
/// all of the other: a judge of what is certified that has no code in common with it. A little less than the
/// true distance; `error` is by how much it may be more.
struct DenseDistance {
  double greatest = 0.0;
  double error = 0.0;
};
DenseDistance dense_distance(const std::vector<Vector2>& line, const std::vector<CubicBezier>& curve);

}  // namespace icome::benchmarks
