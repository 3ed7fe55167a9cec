#pragma once
#include <span>
#include <vector>

#include "cutout/tracker/edges/oriented_lines.h"
#include "cutout/tracker/pose/triangle_shape.h"

namespace icome::cutout {

/// A pose that a triangle may have, by two pieces of its edges.
struct PoseHypothesis {
  std::size_t triangle;
  Placed placed;
  double length;  ///< mm of edge that speaks for it
};

/// Poses from pairs of pieces of edges that enclose the angle of a known corner. The corner itself and any
/// part of both edges may be hidden.
class PoseHypotheses {
 public:
  static constexpr std::size_t kMost = 10'000;        ///< those of the pieces with most points are kept
  static constexpr std::size_t kMostTries = 300'000;  ///< pairs with a corner that are looked at

  explicit PoseHypotheses(std::span<const TriangleShape> shapes);

  /// Hypotheses for the triangles that are `wanted` (as many as there are shapes); overwrites `found`.
  /// `pixel` is the size of a pixel on the table, mm.
  void find(std::span<const EdgeSegment> segments, double pixel, const std::vector<bool>& wanted,
            std::vector<PoseHypothesis>& found) const;

 private:
  struct Corner {
    double angle;
    std::uint32_t triangle, corner;
  };
  bool place(const Corner& corner, const EdgeSegment& before, const EdgeSegment& after, double pixel,
             PoseHypothesis& found) const;

  std::vector<TriangleShape> shapes_;
  std::vector<Corner> corners_;  // by angle
  double largest_reach_ = 0;     // mm
};

}  // namespace icome::cutout
