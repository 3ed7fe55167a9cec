#pragma once
#include <array>
#include <vector>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

using base::Affine3;

/// The kind of projection of a picture onto a surface. Its frame is the projector's, whose unit cube (x, y
/// and z from -1/2 to 1/2) takes the picture once.
enum class TextureProjection {
  Planar,       // along z, over x and y
  Box,          // along x, y or z, whichever a triangle faces most: every side of the cube takes the picture
                // upright (z up) and not mirrored as seen from outside
  Cylindrical,  // round the z axis, from the meridian at -x over -y, x and y; height over z
  Spherical     // round the z axis likewise; latitude from -z to z
};

struct TextureProjector {
  TextureProjection projection = TextureProjection::Planar;
  Affine3 mesh_from_projector = Affine3::Identity();
  /// The texture coordinates of the picture's corners, at (x, y) = (-, -), (+, -), (+, +) and (-, +) of a
  /// planar projector's square, and likewise of the unrolled others. Bilinear between them and beyond.
  std::array<Vector2, 4> corners = {Vector2(0, 0), Vector2(1, 0), Vector2(1, 1), Vector2(0, 1)};
};

/// The projector's frame that fits a box, along the axes. Sides without length become as long as the longest.
Affine3 fitted_projector(const Bounds& box);

/// The texture coordinates of each triangle's corners.
///
/// Round the axis a triangle across the meridian counts on past 1 at some of its corners instead of running
/// back through the whole picture: its coordinates are those of least extent, the least of them in [0, 1).
/// Corners on the axis, where the direction means nothing, take the mean of the other corners'. (A triangle
/// that the axis passes through has no good coordinates: subdivide it first.)
///
/// Fails when the projector is flat or not finite, when the mesh has non-finite vertices or wrong indices,
/// and where numbers would leave the range of double precision.
base::Result<std::vector<std::array<Vector2, 3>>> project_texture(const TriangleMesh& mesh,
                                                                  const TextureProjector& projector);

}  // namespace icome::geometry
