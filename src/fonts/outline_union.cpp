#include "fonts/outline_union.h"

#include <algorithm>
#include <array>
#include <clipper.hpp>

namespace icome::fonts {
namespace {

std::vector<Vector2> ring_of(const ClipperLib::Path& path, bool counter_clockwise) {
  std::vector<Vector2> ring;
  ring.reserve(path.size());
  for (const auto& point : path) ring.emplace_back(double(point.X), double(point.Y));
  if (ClipperLib::Orientation(path) != counter_clockwise) std::reverse(ring.begin(), ring.end());
  return ring;
}

std::vector<geometry::Outline> covered_by(const Rings& rings, ClipperLib::PolyFillType rule) {
  ClipperLib::Clipper clipper;
  clipper.StrictlySimple(true);
  for (const std::vector<Vector2>& ring : rings) {
    ClipperLib::Path path;
    path.reserve(ring.size());
    for (const Vector2& at : ring) path.emplace_back(ClipperLib::cInt(at.x()), ClipperLib::cInt(at.y()));
    clipper.AddPath(path, ClipperLib::ptSubject, true);
  }
  ClipperLib::PolyTree tree;
  clipper.Execute(ClipperLib::ctUnion, tree, rule, rule);
  std::vector<geometry::Outline> pieces;
  for (const ClipperLib::PolyNode* node = tree.GetFirst(); node; node = node->GetNext()) {
    if (node->IsHole()) continue;
    geometry::Outline piece{ring_of(node->Contour, true)};
    for (const ClipperLib::PolyNode* hole : node->Childs)
      piece.holes.push_back(ring_of(hole->Contour, false));
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

using RingEdge = std::array<Vector2, 2>;  // from left to right

/// The edges from left to right by their left ends.
std::vector<RingEdge> edges_of(const Rings& rings) {
  std::vector<RingEdge> edges;
  for (const std::vector<Vector2>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      edges.push_back(a.x() <= b.x() ? RingEdge{a, b} : RingEdge{b, a});
    }
  std::ranges::sort(edges, {}, [](const RingEdge& edge) { return edge[0].x(); });
  return edges;
}

double side(const RingEdge& edge, const Vector2& at) {
  const Vector2 way = edge[1] - edge[0], to = at - edge[0];
  return way.x() * to.y() - way.y() * to.x();
}

bool cross(const RingEdge& one, const RingEdge& other) {
  return side(one, other[0]) * side(one, other[1]) < 0.0 && side(other, one[0]) * side(other, one[1]) < 0.0;
}

}  // namespace

bool cross_often(const Rings& rings, std::size_t most) {
  constexpr std::size_t kMostLooks = 100'000'000;
  const std::vector<RingEdge> edges = edges_of(rings);
  std::size_t looks = 0, crossings = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t k = i + 1; k < edges.size() && edges[k][0].x() <= edges[i][1].x(); ++k) {
      if (++looks > kMostLooks) return true;
      if (cross(edges[i], edges[k]) && ++crossings > most) return true;
    }
  }
  return false;
}

std::vector<geometry::Outline> united(const Rings& rings) {
  return covered_by(rings, ClipperLib::pftNonZero);
}

std::vector<geometry::Outline> covered_oddly(const Rings& rings) {
  return covered_by(rings, ClipperLib::pftEvenOdd);
}

}  // namespace icome::fonts
