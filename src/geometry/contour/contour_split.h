#pragma once
#include <array>
#include <optional>
#include <vector>

#include "geometry/contour/contour_quads.h"
#include "geometry/contour/dual_contouring.h"

namespace icome::geometry {

/// A quad as two triangles, with a measure of how badly they represent the surface.
struct QuadSplit {
  std::array<TriangleMesh::Triangle, 2> triangles;
  /// m: the largest distance of the triangles' centres and of the diagonal's middle from the surface, plus
  /// up to two cells for a triangle that faces another way than the surface near it; 8 cells where one of
  /// them has no area. Zero where all is so flat that the surface has no edge there.
  double fault = 0.0;
};

/// Divides quads along the diagonal that keeps to the surface, along the surface's edges where it has some.
/// Keeps references to the constructor's arguments.
class QuadSplitter {
 public:
  QuadSplitter(const SampledSolid& solid, double cell, const std::vector<Vector3>& positions)
      : solid_(&solid), cell_(cell), positions_(&positions) {}

  /// `normal` is the surface's where it crosses the edge that the quad goes around.
  QuadSplit split(const ContourQuad& quad, const Vector3& normal) const;

  /// Is the triangle so thin that it has no normal to speak of?
  bool sliver(const TriangleMesh::Triangle& triangle) const;
  Vector3 normal(const TriangleMesh::Triangle& triangle) const { return doubled_area(triangle).normalized(); }
  Vector3 centre(const TriangleMesh::Triangle& triangle) const {
    return (at(triangle[0]) + at(triangle[1]) + at(triangle[2])) / 3;
  }

 private:
  const Vector3& at(std::uint32_t vertex) const { return (*positions_)[vertex]; }
  Vector3 doubled_area(const TriangleMesh::Triangle& triangle) const {
    return (at(triangle[1]) - at(triangle[0])).cross(at(triangle[2]) - at(triangle[0]));
  }
  double agreement(const std::array<TriangleMesh::Triangle, 2>& triangles, const Vector3& normal) const;
  double off_surface(std::uint32_t from, std::uint32_t to, const Vector3& direction) const;
  double fault(const std::array<TriangleMesh::Triangle, 2>& triangles, const Vector3& across) const;

  const SampledSolid* solid_;
  double cell_;
  const std::vector<Vector3>* positions_;
};

}  // namespace icome::geometry
