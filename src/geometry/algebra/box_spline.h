#pragma once
#include <array>

#include "base/vector.h"

namespace icome::geometry {

using base::Vector3;

/// A point or vector in the first three coordinates; the fourth is 0. Two of them fit the vector
/// registers that every x86-64 has, which three do not.
using Vector4 = Eigen::Vector4d;

/// A triangle of a quartic surface in Bernstein form over s, t >= 0, s + t <= 1. Point (i, j, k),
/// i + j + k = 4, belongs to (1 - s - t)^i s^j t^k and stands at index(j, k). The surface lies in the convex
/// hull of the points.
struct QuarticTriangle {
  static constexpr int kDegree = 4;
  static constexpr int kPoints = 15;
  static constexpr int index(int j, int k) { return k * (11 - k) / 2 + j; }

  std::array<Vector4, kPoints> points;
};

/// Position and derivatives with respect to s and t.
struct QuarticJet {
  Vector4 value, ds, dt;
};
struct QuarticJet2 : QuarticJet {
  Vector4 dss, dst, dtt;
};

/// Twelve control points of a regular triangle of Loop's scheme (Loop 1987, Stam 1999), on the lattice that s
/// and t span: the triangle (0,0) (1,0) (0,1), then counter-clockwise around it (-1,1) (-1,0) (0,-1) (1,-1)
/// (2,-1) (2,0) (1,1) (0,2) (-1,2).
inline constexpr int kBoxSplinePoints = 12;
using BoxSplineControl = std::array<Vector4, kBoxSplinePoints>;

/// The limit surface of the triangle, the quartic box spline. Real-time safe.
QuarticTriangle box_spline_triangle(const BoxSplineControl& control);

/// Real-time safe, also outside the triangle, where the polynomial goes on.
QuarticJet evaluate(const QuarticTriangle& triangle, double s, double t);
QuarticJet2 evaluate2(const QuarticTriangle& triangle, double s, double t);

/// Cuts the triangle from its first corner to the middle of the opposite side. The halves' first corners are
/// that middle; their second and third are the old first and second, and the old third and first.
/// Real-time safe.
void bisect(const QuarticTriangle& triangle, QuarticTriangle& one, QuarticTriangle& other);

}  // namespace icome::geometry
