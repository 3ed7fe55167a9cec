#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/function_ref.h"
#include "geometry/implicit/formula.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// The parts of a box in which something may be found: an octree.
class ImplicitCells {
 public:
  /// `may_hold(part)` says whether it may be in a part; asking takes some `work` steps of a formula.
  ImplicitCells(const base::Bounds& box, std::size_t work,
                base::FunctionRef<bool(const base::Bounds& part)> may_hold);

  /// Around all parts; empty if it is surely nowhere in the box.
  const base::Bounds& bounds() const { return bounds_; }
  /// Calls `visit(part)` for every part within `reach` of the segment, until it returns false; then the
  /// answer is false. Real-time safe.
  bool near(const base::Vector3& a, const base::Vector3& b, double reach,
            base::FunctionRef<bool(const base::Bounds&)> visit) const;
  std::size_t bytes() const { return nodes_.capacity() * sizeof(Node); }

 private:
  /// Its eighths that count are `first`, `first` + 1, ... in the order of the bits in `eighths`; none: a
  /// leaf.
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

/// Does f surely keep away from zero in the box, at all times? Then its sign there, else 0.
int sign_in_box(const Formula& formula, const base::Bounds& box);

}  // namespace icome::geometry
