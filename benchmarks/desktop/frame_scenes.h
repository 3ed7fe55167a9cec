#pragma once
#include <cstddef>
#include <vector>

#include "base/vector.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::benchmarks {

/// A solid of the scene of many solids.
struct FrameSolid {
  enum class Kind { Box, Ball, Cylinder, Cone } kind;
  base::Vector3 at;  // m
  base::Vector3 colour;
};
constexpr double kSolidSize = 0.06;  // m, height and width of each
constexpr double kSolidStep = 0.1;   // m, from one to the next

/// Solids in rows, which fill a cube.
std::vector<FrameSolid> frame_solids(std::size_t count);

/// A bumpy ball of 0.1 m.
geometry::TriangleMesh frame_mesh(int rows);

/// CPU time of the process so far, with all its threads, ms: drawing in software is done by several.
double cpu_milliseconds();

}  // namespace icome::benchmarks
