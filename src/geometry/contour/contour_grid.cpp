#include "geometry/contour/contour_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "geometry/contour/contour_sheets.h"

namespace icome::geometry {
namespace {

using Word = std::uint64_t;
using Key = ContourGrid::Key;

constexpr std::uint32_t kWordBits = 64;
/// Blocks of points that `may_cross` is asked about: this many along each axis, after tiles of a word along
/// x. A slab is one block high.
constexpr std::uint32_t kBlock = 8;
// Beyond these a grid takes hours to sample, or its slab gigabytes.
constexpr double kMaxPoints = 0x1p36;
constexpr double kMaxLayer = 0x1p28;
constexpr double kMaxRow = 0x1p24;
/// The smallest cell, as a part of the largest coordinate: places in a cell must be distinguishable.
constexpr double kFinestCell = 1e-11;

/// The grid's first plane lies this part of a cell below the box, different for each axis and far from
/// simple fractions, so that neither faces along the axes nor along their diagonals fall on grid points.
const Vector3 kGridShift(0.3819660112501051, 0.4142135623730950, 0.3183098861837907);

/// Corners inside or not, as bits, for the layers of a slab of grid points.
class SignSlab {
 public:
  SignSlab(const SampledSolid& solid, const ContourGrid& grid)
      : solid_(&solid),
        grid_(&grid),
        words_((grid.points[0] + kWordBits - 1) / kWordBits),
        bits_(std::size_t{kBlock + 1} * grid.points[1] * words_, 0) {}

  /// Samples the layers from z = `first` on (kBlock of them, or up to the last). Layer 0 becomes the last
  /// one of the slab before, so the layers sampled are 1, 2 and so on. Returns their number.
  std::uint32_t sample(std::uint32_t first) {
    const std::size_t layer = std::size_t{grid_->points[1]} * words_;
    std::copy_n(bits_.end() - static_cast<std::ptrdiff_t>(layer), layer, bits_.begin());
    const std::uint32_t layers = std::min(kBlock, grid_->points[2] - first);
    const std::size_t rows = (grid_->points[1] + kBlock - 1) / kBlock;
    base::parallel_for(rows * words_, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t tile = begin; tile < end; ++tile) {
        sample_tile(static_cast<std::uint32_t>(tile % words_),
                    static_cast<std::uint32_t>(tile / words_) * kBlock, first, layers);
      }
    });
    return layers;
  }

  /// The bits of a row of points, a word for each 64 of them.
  const Word* row(std::uint32_t layer, std::uint32_t y) const {
    return bits_.data() + (std::size_t{layer} * grid_->points[1] + y) * words_;
  }
  std::uint32_t words() const { return words_; }

 private:
  struct Range {
    std::array<std::uint32_t, 3> begin, end;
  };

  bool may_cross(const Range& range) const {
    if (!solid_->may_cross) return true;
    const Bounds box(grid_->point(range.begin[0], range.begin[1], range.begin[2]),
                     grid_->point(range.end[0] - 1, range.end[1] - 1, range.end[2] - 1));
    return solid_->may_cross(box);
  }

  bool outermost(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    const auto last = [&](int axis) { return grid_->points[axis] - 1; };
    return x == 0 || y == 0 || z == 0 || x == last(0) || y == last(1) || z == last(2);
  }

  void sample_tile(std::uint32_t word, std::uint32_t y, std::uint32_t z, std::uint32_t layers) {
    const std::uint32_t x = word * kWordBits;
    Range tile{
        {x, y, z},
        {std::min(x + kWordBits, grid_->points[0]), std::min(y + kBlock, grid_->points[1]), z + layers}};
    if (!may_cross(tile)) {
      fill(tile, z);
      return;
    }
    for (std::uint32_t row = y; row < tile.end[1]; ++row) {
      for (std::uint32_t layer = 1; layer <= layers; ++layer) *word_at(layer, row, word) = 0;
    }
    for (std::uint32_t begin = x; begin < tile.end[0]; begin += kBlock) {
      Range block = tile;
      block.begin[0] = begin;
      block.end[0] = std::min(begin + kBlock, tile.end[0]);
      if (solid_->may_cross && !may_cross(block)) {
        fill(block, z);
      } else {
        ask_all(block, z);
      }
    }
  }

  /// Marks all of the range's points as the middle one is: they are all inside or all outside.
  void fill(const Range& range, std::uint32_t first_layer) {
    std::array<std::uint32_t, 3> middle;
    for (int axis = 0; axis < 3; ++axis) middle[axis] = (range.begin[axis] + range.end[axis]) / 2;
    const bool in = solid_->inside(grid_->point(middle[0], middle[1], middle[2]));
    visit(range, first_layer, [in](const Vector3&) { return in; });
  }

