#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// A lattice of control points in a box: vertices in the box follow the points when they are moved
/// (free-form deformation, Sederberg and Parry 1986; thesis 2.4.3). A plain value.
struct FfdLattice {
  base::Affine3 space_from_box =
      base::Affine3::Identity();         ///< the unit cube becomes the box before all moves, m
  std::array<int, 3> cells = {1, 1, 1};  ///< along the box's axes: l, m and n of the paper
  std::vector<Vector3> points;           ///< m; point (i, j, k) stands at index({i, j, k})

  std::array<int, 3> counts() const { return {cells[0] + 1, cells[1] + 1, cells[2] + 1}; }
  std::size_t index(const std::array<int, 3>& place) const {
    return (std::size_t(place[0]) * counts()[1] + place[1]) * counts()[2] + place[2];
  }
  /// The point's position while nothing is deformed, m.
  Vector3 rest(const std::array<int, 3>& place) const;
};

/// A box for a lattice around an object with these bounds: sides that are too short to divide by become a
/// tenth of the longest, about their middle. Nothing where the bounds have no size.
std::optional<base::Bounds> ffd_box(base::Bounds around);

/// The largest number of control points in a lattice.
constexpr std::size_t kMostFfdPoints = 32768;

/// A lattice at rest in a box. Fails when a number of cells is below 1, there would be more than
/// kMostFfdPoints points, or the box is not finite or has no volume; make flat things' boxes thicker first.
base::Result<FfdLattice> make_ffd_lattice(const base::Affine3& space_from_box,
                                          const std::array<int, 3>& cells);

/// Does the lattice hold together, as one that comes from a file or from a script may not?
base::Result<void> check(const FfdLattice& lattice);

/// The vertices that a lattice moves, and their places in its box. They are found once; then each state of
/// the lattice is evaluated. Owns its numbers: 56 bytes a vertex.
class FfdBinding {
 public:
  /// Binds those of the positions (m) that are in the box, its faces included. The lattice must be checked.
  FfdBinding(std::span<const Vector3> positions, const FfdLattice& lattice);
  /// Binds only those that are among these vertices, such as a selection.
  FfdBinding(std::span<const Vector3> positions, std::span<const std::uint32_t> vertices,
             const FfdLattice& lattice);

  /// Indices of the vertices in the box, in the order in which they were given.
  const std::vector<std::uint32_t>& vertices() const { return vertices_; }
  /// Their positions under a lattice of the same box and cells, m. With all points at rest these are exactly
  /// the original ones; when all points are moved by one affine map, so is every vertex (to rounding).
  std::vector<Vector3> deformed(const FfdLattice& lattice) const;
  /// The share of a control point's move that each vertex follows, in [0, 1]; over all points, the shares of
  /// a vertex add up to 1. While one point is dragged, a vertex is at its position at the beginning plus its
  /// share of the way: far cheaper than evaluating all.
  std::vector<double> shares(const std::array<int, 3>& point) const;

 private:
  void bind(std::span<const Vector3> positions, std::uint32_t vertex, const base::Affine3& box_from_space);

  std::array<int, 3> cells_;
  std::vector<std::uint32_t> vertices_;
  std::vector<Vector3> rest_;    // m, the original positions
  std::vector<Vector3> in_box_;  // s, t and u of the paper, in [0, 1]
};

}  // namespace icome::geometry
