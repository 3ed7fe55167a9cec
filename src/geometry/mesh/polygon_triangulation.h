#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// The most corners triangulate_polygon() takes: its time grows with their square.
inline constexpr std::size_t kMaximumPolygonCorners = 20'000;

/// Cuts a simple polygon in space into corners.size() - 2 triangles of the same winding, by clipping the
/// best-shaped ear first (ear clipping: Meisters 1975). Concave polygons and holes joined to the rim by
/// a bridge are handled; of a polygon that crosses itself every corner is used, but triangles overlap.
/// Corners need not lie exactly in one plane. Corners on a straight line may give triangles without
/// area, which repair() removes.
///
/// Appends indices into `corners` to `triangles`. Precondition: 3 to kMaximumPolygonCorners corners.
void triangulate_polygon(std::span<const Vector3> corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace icome::geometry