  void ask_all(const Range& range, std::uint32_t first_layer) {
    visit(range, first_layer, [this](const Vector3& point) { return solid_->inside(point); });
  }

  template <typename Inside>
  void visit(const Range& range, std::uint32_t first_layer, const Inside& inside) {
    const std::uint32_t word = range.begin[0] / kWordBits;
    const std::uint32_t width = range.end[0] - range.begin[0];
    const Word mask = (width == kWordBits ? ~Word{0} : (Word{1} << width) - 1) << range.begin[0] % kWordBits;
    for (std::uint32_t z = range.begin[2]; z < range.end[2]; ++z) {
      for (std::uint32_t y = range.begin[1]; y < range.end[1]; ++y) {
        Word bits = 0;
        for (std::uint32_t x = range.begin[0]; x < range.end[0]; ++x) {
          const bool in = !outermost(x, y, z) && inside(grid_->point(x, y, z));
          bits |= Word{in} << x % kWordBits;
        }
        Word& place = *word_at(z - first_layer + 1, y, word);
        place = (place & ~mask) | bits;
      }
    }
  }

  Word* word_at(std::uint32_t layer, std::uint32_t y, std::uint32_t word) {
    return bits_.data() + (std::size_t{layer} * grid_->points[1] + y) * words_ + word;
  }

  const SampledSolid* solid_;
  const ContourGrid* grid_;
  std::uint32_t words_;
  std::vector<Word> bits_;
};

/// Collects the cells of one layer, between the points of two layers of the slab.
class CellCollector {
 public:
  CellCollector(const ContourGrid& grid, ContourCells& found) : grid_(&grid), found_(&found) {}

  void collect(const SignSlab& slab, std::uint32_t lower_layer, std::uint32_t z) {
    for (std::uint32_t y = 0; y + 1 < grid_->points[1]; ++y) {
      const Key row_key = y * grid_->stride[1] + z * grid_->stride[2];
      const std::array<const Word*, 4> rows = {slab.row(lower_layer, y), slab.row(lower_layer, y + 1),
                                               slab.row(lower_layer + 1, y),
                                               slab.row(lower_layer + 1, y + 1)};
      for (std::uint32_t word = 0; word < slab.words(); ++word) {
        collect_word(rows, word, word + 1 < slab.words(), row_key);
      }
    }
  }

 private:
  void collect_word(const std::array<const Word*, 4>& rows, std::uint32_t word, bool has_next, Key row_key) {
    std::array<Word, 8> corner;  // a bit for each cell of the word
    Word any = 0, all = ~Word{0};
    for (int i = 0; i < 4; ++i) {
      const Word next = has_next ? rows[i][word + 1] : 0;
      corner[2 * i] = rows[i][word];
      corner[2 * i + 1] = corner[2 * i] >> 1 | next << (kWordBits - 1);
      any |= corner[2 * i] | corner[2 * i + 1];
      all &= corner[2 * i] & corner[2 * i + 1];
    }
    for (Word active = any & ~all; active != 0; active &= active - 1) {
      const int bit = std::countr_zero(active);
      unsigned signs = 0;
      for (int i = 0; i < 8; ++i) signs |= static_cast<unsigned>(corner[i] >> bit & 1) << i;
      add(row_key + Key{word} * kWordBits + static_cast<unsigned>(bit), static_cast<std::uint8_t>(signs));
    }
  }

  void add(Key key, std::uint8_t signs) {
    ContourCell cell;
    cell.key = key;
    cell.signs = signs;
    cell.first_edge = found_->edges;
    for (int axis = 0; axis < 3; ++axis) found_->edges += crosses_axis(cell, axis);
    found_->cells.push_back(cell);
  }

  const ContourGrid* grid_;
  ContourCells* found_;
};

/// Calls `visit(cell, other, face)` for every ambiguous face between two cells; it is the upper one's `face`.
template <typename Visit>
void for_each_ambiguous_face(const ContourGrid& grid, std::vector<ContourCell>& cells, const Visit& visit) {
  for (ContourCell& cell : cells) {
    const unsigned faces = ambiguous_faces(cell.signs);
    for (int axis = 0; axis < 3; ++axis) {
      if ((faces >> (2 * axis) & 1) == 0) continue;
      const ContourCell* other = find_contour_cell(cells, cell.key - grid.stride[axis]);
      visit(cell, cells[static_cast<std::size_t>(other - cells.data())], 2 * axis);
    }
  }
}

