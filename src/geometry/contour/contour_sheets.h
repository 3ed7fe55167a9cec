#pragma once
#include <array>
#include <cstdint>

namespace icome::geometry {

// Numbers in a cell of a contouring grid: corner c lies at x = c & 1, y = c >> 1 & 1, z = c >> 2. Edge e runs
// along axis e / 4 from corner edge_start(e); face f is normal to axis f / 2 and lies at its end f & 1.

constexpr int edge_axis(int edge) { return edge / 4; }

/// The corner where the edge begins, at the lower end of its axis.
constexpr int edge_start(int edge) {
  const int axis = edge_axis(edge);
  return (edge & 1) << ((axis + 1) % 3) | (edge >> 1 & 1) << ((axis + 2) % 3);
}

constexpr int edge_end(int edge) { return edge_start(edge) | 1 << edge_axis(edge); }

/// The sheets of the surface in a cell, each a disc that crosses some of the cell's edges.
struct CellSheets {
  std::int8_t count = 0;
  std::array<std::int8_t, 12> of_edge = {};  // the sheet that crosses the edge; -1 for none
};

/// The faces, as bits, of which two opposite corners are inside and two are not. `signs`: bit c says that
/// corner c is inside.
std::uint8_t ambiguous_faces(std::uint8_t signs);

/// The sheets of a cell, four at most. `joins` has a bit for each ambiguous face: set where its inner corners
/// are joined; else its outer ones are.
CellSheets cell_sheets(std::uint8_t signs, std::uint8_t joins);

/// Does one sheet pass the ambiguous face twice? Where that is so in both cells at a face, an edge of the
/// mesh would get four triangles. Joining the face's other corners divides both sheets, and never makes a
/// sheet pass another face twice (compare Wenger, Isosurfaces, 2013, section 3.3.5).
bool passes_twice(std::uint8_t signs, std::uint8_t joins, int face);

}  // namespace icome::geometry
