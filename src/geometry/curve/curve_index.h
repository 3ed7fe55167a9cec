#pragma once
#include <span>
#include <vector>

#include "geometry/curve/nearest_on_curve.h"
#include "geometry/tree/box_tree.h"

namespace icome::geometry {

/// Finds the nearest of many curves: a tree over the boxes of short parts of them. Owns copies of the curves.
/// Queries neither allocate nor change anything, so several threads may ask.
class CurveIndex {
 public:
  CurveIndex() = default;
  explicit CurveIndex(std::span<const CubicBezier> curves);

  struct Nearest {
    std::size_t curve = 0;  ///< its place among those given
    NearestOnCurve on_curve;
  };

  /// The nearest place of all curves, if one is less than `within` (m) away; else false. Real-time safe.
  bool nearest(const Vector2& point, double within, Nearest& found) const;
  std::size_t size() const { return curves_.size(); }

 private:
  struct Part {
    std::uint32_t curve;
    float from;
    float to;
  };

  std::vector<CubicBezier> curves_;
  std::vector<Part> parts_;  // in the order of the tree's leaves
  BoxTree tree_;
};

}  // namespace icome::geometry