/// Joins the corners of ambiguous faces as the solid does in the face's middle, but not so that an edge of
/// the mesh would get four triangles.
void decide_faces(const SampledSolid& solid, const ContourGrid& grid, std::vector<ContourCell>& cells) {
  const auto toggle = [](ContourCell& cell, ContourCell& other, int face) {
    cell.joins ^= static_cast<std::uint8_t>(1 << face);
    other.joins ^= static_cast<std::uint8_t>(1 << (face ^ 1));
  };
  for_each_ambiguous_face(grid, cells, [&](ContourCell& cell, ContourCell& other, int face) {
    Vector3 half = Vector3::Constant(grid.cell / 2);
    half[face / 2] = 0.0;
    if (solid.inside(grid.point(cell.key) + half)) toggle(cell, other, face);
  });
  for_each_ambiguous_face(grid, cells, [&](ContourCell& cell, ContourCell& other, int face) {
    const bool pinched =
        passes_twice(cell.signs, cell.joins, face) && passes_twice(other.signs, other.joins, face ^ 1);
    if (pinched) toggle(cell, other, face);
  });
}

void number_vertices(ContourCells& found) {
  for (ContourCell& cell : found.cells) {
    cell.first_vertex = found.vertices;
    found.vertices += static_cast<std::uint32_t>(cell_sheets(cell.signs, cell.joins).count);
  }
}

}  // namespace

base::Result<ContourGrid> make_contour_grid(const Bounds& box, double cell) {
  if (!(cell > 0) || !std::isfinite(cell)) {
    return base::fail(
        "the cell of a mesh must be a length above 0: give one, such as a hundredth of the size");
  }
  if (!box.min().allFinite() || !box.max().allFinite()) {
    return base::fail("a solid of infinite extent cannot be meshed: intersect it with a box");
  }
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  if (cell < kFinestCell * largest) {
    return base::fail(fmt::format(
        "a cell of {:g} m is too small beside coordinates of {:g} m: choose a larger one", cell, largest));
  }
  ContourGrid grid;
  grid.cell = cell;
  grid.origin = box.min() - cell * kGridShift;
  const Vector3 cells = (box.max() - grid.origin) / cell;
  const Vector3 points = cells.array().floor() + 2;
  const double layer = std::max(points[0], double{kWordBits}) * points[1];
  if (!(points.prod() <= kMaxPoints && layer <= kMaxLayer && points.maxCoeff() <= kMaxRow)) {
    return base::fail(
        fmt::format("a cell of {:g} m makes a grid of {:g} x {:g} x {:g} cells: choose a larger one", cell,
                    points[0] - 1, points[1] - 1, points[2] - 1));
  }
  Key stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    grid.points[axis] = static_cast<std::uint32_t>(points[axis]);
    grid.stride[axis] = stride;
    stride *= grid.points[axis];
  }
  return grid;
}

base::Result<ContourCells> sample_contour_cells(const SampledSolid& solid, const ContourGrid& grid,
                                                std::uint32_t max_edges, const ContourProgress& go_on) {
  ContourCells found;
  SignSlab slab(solid, grid);
  CellCollector collector(grid, found);
  for (std::uint32_t first = 0; first < grid.points[2]; first += kBlock) {
    if (!go_on(static_cast<double>(first) / grid.points[2])) return base::fail("the meshing was interrupted");
    const std::uint32_t layers = slab.sample(first);
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
      if (first + layer > 0) collector.collect(slab, layer, first + layer - 1);
      if (found.edges > max_edges) {
        return base::fail(
            fmt::format("the mesh takes more than {} triangles with a cell of {:g} m: choose a larger cell",
                        std::size_t{max_edges} * 2, grid.cell));
      }
    }
  }
  decide_faces(solid, grid, found.cells);
  number_vertices(found);
  return found;
}

const ContourCell* find_contour_cell(const std::vector<ContourCell>& cells, Key key) {
  return ContourCellCursor(cells, key).find(key);
}

bool is_lone_point(const ContourGrid& grid, const std::vector<ContourCell>& cells, const ContourCell& cell,
                   int corner) {
  const Key point = cell.key + grid.corner_offset(corner);
  for (int axis = 0; axis < 3; ++axis) {
    for (const Key start : {point, point - grid.stride[axis]}) {
      const ContourCell* at = find_contour_cell(cells, start);
      if (at == nullptr || !crosses_axis(*at, axis)) return false;
    }
  }
  return true;
}

ContourCellCursor::ContourCellCursor(const std::vector<ContourCell>& cells, Key start)
    : next_(std::lower_bound(cells.data(), cells.data() + cells.size(), start,
                             [](const ContourCell& cell, Key wanted) { return cell.key < wanted; })),
      end_(cells.data() + cells.size()) {}

const ContourCell* ContourCellCursor::find(Key key) {
  while (next_ != end_ && next_->key < key) ++next_;
  return next_ != end_ && next_->key == key ? next_ : nullptr;
}

}  // namespace icome::geometry
