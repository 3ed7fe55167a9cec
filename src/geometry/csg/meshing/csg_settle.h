#pragma once
#include <array>
#include <vector>

#include "geometry/csg/csg_surfaces.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

// Steps that make a mesh that was cut along surfaces exact and sparse. `faces` has for each of its triangles
// the surface along which it was cut, or CsgSurfaces::kNone. Lengths m.

/// Moves each vertex to the nearest place that all surfaces around it pass, by Newton's method: corners of
/// chords of bent surfaces onto these, so that rims lie on both. One that would turn a triangle over, or
/// where the surfaces do not meet, stays where it is.
void settle_vertices(TriangleMesh& mesh, const std::vector<CsgSurfaces::Index>& faces,
                     const CsgSurfaces& surfaces);

/// For each tip of a cone that the solid has, moves the nearest vertex on the cone alone onto it, where one
/// lies within a `cell` (m): no edge of the cut mesh meets a tip. Returns by vertex whether it is a tip.
std::vector<bool> settle_tips(TriangleMesh& mesh, const std::vector<CsgSurfaces::Index>& faces,
                              const CsgProgram& program, const CsgSurfaces& surfaces, double cell);

/// Tells which triangles may represent a part of the surface that they were cut along. Keeps references to
/// the constructor's arguments.
class ChordJudge {
 public:
  /// `cell` (m) as for chord_height().
  ChordJudge(const CsgProgram& program, const CsgSurfaces& surfaces, double cell)
      : program_(program), surfaces_(surfaces), cell_(cell) {}

  /// On a plane, all may. On a bent surface, those that are no farther off than a chord may be, nor than a
  /// small part of the wall behind or of the gap in front of it, and that face as the surface does. Triangles
  /// face out of the solid.
  bool stands_for(CsgSurfaces::Index surface, const std::array<Vector3, 3>& corners) const;

 private:
  bool near_against_thickness(const Vector3& place, const AtomHeight& there, bool faces_out) const;

  const CsgProgram& program_;
  const CsgSurfaces& surfaces_;
  double cell_;
};

}  // namespace icome::geometry
