#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "render/model/shading_mesh.h"

namespace icome::render {

/// Side of the cells of the finest level, in the buffers' frame.
inline constexpr double kFinestCell = 1.0 / 256.0;

/// A coarser stand-in for a shape where it is seen small and without a picture on it. Owns its arrays.
struct ShapeLevel {
  ShadingMesh mesh;                      ///< the same frame as the shape's own
  std::vector<Eigen::Vector3f> colours;  ///< of every vertex or none; linear
  double cell = 0.0;  ///< buffers' frame: no finer than this; the surface is off by about half of it at most
};

/// The levels from the finest on, each with far fewer triangles than the one before; none for shapes of few
/// triangles. Vertices that share a cell of a grid come to lie at their mean, and triangles that collapse
/// vanish (Rossignac and Borrel 1993); edges stay edges, as normals are averaged only where they agree.
std::vector<ShapeLevel> make_shape_levels(const ShadingMesh& mesh, std::span<const Eigen::Vector3f> colours);

}  // namespace icome::render
