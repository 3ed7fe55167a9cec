#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/function_ref.h"
#include "geometry/implicit/formula.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// An octree of the parts of a box that may hold something, such as a piece of a surface.
class ImplicitCells {
 public:
  /// `may_hold(part)` tells whether a part may hold it; each call takes some `work` steps of a formula.
  ImplicitCells(const base::Bounds& box, std::size_t work,
                base::FunctionRef<bool(const base::Bounds& part)> may_hold);

  /// Bounds of all parts; empty if the box surely holds nothing.
  const base::Bounds& bounds() const { return bounds_; }
  /// Calls `visit(part)` for every part within `reach` of the segment, until it returns false; then the
  /// result is false. Real-time safe.
  bool near(const base::Vector3& a, const base::Vector3& b, double reach,
            base::FunctionRef<bool(const base::Bounds&)> visit) const;
  std::size_t bytes() const { return nodes_.capacity() * sizeof(Node); }

 private:
  /// Its eighths that may hold something are `first`, `first` + 1, ... in the order of the bits in
  /// `eighths`; `first` is 0 for a leaf.
  struct Node {
    std::uint32_t first;
    std::uint8_t eighths;
  };
  struct Visit;
  bool near(const Visit& visit, std::uint32_t node, const base::Bounds& box) const;

  base::Bounds box_, bounds_;
  std::vector<Node> nodes_;
};

/// The box at all times that count: up to 1e9 s.
Formula::Box4 always_in(const base::Bounds& box);

/// The sign of f in the box, if f surely keeps away from zero there at all times; else 0. Undefined is 1.
int sign_in_box(const Formula& formula, const base::Bounds& box);

}  // namespace icome::geometry
