#pragma once
#include <span>
#include <vector>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// A piece of the plane: the part within the rim and in no hole. Edges meet at corners only.
struct Outline {
  std::vector<Vector2> rim = {};                 ///< counter-clockwise
  std::vector<std::vector<Vector2>> holes = {};  ///< each clockwise, within the rim and beside the others
};

/// Cuts the piece into triangles that wind like the rim, by joining each hole with a bridge to a corner right
/// of it (Eberly, Triangulation by Ear Clipping). Decisions are exact where coordinates are whole numbers,
/// no two of which differ by more than 2^26. Appends indices that count the corners of the rim, then those of
/// the holes in turn. Fails for holes that are not within the rim, for a ring of less than 3 corners, for
/// corners that are not finite, and for more than kMaximumPolygonCorners with those of the bridges, two for
/// each hole.
base::Result<void> triangulate(const Outline& outline, std::vector<TriangleMesh::Triangle>& triangles);

/// The outlines as solids from z = -depth / 2 to depth / 2, closed and facing out, each with vertices of its
/// own; where depth is 0, as sheets in the plane z = 0 that face +z. Precondition: depth is not negative.
base::Result<TriangleMesh> solid_of_outlines(std::span<const Outline> outlines, double depth);

}  // namespace icome::geometry
