#include "geometry/contour/contour_sheets.h"

#include <numeric>

namespace icome::geometry {
namespace {

bool corner_inside(unsigned signs, int corner) { return (signs >> corner & 1) != 0; }

bool edge_crossed(unsigned signs, int edge) {
  return corner_inside(signs, edge_start(edge)) != corner_inside(signs, edge_end(edge));
}

bool on_face(int corner, int face) { return (corner >> (face / 2) & 1) == (face & 1); }

bool edge_on_face(int edge, int face) {
  return on_face(edge_start(edge), face) && on_face(edge_end(edge), face);
}

/// Are two corners of the face inside, and do they lie opposite?
bool ambiguous(unsigned signs, int face) {
  int crossed = 0;
  for (int edge = 0; edge < 12; ++edge) crossed += edge_on_face(edge, face) && edge_crossed(signs, edge);
  return crossed == 4;
}

class EdgeSets {
 public:
  EdgeSets() { std::iota(set_.begin(), set_.end(), 0); }
  void unite(int a, int b) {
    const int from = set_[a], to = set_[b];
    for (int& set : set_) set = set == from ? to : set;
  }
  int of(int edge) const { return set_[edge]; }

 private:
  std::array<int, 12> set_ = {};
};

/// Unites those crossed edges of the face between which the surface runs over the face.
void connect_over_face(unsigned signs, int face, bool joined, EdgeSets& sets) {
  const bool cornerwise = ambiguous(signs, face);
  for (int a = 0; a < 12; ++a) {
    for (int b = 0; b < a; ++b) {
      if (!edge_on_face(a, face) || !edge_on_face(b, face)) continue;
      if (!edge_crossed(signs, a) || !edge_crossed(signs, b)) continue;
      if (!cornerwise) {
        sets.unite(a, b);
        continue;
      }
      for (const int corner : {edge_start(a), edge_end(a)}) {
        const bool shared = corner == edge_start(b) || corner == edge_end(b);
        if (shared && corner_inside(signs, corner) != joined) sets.unite(a, b);
      }
    }
  }
}

CellSheets find_sheets(unsigned signs, unsigned joins) {
  EdgeSets sets;
  for (int face = 0; face < 6; ++face) connect_over_face(signs, face, (joins >> face & 1) != 0, sets);
  CellSheets sheets;
  std::array<std::int8_t, 12> sheet_of_set;
  sheet_of_set.fill(-1);
  for (int edge = 0; edge < 12; ++edge) {
    sheets.of_edge[edge] = -1;
    if (!edge_crossed(signs, edge)) continue;
    std::int8_t& sheet = sheet_of_set[sets.of(edge)];
    if (sheet < 0) sheet = sheets.count++;
    sheets.of_edge[edge] = sheet;
  }
  return sheets;
}

/// Tables by a cell's signs: its sheets without joins, as most cells need them, and its ambiguous faces.
struct SheetTable {
  std::array<CellSheets, 256> sheets;
  std::array<std::uint8_t, 256> ambiguous_faces = {};

  SheetTable() {
    for (unsigned signs = 0; signs < 256; ++signs) {
      sheets[signs] = find_sheets(signs, 0);
      for (int face = 0; face < 6; ++face) {
        ambiguous_faces[signs] |= static_cast<std::uint8_t>(ambiguous(signs, face) << face);
      }
    }
  }
};

const SheetTable& sheet_table() {
  static const SheetTable kTable;
  return kTable;
}

}  // namespace

std::uint8_t ambiguous_faces(std::uint8_t signs) { return sheet_table().ambiguous_faces[signs]; }

CellSheets cell_sheets(std::uint8_t signs, std::uint8_t joins) {
  return joins == 0 ? sheet_table().sheets[signs] : find_sheets(signs, joins);
}

bool passes_twice(std::uint8_t signs, std::uint8_t joins, int face) {
  const CellSheets sheets = cell_sheets(signs, joins);
  int first = -1;
  for (int edge = 0; edge < 12; ++edge) {
    if (!edge_on_face(edge, face)) continue;
    if (first < 0) first = sheets.of_edge[edge];
    if (sheets.of_edge[edge] != first) return false;
  }
  return true;
}

}  // namespace icome::geometry
