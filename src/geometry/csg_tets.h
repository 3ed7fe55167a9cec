#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/result.h"
#include "geometry/contour_progress.h"
#include "geometry/csg_program.h"

namespace icome::geometry {

/// Tetrahedra wherever a CSG solid's surface may run: small where it bends, however large where it is flat.
struct CsgTets {
  static constexpr std::uint32_t kNoAtom = ~std::uint32_t{0};

  struct Tet {
    std::array<std::uint32_t, 4> corners;  // numbers of points; of positive volume
    std::vector<std::uint32_t> atoms;      // whose surfaces may pass it, rising
  };

  std::vector<Vector3> points;          // m, tree's frame
  std::vector<std::uint32_t> moved_to;  // by point: the atom on whose surface it was put, or kNoAtom
  std::vector<Tet> tets;
};

/// The direction in which no surface of the solid bends: along its cylinders, where it has some, all of them
/// lie that way, and nothing else is bent. Unit, tree's frame.
std::optional<Vector3> straight_way(const CsgProgram& program);

/// Halves the longest edges of six tetrahedra around the solid (Maubach 1995), so that neighbours always
/// share whole faces. Where a surface bends, edges become as short as in a grid of `cell` m, and short
/// against the bend; they are long along a straight_way() that is the z axis. Points that lie next to a
/// surface are moved onto it. Only for primitives in closed form; fails when `go_on` stops it, and when it
/// would take more than `most` tetrahedra.
base::Result<CsgTets> make_csg_tets(const CsgProgram& program, double cell, std::size_t most,
                                    const ContourProgress& go_on);

}  // namespace icome::geometry
