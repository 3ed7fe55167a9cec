#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/result.h"
#include "geometry/contour/contour_progress.h"
#include "geometry/csg/csg_surfaces.h"

namespace icome::geometry {

/// Tetrahedra wherever a CSG solid's surface may run: small where it bends, however large where it is flat.
struct CsgTets {
  struct Tet {
    std::array<std::uint32_t, 4> corners;      // numbers of points; of positive volume
    std::vector<CsgSurfaces::Index> surfaces;  // that may pass it, rising
  };

  std::vector<Vector3> points;               // m, tree's frame
  std::vector<CsgSurfaces::Index> moved_to;  // by point: the surface on which it was put, or kNone
  std::vector<Tet> tets;
};

/// The key of the edge between two points, in either order.
inline std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

/// The largest distance (m) of a chord from a surface with this bend (its radius, m), for a mesh with cells
/// of `cell` m.
double chord_height(double cell, double bend);

/// The direction in which no surface of the solid bends: that of its cylinders, if it has some, all of them
/// are parallel, and nothing else is bent; else nothing. Unit, tree's frame.
std::optional<Vector3> straight_way(const CsgProgram& program);

/// Halves the longest edges of six tetrahedra around the solid (Maubach 1995), so that neighbours always
/// share whole faces. Where a surface bends, edges become so short that they keep to chord_height(); they are
/// long along a straight_way() that is the z axis. Points that lie next to a surface are moved onto it. Fails
/// when `go_on` stops it, and when it would take more than `most` tetrahedra.
base::Result<CsgTets> make_csg_tets(const CsgProgram& program, const CsgSurfaces& surfaces, double cell,
                                    std::size_t most, const ContourProgress& go_on);

}  // namespace icome::geometry
