#include "geometry/contour/contour_samples.h"

#include <algorithm>
#include <bit>

#include "geometry/contour/contour_search.h"
#include "geometry/contour/contour_sheets.h"

namespace icome::geometry {
namespace {

/// Finds the crossings of the edges at the cell's lowest corner.
void cross_edges_of(const SampledSolid& solid, const ContourGrid& grid, const ContourCell& cell,
                    std::vector<EdgeCrossing>& crossings) {
  const Vector3 low = grid.point(cell.key);
  const bool low_inside = (cell.signs & 1) != 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!crosses_axis(cell, axis)) continue;
    Vector3 high = low;
    high[axis] += grid.cell;
    const SurfacePoint found = low_inside ? find_crossing(solid, low, high) : find_crossing(solid, high, low);
    crossings[edge_number(cell, axis)] = {std::clamp((found.point[axis] - low[axis]) / grid.cell, 0.0, 1.0),
                                          found.normal};
  }
}

}  // namespace

std::optional<std::vector<EdgeCrossing>> find_edge_crossings(const SampledSolid& solid,
                                                             const ContourGrid& grid,
                                                             const ContourCells& cells,
                                                             const ContourProgress& go_on) {
  std::vector<EdgeCrossing> crossings(cells.edges);
  const bool done = contour_in_batches(cells.cells.size(), go_on, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) cross_edges_of(solid, grid, cells.cells[i], crossings);
  });
  if (!done) return std::nullopt;
  return crossings;
}

SheetSampler::SheetSampler(const ContourGrid& grid, const ContourCells& cells,
                           const std::vector<EdgeCrossing>& crossings, ContourGrid::Key start)
    : grid_(&grid), crossings_(&crossings) {
  constexpr int kStarts = 7;  // no edge starts at the highest corner
  owners_.reserve(kStarts);
  for (int corner = 0; corner < kStarts; ++corner) {
    owners_.emplace_back(cells.cells, start + grid.corner_offset(corner));
  }
}

std::array<SheetSamples, 4> SheetSampler::samples(const ContourCell& cell) {
  const CellSheets sheets = cell_sheets(cell.signs, cell.joins);
  std::array<SheetSamples, 4> samples;
  std::array<unsigned, 4> shared;  // corners, as bits, of all edges so far
  shared.fill(0xff);
  for (int edge = 0; edge < 12; ++edge) {
    if (sheets.of_edge[edge] < 0) continue;
    const int corner = edge_start(edge), axis = edge_axis(edge);
    const ContourCell& owner = *owners_[corner].find(cell.key + grid_->corner_offset(corner));
    const EdgeCrossing& crossing = (*crossings_)[edge_number(owner, axis)];
    SheetSamples& sheet = samples[sheets.of_edge[edge]];
    SurfacePoint& sample = sheet.at[sheet.count++];
    sample.point = grid_->point(owner.key);
    sample.point[axis] += crossing.t * grid_->cell;
    sample.normal = crossing.normal;
    shared[sheets.of_edge[edge]] &= 1U << corner | 1U << edge_end(edge);
  }
  for (int sheet = 0; sheet < sheets.count; ++sheet) {
    if (samples[sheet].count == 3 && shared[sheet] != 0)
      samples[sheet].corner = std::countr_zero(shared[sheet]);
  }
  return samples;
}

}  // namespace icome::geometry
