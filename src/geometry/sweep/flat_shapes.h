#pragma once
#include <array>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"
#include "geometry/sweep/profile.h"

namespace icome::geometry {

// Shapes that are not Primitives: sheets in the plane z = 0, and pyramids. Sheets are one layer of triangles
// that face +z, centred on the origin. Lengths are metres from kSmallestProfile to kLargestProfile; all fail
// with a sentence for others, and for more than kMaximumPolygonCorners corners.

/// A triangle with sides of these lengths; the first side runs along x, below the others, and the centroid
/// lies on the origin. Fails where one side is as long as the other two together.
base::Result<TriangleMesh> triangle_sheet(const std::array<double, 3>& sides);

/// A rectangle of two triangles; a square where both lengths are the same.
base::Result<TriangleMesh> rectangle_sheet(double along_x, double along_y);

/// A polygon of equal sides, with the corners of regular_polygon() and no vertex within.
base::Result<TriangleMesh> polygon_sheet(int sides, double radius);

/// A circle as a polygon of many sides with its corners on it, and a vertex in the middle: it bends evenly.
base::Result<TriangleMesh> circle_sheet(double radius, int segments);

/// A pyramid over the base of a regular polygon: closed, facing out. The base lies at z = -height / 2, the
/// tip at z = height / 2 as that of a Cone.
base::Result<TriangleMesh> pyramid(int sides, double base_radius, double height);

/// The radius (m) of the circle around a regular polygon whose sides have this length (m). Precondition: 3
/// sides or more.
double radius_of_polygon(int sides, double side);

}  // namespace icome::geometry
