#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/contour/contour_grid.h"

namespace icome::geometry {

/// Four vertices, counter-clockwise seen from outside.
using ContourQuad = std::array<std::uint32_t, 4>;

/// The quad around each crossed edge, by number: it connects the sheets that cross the edge.
std::optional<std::vector<ContourQuad>> connect_quads(const ContourGrid& grid, const ContourCells& cells,
                                                      const ContourProgress& go_on);

}  // namespace icome::geometry
