#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// The decrease of a drag's pull with the distance t from the seeds, in radii.
enum class Falloff {
  Constant,  // 1 up to the radius, inclusive
  Linear,    // 1 - t: a cone
  Smooth,    // Hermite's 1 - 3 t^2 + 2 t^3: a bell, flat at the seeds and at the rim
  Sharp,     // (1 - t)^2: a thorn, flat at the rim only
};

/// The measure of a vertex's distance from the seeds.
enum class SoftDistance {
  Straight,   // to the nearest seed, through anything between
  AlongEdges  // the shortest way over edges of the mesh: never across a gap or to a part that is not
              // connected
};

struct SoftSelection {
  double radius = 0;  // m; 0: the seeds alone
  Falloff falloff = Falloff::Smooth;
  SoftDistance distance = SoftDistance::Straight;
};

/// The share of a drag that a vertex follows: all the way at 1.
struct SoftWeight {
  std::uint32_t vertex;
  double weight;
  bool operator==(const SoftWeight&) const = default;
};

/// The weight at `t` radii from the seeds, t >= 0: 1 at 0, 0 beyond 1, never rising between.
double falloff_weight(Falloff falloff, double t);

/// The vertices that follow when the seeds (one for a vertex, two for an edge, three for a face; repeats do
/// not matter) are dragged: those of weight above 0, by index. Seeds weigh 1. Fails on seeds that do not
/// exist, radii that are not finite or negative, and meshes with non-finite vertices or wrong indices.
base::Result<std::vector<SoftWeight>> soft_weights(const TriangleMesh& mesh,
                                                   std::span<const std::uint32_t> seeds,
                                                   const SoftSelection& selection);

}  // namespace icome::geometry
