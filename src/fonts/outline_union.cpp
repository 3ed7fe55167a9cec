#include "fonts/outline_union.h"

#include <algorithm>
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

}  // namespace

std::vector<geometry::Outline> united(const Rings& rings) {
  return covered_by(rings, ClipperLib::pftNonZero);
}

std::vector<geometry::Outline> covered_oddly(const Rings& rings) {
  return covered_by(rings, ClipperLib::pftEvenOdd);
}

}  // namespace icome::fonts
