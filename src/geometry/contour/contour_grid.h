#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "geometry/contour/contour_progress.h"
#include "geometry/contour/dual_contouring.h"

namespace icome::geometry {

/// The layout of a contouring grid's points. A cell has the number (key) of its lowest corner.
struct ContourGrid {
  using Key = std::uint64_t;

  Vector3 origin = Vector3::Zero();          // m, the first point
  double cell = 0.0;                         // m
  std::array<std::uint32_t, 3> points = {};  // along x, y and z
  std::array<Key, 3> stride = {};            // between the keys of neighbours along x, y and z

  Key total() const { return stride[2] * points[2]; }
  Vector3 point(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return origin + cell * Vector3(x, y, z);
  }
  Vector3 point(Key key) const {
    return point(static_cast<std::uint32_t>(key % stride[1]),
                 static_cast<std::uint32_t>(key % stride[2] / stride[1]),
                 static_cast<std::uint32_t>(key / stride[2]));
  }
  /// The cell around a point, which lies in the grid or up to a cell beside it.
  Key cell_at(const Vector3& place) const {
    const Vector3 steps = ((place - origin) / cell).array().floor().max(0.0);
    return static_cast<Key>(steps[0]) + static_cast<Key>(steps[1]) * stride[1] +
           static_cast<Key>(steps[2]) * stride[2];
  }
  /// The offset from a cell's key to that of the cell with this corner as lowest (contour_sheets.h).
  Key corner_offset(int corner) const {
    return (corner & 1) * stride[0] + (corner >> 1 & 1) * stride[1] + (corner >> 2 & 1) * stride[2];
  }
};

/// A grid around the box, one layer of points outside it all around. Its planes avoid the usual places of
/// models' faces, at round fractions of cells from the box's sides. Fails when the cell is too small for
/// the box, or for doubles so far from the origin.
base::Result<ContourGrid> make_contour_grid(const Bounds& box, double cell);

/// A cell that the surface passes, judged by its corners.
struct ContourCell {
  ContourGrid::Key key = 0;
  std::uint32_t first_edge = 0;    // its crossed edges at corner 0, by axis, have numbers from here on
  std::uint32_t first_vertex = 0;  // its sheets' vertices have numbers from here on
  std::uint8_t signs = 0;          // bit c: corner c is inside
  std::uint8_t joins = 0;          // for cell_sheets
};

/// Is the edge from the cell's corner 0 along the axis crossed?
inline bool crosses_axis(const ContourCell& cell, int axis) {
  return ((cell.signs ^ cell.signs >> (1 << axis)) & 1) != 0;
}

/// The number of the edge from corner 0 along the axis. Precondition: it is crossed.
inline std::uint32_t edge_number(const ContourCell& cell, int axis) {
  std::uint32_t number = cell.first_edge;
  for (int before = 0; before < axis; ++before) number += crosses_axis(cell, before);
  return number;
}

/// The cells that the surface passes, by key.
struct ContourCells {
  std::vector<ContourCell> cells;
  std::uint32_t edges = 0;
  std::uint32_t vertices = 0;
};

/// Samples the solid at the grid's points, and at the middles of ambiguous faces, and gives the cells that
/// the surface passes. The outermost points count as outside. `go_on` is called with the part done, and stops
/// it with false. Fails then, and when more than `max_edges` edges are crossed.
base::Result<ContourCells> sample_contour_cells(const SampledSolid& solid, const ContourGrid& grid,
                                                std::uint32_t max_edges, const ContourProgress& go_on);

/// The cell with this key, null when it is not among them.
const ContourCell* find_contour_cell(const std::vector<ContourCell>& cells, ContourGrid::Key key);

/// Are all six edges at the cell's corner crossed, so that the surface around its point is a sheet of its
/// own, smaller than two cells?
bool is_lone_point(const ContourGrid& grid, const std::vector<ContourCell>& cells, const ContourCell& cell,
                   int corner);

/// Finds cells in the order of their keys, each time by walking on from the last: constant time when keys
/// are asked for in rising order.
class ContourCellCursor {
 public:
  ContourCellCursor(const std::vector<ContourCell>& cells, ContourGrid::Key start);
  /// The cell with this key, null when it is not among them.
  const ContourCell* find(ContourGrid::Key key);

 private:
  const ContourCell *next_, *end_;
};

}  // namespace icome::geometry
