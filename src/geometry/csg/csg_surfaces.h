#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/csg/csg_program.h"

namespace icome::geometry {

/// Brings numbers into rising order, each once.
void make_set(std::vector<std::uint32_t>& numbers);

/// The surfaces along which a CSG solid can be cut: those of its atoms in closed form, and for each mesh the
/// planes of its faces, one for all triangles side by side that lie in it. Owns copies; the program that it
/// was made from must stay. Lengths m, tree's frame.
class CsgSurfaces {
 public:
  using Index = std::uint32_t;
  static constexpr Index kNone = ~Index{0};

  /// Precondition: csg_can_cut (csg_cut.h).
  explicit CsgSurfaces(const CsgProgram& program);

  std::size_t size() const { return surfaces_.size(); }
  /// The surface's shape; never a mesh.
  const CsgAtom& shape(Index surface) const { return surfaces_[surface].shape; }
  bool is_plane(Index surface) const { return shape(surface).kind == CsgAtom::Kind::Plane; }
  /// The surface of an atom that is no mesh.
  Index of_atom(std::uint32_t atom) const { return first_[atom]; }

  /// The first of the surfaces that coincide with this one, and whether it faces the opposite way.
  Index like(Index surface) const { return surfaces_[surface].like; }
  bool opposite(Index surface) const { return surfaces_[surface].opposite; }
  /// The surfaces replaced by the first that coincide with them, each once, rising.
  std::vector<Index> unlike(std::vector<Index> surfaces) const;

  /// The surfaces of `among` that may pass the box and matter there.
  std::vector<Index> open(const Bounds& box, const std::vector<Index>& among) const;
  /// The atoms that they belong to, rising.
  std::vector<std::uint32_t> atoms(const std::vector<Index>& surfaces) const;

  /// The signed distance of the place in front of the surface, and the normal there, to first order.
  AtomHeight height(Index surface, const Vector3& place) const;
  /// The radius of the tightest bend near the place, exact where the transform is even, as it matters for a
  /// mesh with cells of `cell`: tips count as no sharper than such a mesh can follow. Infinite for a plane.
  double bend(Index surface, const Vector3& place, double cell) const;
  /// The tip of a cone, and the direction out of it along the axis; nothing for other shapes.
  std::optional<SurfacePoint> apex(Index surface) const;

 private:
  struct Surface {
    CsgAtom shape;
    std::uint32_t atom;
    Bounds reach;  // the box in which it can matter
    Index like = kNone;
    bool opposite = false;
  };

  void add_faces(const CsgAtom& mesh, std::uint32_t atom, const Bounds& relevant, double length);
  void find_likes(double length);

  std::vector<Surface> surfaces_;
  std::vector<Index> first_;  // by atom
};

}  // namespace icome::geometry
