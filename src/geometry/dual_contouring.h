#pragma once
#include <cstddef>
#include <functional>

#include "base/function_ref.h"
#include "base/result.h"
#include "geometry/primitive.h"
#include "geometry/triangle_mesh.h"

namespace icome::geometry {

/// A solid given by two questions, for meshing. In its own frame, m.
struct SampledSolid {
  Bounds bounds;
  /// Is the point inside?
  std::function<bool(const Vector3&)> inside;
  /// Where the surface crosses the segment between a point that is inside and one that is not, and its
  /// outward normal there.
  std::function<SurfacePoint(const Vector3& a, const Vector3& b)> crossing;
};

struct ContourOptions {
  double cell = 0.0;  // m, edge of the grid's cells
  std::size_t max_triangles = 20'000'000;
  std::function<bool(double part)> progress = {};  // called now and then; false stops
};

struct ContourMesh {
  TriangleMesh mesh;   // closed: every edge has two triangles
  double error = 0.0;  // m, the largest distance from a vertex or triangle centre to the surface, measured
};

/// A closed, watertight triangle mesh of the solid's surface that keeps its sharp edges and corners: dual
/// contouring (Ju et al., 2002), made manifold where a cell holds several sheets (Schaefer et al., 2007).
/// Parts thinner than a cell may be lost. Fails when it is interrupted or gets too large.
base::Result<ContourMesh> contour(const SampledSolid& solid, const ContourOptions& options);

}  // namespace icome::geometry
