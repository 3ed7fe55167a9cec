#include "geometry/contour/contour_quads.h"

#include <utility>

#include "geometry/contour/contour_sheets.h"

namespace icome::geometry {
namespace {

/// The four cells around an edge in counter-clockwise order seen from the axis's upper end, told by whether
/// they lie one below the edge's own cell along the two next axes.
constexpr bool kBelow[4][2] = {{false, false}, {true, false}, {true, true}, {false, true}};

/// Connects the sheets around edges; one for each part of the cells worked on in parallel.
class QuadConnector {
 public:
  QuadConnector(const ContourGrid& grid, const ContourCells& cells, ContourGrid::Key start) : grid_(&grid) {
    cursors_.reserve(12);
    for (int axis = 0; axis < 3; ++axis) {
      for (const auto& below : kBelow) {
        const ContourGrid::Key offset = offset_below(axis, below);
        cursors_.emplace_back(cells.cells, start > offset ? start - offset : 0);
      }
    }
  }

  ContourQuad connect(const ContourCell& cell, int axis) {
    ContourQuad quad;
    for (int i = 0; i < 4; ++i) {
      const ContourCell& around = *cursors_[axis * 4 + i].find(cell.key - offset_below(axis, kBelow[i]));
      const int edge = axis * 4 + kBelow[i][0] + 2 * kBelow[i][1];
      const int sheet = cell_sheets(around.signs, around.joins).of_edge[edge];
      quad[i] = around.first_vertex + static_cast<std::uint32_t>(sheet);
    }
    const bool upwards = (cell.signs & 1) != 0;  // the solid is below, its outside above
    if (!upwards) std::swap(quad[1], quad[3]);
    return quad;
  }

 private:
  ContourGrid::Key offset_below(int axis, const bool (&below)[2]) const {
    return below[0] * grid_->stride[(axis + 1) % 3] + below[1] * grid_->stride[(axis + 2) % 3];
  }

  const ContourGrid* grid_;
  std::vector<ContourCellCursor> cursors_;
};

}  // namespace

std::optional<std::vector<ContourQuad>> connect_quads(const ContourGrid& grid, const ContourCells& cells,
                                                      const ContourProgress& go_on) {
  std::vector<ContourQuad> quads(cells.edges);
  const bool done = contour_in_batches(cells.cells.size(), go_on, [&](std::size_t begin, std::size_t end) {
    QuadConnector connector(grid, cells, cells.cells[begin].key);
    for (std::size_t i = begin; i < end; ++i) {
      const ContourCell& cell = cells.cells[i];
      for (int axis = 0; axis < 3; ++axis) {
        if (crosses_axis(cell, axis)) quads[edge_number(cell, axis)] = connector.connect(cell, axis);
      }
    }
  });
  if (!done) return std::nullopt;
  return quads;
}

}  // namespace icome::geometry
