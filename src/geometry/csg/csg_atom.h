#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/algebra/polynomial.h"
#include "geometry/csg/csg_leaf.h"

namespace icome::geometry {

/// One smooth surface that divides space in two, on which faces of solids lie. A box is the intersection
/// of six, a cylinder of three. Its kinds, in its own frame:
struct CsgAtom {
  enum class Kind : std::uint8_t {
    Plane,     // solid below z = 0
    Sphere,    // of radius a
    Cylinder,  // of radius a about z
    ConeSide,  // of radius a + b z about z; a > 0 or b != 0
    Torus,     // tube of radius b around the circle of radius a in the plane z = 0
    Capsule,   // all within a of the axis from z = -b to b
    Mesh,      // a closed mesh; its triangles are separate faces
    Custom,    // any that answers the three queries
  };

  CsgAtom(Kind atom_kind, double size_a, double size_b, const Affine3& tree_from_frame);

  Kind kind;
  bool subtracted = false;  // the solid lies behind it: its faces are touched from within
  double a, b;              // m
  Affine3 tree_from_atom, atom_from_tree;
  Matrix3 normal_map;   // takes unit normals of the atom's frame to normals of the tree's, not unit
  Matrix3 metric;       // squared lengths of the tree's frame in terms of the atom's
  double most_stretch;  // the largest factor of normal_map
  bool similar;         // the transform keeps angles
  std::shared_ptr<const MeshSolid> mesh;       // of a Mesh, else null
  std::shared_ptr<const CsgPrimitive> custom;  // of a Custom, else null
};

/// The atoms whose intersection the leaf is.
std::vector<CsgAtom> atoms(const CsgLeaf& leaf);

/// Is the surface at a distance from the atom's known in closed form? For planes and meshes (triangle by
/// triangle) however they are stretched, for curved kinds while angles are kept.
bool has_offset(const CsgAtom& atom);

/// The atom whose surface lies `distance` metres (tree's frame) in front of this one's, or behind it if that
/// is negative: of the same kind. Nothing where none is left. A mesh stays as it is: each of its triangles
/// moves by itself. Precondition: has_offset().
std::optional<CsgAtom> offset(const CsgAtom& atom, double distance);

// All of the following: not for meshes, in the atom's own frame unless they say tree. Real-time safe.

/// Signed distance to the surface (for a cone, beyond its apex, to the extended side); negative within.
double signed_distance(const CsgAtom& atom, const Vector3& point);

/// Is all of the box (tree's frame) behind the atom, or all in front of it? Nothing where neither is certain.
/// For meshes, too.
std::optional<bool> side_of(const CsgAtom& atom, const Bounds& box);

/// The place at which the distance is zero, straight along its gradient from `point`.
SurfacePoint retract(const CsgAtom& atom, const Vector3& point);

/// The signed distance (m) of `point` in front of the surface, and the unit normal there: in the tree's
/// frame, to first order.
struct AtomHeight {
  double height;
  Vector3 normal;
};
AtomHeight height_in_tree(const CsgAtom& atom, const Vector3& point);

/// The radius (m, the atom's frame) of the tightest bend near a place of the surface; infinite for a plane.
double tightest_bend(const CsgAtom& atom, const Vector3& place);

/// The t in [0, 1], rising, at which start + t step changes sides. Not for Custom.
RealRoots crossings(const CsgAtom& atom, const Vector3& start, const Vector3& step);

/// Walks along the surface, from the place nearest to `from`, downhill in the distance (as measured in
/// the tree's frame) to `goal`; ends at the minimum (`reached`) or after turning some 0.3 rad.
struct WalkEnd {
  SurfacePoint place;
  bool reached;
};
WalkEnd walk(const CsgAtom& atom, const Vector3& from, const Vector3& goal);

/// The apex of a cone's side. Precondition: b != 0.
inline Vector3 apex(const CsgAtom& cone) { return {0.0, 0.0, -cone.a / cone.b}; }

/// The way out of the cone along its axis at the apex, unit.
inline Vector3 way_out_of_apex(const CsgAtom& cone) { return {0.0, 0.0, cone.b < 0.0 ? 1.0 : -1.0}; }

/// The unit normal in the tree's frame for one in the atom's.
inline Vector3 tree_normal(const CsgAtom& atom, const Vector3& normal) {
  return (atom.normal_map * normal).normalized();
}

}  // namespace icome::geometry
