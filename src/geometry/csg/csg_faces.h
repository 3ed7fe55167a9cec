#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/csg/csg_program.h"
#include "geometry/smooth_surface.h"
#include "geometry/tree/box_tree.h"

namespace icome::geometry {

/// A triangle of a mesh atom in the tree's frame, moved along its normal by `shift` metres.
struct PlacedTriangle {
  PlacedTriangle(const CsgAtom& atom, std::uint32_t triangle, double shift);
  /// Is the point, which lies in the triangle's plane, within its edges, or as little as `slack` beyond?
  bool covers(const Vector3& point, double slack) const;

  Corners corners;
  Vector3 normal;  // unit, out of the mesh
};

/// The faces of a CSG solid: atoms (of a mesh its triangles) where 5.5.5 says that they can matter, trimmed
/// by the tree's program. For a ball as tip they are the places of its centre while it rests on a face: each
/// atom at the ball's radius, trimmed where the foot below is; a face that no ball of this size can reach,
/// such as that of a narrower hole, is left out. Immutable. Functions as in SmoothSurface; pieces are faces.
class CsgFaces {
 public:
  /// `tip`: the ball's radius (m, 0 is a point).
  /// Precondition: tip is 0, or has_offset() holds for every atom.
  CsgFaces(const CsgTree& tree, double tip);

  const CsgProgram& program() const { return program_; }
  double tip() const { return tip_; }
  std::uint32_t count() const { return std::uint32_t(faces_.size()); }
  std::uint32_t atom_of(std::uint32_t face) const { return faces_[face].atom; }
  std::uint32_t triangle_of(std::uint32_t face) const { return faces_[face].triangle; }
  const BoxTree& tree() const { return tree_; }
  Bounds box(std::uint32_t face) const;

  void near(const Vector3& a, const Vector3& b, double reach, SmoothSurface::PieceVisitor visit) const;
  std::optional<SurfaceHit> first_hit(std::uint32_t face, const Vector3& start, const Vector3& step,
                                      bool from_behind, double slack) const;
  SurfacePlace nearest_local(const SurfacePlace& from, const Vector3& goal) const;
  bool covers(const SurfacePlace& place, double slack) const;
  /// The place of the face nearest to a point behind it; of a triangle, within its edges. Real-time safe.
  SurfacePlace nearest(std::uint32_t face, const Vector3& point) const;

  std::size_t bytes() const;

 private:
  struct Face {
    std::uint32_t atom;
    std::uint32_t triangle;  // of a mesh
  };

  const CsgAtom& atom(std::uint32_t face) const {
    return rests_.empty() ? program_.atoms()[faces_[face].atom] : rests_[faces_[face].atom];
  }
  double sign(std::uint32_t face) const { return atom(face).subtracted ? -1.0 : 1.0; }
  double shift(std::uint32_t face) const { return sign(face) * tip_; }
  bool trimmed_in(std::uint32_t face, const Vector3& point, const Vector3& normal, double slack) const;
  SurfacePlace place(std::uint32_t face, const Vector3& point, const Vector3& atom_normal) const;
  void sort(const std::vector<Face>& unsorted, const std::vector<Bounds>& bounds);

  CsgProgram program_;
  double tip_;
  std::vector<CsgAtom> rests_;   // the atoms at the tip's radius, if that is not 0
  std::vector<Face> faces_;      // in the tree's order
  std::vector<FloatBox> boxes_;  // of the faces
  BoxTree tree_;
};

}  // namespace icome::geometry
