#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "geometry/contour/contour_grid.h"
#include "geometry/contour/contour_progress.h"

namespace icome::geometry {

/// A crossing of the surface with an edge of the grid.
struct EdgeCrossing {
  double t = 0.5;                     // along the edge, in [0, 1], from its lower end
  Vector3 normal = Vector3::UnitX();  // unit, out of the solid
};

/// The crossing of every crossed edge, by number. Nothing when `go_on` stopped it.
std::optional<std::vector<EdgeCrossing>> find_edge_crossings(const SampledSolid& solid,
                                                             const ContourGrid& grid,
                                                             const ContourCells& cells,
                                                             const ContourProgress& go_on);

/// The crossings on the edges of a cell that belong to one of its sheets.
struct SheetSamples {
  std::array<SurfacePoint, 12> at;
  std::size_t count = 0;
  int corner = -1;  // the cell's corner at which all of them start or end, if they are three around one

  std::span<SurfacePoint> all() { return {at.data(), count}; }
};

/// Collects the samples of cells, which are asked for in the order of their keys. Keeps references to the
/// constructor's arguments.
class SheetSampler {
 public:
  SheetSampler(const ContourGrid& grid, const ContourCells& cells, const std::vector<EdgeCrossing>& crossings,
               ContourGrid::Key start);

  /// The samples of the cell's sheets, four at most.
  std::array<SheetSamples, 4> samples(const ContourCell& cell);

 private:
  const ContourGrid* grid_;
  const std::vector<EdgeCrossing>* crossings_;
  std::vector<ContourCellCursor> owners_;  // of edges that start at each corner
};

}  // namespace icome::geometry
