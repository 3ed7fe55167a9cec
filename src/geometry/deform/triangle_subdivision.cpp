#include "geometry/deform/triangle_subdivision.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "geometry/mesh/mesh_check.h"

namespace icome::geometry {
namespace {

using Piece = TriangleSubdivision::Piece;

constexpr std::uint32_t kUncut = 0xffffffff;
constexpr std::size_t kMostVertices = 0xffffffff - 3 * kMostSubdivided;  // each triangle adds three at most

/// The new vertices on the edges of the selected triangles. They are numbered by their edges' lower vertex,
/// then the higher one, so that the numbers do not depend on the order of the triangles.
class EdgeMiddles {
 public:
  explicit EdgeMiddles(const TriangleSubdivision& now)
      : first_new_(static_cast<std::uint32_t>(now.mesh.positions.size())),
        first_(now.mesh.positions.size() + 1, 0) {
    for_each_selected_side(now, [&](std::uint32_t low, std::uint32_t) { ++first_[low + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    highs_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for_each_selected_side(now, [&](std::uint32_t low, std::uint32_t high) { highs_[next[low]++] = high; });
    drop_repeats();
  }

  /// The vertex in the middle of the edge; kUncut where the edge is not cut.
  std::uint32_t of(std::uint32_t a, std::uint32_t b) const {
    const auto begin = highs_.begin() + first_[std::min(a, b)];
    const auto end = highs_.begin() + first_[std::min(a, b) + 1];
    const auto found = std::lower_bound(begin, end, std::max(a, b));
    if (found == end || *found != std::max(a, b)) return kUncut;
    return first_new_ + static_cast<std::uint32_t>(found - highs_.begin());
  }

  std::size_t count() const { return highs_.size(); }

  void append_to(std::vector<Vector3>& positions) const {
    for (std::uint32_t low = 0; low < first_new_; ++low) {
      for (std::uint32_t i = first_[low]; i < first_[low + 1]; ++i) {
        // Halved before they are added: the sum of enormous coordinates would overflow.
        const Vector3 middle = 0.5 * positions[low] + 0.5 * positions[highs_[i]];
        positions.push_back(middle);
      }
    }
  }

 private:
  /// A side from a vertex to itself has no middle but that vertex.
  template <typename Visit>
  static void for_each_selected_side(const TriangleSubdivision& now, Visit visit) {
    for (std::size_t t = 0; t < now.pieces.size(); ++t) {
      if (!now.pieces[t].selected) continue;
      const TriangleMesh::Triangle& triangle = now.mesh.triangles[t];
      for (int side = 0; side < 3; ++side) {
        const std::uint32_t a = triangle[side], b = triangle[(side + 1) % 3];
        if (a != b) visit(std::min(a, b), std::max(a, b));
      }
    }
  }

  void drop_repeats() {
    auto kept = highs_.begin();
    std::uint32_t begin = 0;
    for (std::size_t low = 0; low + 1 < first_.size(); ++low) {
      const std::uint32_t end = first_[low + 1];
      std::sort(highs_.begin() + begin, highs_.begin() + end);
      first_[low] = static_cast<std::uint32_t>(kept - highs_.begin());
      kept = std::unique_copy(highs_.begin() + begin, highs_.begin() + end, kept);
      begin = end;
    }
    first_.back() = static_cast<std::uint32_t>(kept - highs_.begin());
    highs_.erase(kept, highs_.end());
  }

  std::uint32_t first_new_;
  std::vector<std::uint32_t> first_;  // by lower vertex: the first of its edges in highs_
  std::vector<std::uint32_t> highs_;  // the cut edges' higher vertices
};

/// Bit i: side i, from corner i to i + 1, is cut.
unsigned cut_sides(const TriangleSubdivision& now, const EdgeMiddles& middles, std::size_t triangle) {
  if (now.pieces[triangle].selected) return 7;
  const TriangleMesh::Triangle& t = now.mesh.triangles[triangle];
  unsigned sides = 0;
  for (unsigned side = 0; side < 3; ++side) {
    if (middles.of(t[side], t[(side + 1) % 3]) != kUncut) sides |= 1U << side;
  }
  return sides;
}

/// The pieces of a cut triangle: 0, 1, 2 are its corners, 3 + i is the middle of side i.
struct CutPattern {
  std::size_t count;
  std::array<std::array<unsigned, 3>, 4> pieces;
};

/// With two sides cut a corner comes off; `from_end` selects the diagonal that cuts the remaining quad: from
/// the end of the whole side to the middle that is not beside it, or else from its beginning.
CutPattern cut_pattern(unsigned sides, bool from_end) {
  switch (std::popcount(sides)) {
    case 0:
      return {1, {{{0, 1, 2}}}};
    case 1: {
      const unsigned a = unsigned(std::countr_zero(sides)), b = (a + 1) % 3, c = (a + 2) % 3;
      return {2, {{{a, 3 + a, c}, {3 + a, b, c}}}};
    }
    case 2: {
      const unsigned a = unsigned(std::countr_zero(~sides)), b = (a + 1) % 3, c = (a + 2) % 3;
      const unsigned bc = 3 + b, ca = 3 + c;
      if (from_end) return {3, {{{a, b, ca}, {b, bc, ca}, {ca, bc, c}}}};
      return {3, {{{a, b, bc}, {a, bc, ca}, {ca, bc, c}}}};
    }
    default:
      return {4, {{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}}};
  }
}

/// One triangle with the middles of its cut sides, as it is taken apart.
struct CutTriangle {
  unsigned sides;
  std::array<std::uint32_t, 6> vertices;  // corners, then middles
  std::array<Eigen::Vector2f, 6> places;  // of these on the parent
};

CutTriangle cut_triangle(const TriangleSubdivision& now, const EdgeMiddles& middles, std::size_t triangle,
                         unsigned sides) {
  const TriangleMesh::Triangle& t = now.mesh.triangles[triangle];
  const Piece& piece = now.pieces[triangle];
  CutTriangle cut{sides, {}, {}};
  for (unsigned i = 0; i < 3; ++i) {
    const unsigned next = (i + 1) % 3;
    cut.vertices[i] = t[i];
    cut.places[i] = piece.corners[i];
    if ((sides >> i & 1U) == 0) continue;
    cut.vertices[3 + i] = t[i] == t[next] ? t[i] : middles.of(t[i], t[next]);
    cut.places[3 + i] = 0.5F * (piece.corners[i] + piece.corners[next]);
  }
  return cut;
}

/// Is the diagonal from the end of the whole side the shorter one? Only asked with two sides cut.
bool shorter_from_end(const CutTriangle& cut, const std::vector<Vector3>& positions) {
  const unsigned a = unsigned(std::countr_zero(~cut.sides)), b = (a + 1) % 3, c = (a + 2) % 3;
  const auto length = [&](unsigned i, unsigned j) {
    return (positions[cut.vertices[i]] - positions[cut.vertices[j]]).stableNorm();
  };
  return length(b, 3 + c) < length(a, 3 + b);
}

void add_pieces(const CutTriangle& cut, const Piece& of, TriangleSubdivision& next) {
  const bool from_end = std::popcount(cut.sides) == 2 && shorter_from_end(cut, next.mesh.positions);
  const CutPattern pattern = cut_pattern(cut.sides, from_end);
  for (std::size_t i = 0; i < pattern.count; ++i) {
    const auto& [a, b, c] = pattern.pieces[i];
    next.mesh.triangles.push_back({cut.vertices[a], cut.vertices[b], cut.vertices[c]});
    next.pieces.push_back({of.parent, of.selected, {cut.places[a], cut.places[b], cut.places[c]}});
  }
}

tl::unexpected<base::Error> too_many_pieces() {
  return base::fail(
      fmt::format("the subdivision would make more than {} million triangles: select fewer of "
                  "them or ask for fewer levels",
                  kMostSubdivided / 1'000'000));
}

/// The least number of triangles after the levels that are left. Each cut of a side adds a triangle to those
/// that are not selected, and a cut side has twice as many to cut at the next level.
std::size_t triangles_to_come(const TriangleSubdivision& now, const std::vector<std::uint8_t>& sides,
                              int levels_left) {
  const std::size_t fourfold = std::size_t(1) << (2 * levels_left);
  const std::size_t cuts = (std::size_t(1) << levels_left) - 1;
  std::size_t total = 0;
  for (std::size_t t = 0; t < sides.size(); ++t) {
    total += now.pieces[t].selected ? fourfold : 1 + std::size_t(std::popcount(sides[t])) * cuts;
  }
  return total;
}

/// One level of `levels_left`, when all of them stay within the limit.
base::Result<TriangleSubdivision> cut_once(TriangleSubdivision now, int levels_left) {
  const EdgeMiddles middles(now);
  std::vector<std::uint8_t> sides(now.pieces.size());
  for (std::size_t t = 0; t < sides.size(); ++t) {
    sides[t] = static_cast<std::uint8_t>(cut_sides(now, middles, t));
  }
  if (triangles_to_come(now, sides, levels_left) > kMostSubdivided) return too_many_pieces();
  const std::size_t count = triangles_to_come(now, sides, 1);
  TriangleSubdivision next;
  next.mesh.positions = std::move(now.mesh.positions);
  next.mesh.positions.reserve(next.mesh.positions.size() + middles.count());
  middles.append_to(next.mesh.positions);
  next.mesh.triangles.reserve(count);
  next.pieces.reserve(count);
  for (std::size_t t = 0; t < sides.size(); ++t) {
    add_pieces(cut_triangle(now, middles, t, sides[t]), now.pieces[t], next);
  }
  return next;
}

/// Does the selection alone become too many triangles? Asked first: then the levels are few enough to count.
bool outgrows(std::size_t selected, int levels) {
  for (int level = 0; level < levels && selected > 0; ++level) {
    selected *= 4;
    if (selected > kMostSubdivided) return true;
  }
  return false;
}

}  // namespace

base::Result<TriangleSubdivision> subdivide_triangles(const TriangleMesh& mesh,
                                                      std::span<const std::uint32_t> selection, int levels) {
  if (levels < 0) {
    return base::fail(fmt::format("cannot subdivide {} times: the levels must be 0 or more", levels));
  }
  if (mesh.triangles.size() > kMostSubdivided) return too_many_pieces();
  if (mesh.positions.size() > kMostVertices) {
    return base::fail("the mesh has too many vertices to subdivide: remove those that no triangle uses");
  }
  if (const auto fine = check_mesh(mesh); !fine) return tl::unexpected(fine.error());
  const auto there = check_chosen(selection, mesh.triangles.size(), "triangle");
  if (!there) return tl::unexpected(there.error());

  TriangleSubdivision result{mesh, std::vector<Piece>(mesh.triangles.size())};
  for (std::uint32_t t = 0; t < result.pieces.size(); ++t) {
    result.pieces[t] = {t, false, {Eigen::Vector2f(0, 0), Eigen::Vector2f(1, 0), Eigen::Vector2f(0, 1)}};
  }
  std::size_t selected = 0;
  for (const std::uint32_t t : selection) {
    selected += result.pieces[t].selected ? 0 : 1;
    result.pieces[t].selected = true;
  }
  if (selected == 0) return result;
  if (outgrows(selected, levels)) return too_many_pieces();
  for (int level = 0; level < levels; ++level) {
    auto next = cut_once(std::move(result), levels - level);
    if (!next) return next;
    result = std::move(*next);
  }
  return result;
}

}  // namespace icome::geometry
