#pragma once
#include <cstdint>
#include <vector>

#include "base/vector.h"

namespace icome::files {

/// Polygons over shared vertices. Owns them.
struct PolygonMesh {
  std::vector<base::Vector3> positions;
  std::vector<std::uint32_t> corners;       // vertices of all polygons, one after the other
  std::vector<std::uint32_t> begins = {0};  // of each polygon in `corners`, and the end of the last

  std::size_t polygons() const { return begins.size() - 1; }
};

/// The unit normals of the polygons, on their front sides (Newell's sum over the edges). Zero for those
/// without area.
std::vector<base::Vector3> polygon_normals(const PolygonMesh& mesh);

/// The unit normal of each corner as VRML 2.0 derives it from a crease angle (rad, >= 0): the mean of the
/// polygons around the vertex whose normals lie within the angle of this polygon's, weighted by their angles
/// at the vertex. Empty when no edge is a crease, so that all corners of a vertex agree. More than
/// `kMostPolygonsAround` polygons around a vertex each keep their own normal there, if there are creases.
std::vector<base::Vector3> crease_normals(const PolygonMesh& mesh, double crease_angle);
inline constexpr std::size_t kMostPolygonsAround = 512;

}  // namespace icome::files
