#pragma once
#include <span>
#include <vector>

#include "drawing/drawing.h"
#include "geometry/mesh/triangle_mesh.h"
#include "geometry/sweep/outline.h"

namespace icome::drawing {

/// Brings places on paper onto a grid of whole numbers, on which areas are united without rounding, and areas
/// back into the frame of designs: the middle of the paper is the origin, y is up.
class PaperGrid {
 public:
  /// The finest grid that holds the paper and all of the box (m).
  PaperGrid(const Vector2& paper, const Bounds2& box);

  Vector2 on_grid(const Vector2& place) const;
  /// In the frame of designs, m.
  Vector2 to_design(const Vector2& on_grid) const { return step_ * on_grid; }
  /// A mesh from z = -1/2 to 1/2 over the grid, as a solid from z = 0 to 1.
  void to_design(geometry::TriangleMesh& mesh) const;

  /// A line of straight pieces on the grid along a chain of cubics, off by `tolerance` (m) at most; without
  /// its last point where it is closed.
  std::vector<Vector2> line_along(std::span<const CubicBezier> chain, bool closed, double tolerance) const;

 private:
  Vector2 middle_;
  double step_;
};

}  // namespace icome::drawing
