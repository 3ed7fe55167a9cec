#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/csg/csg_leaf.h"
#include "geometry/csg/csg_tree.h"
#include "geometry/tree/box_tree.h"

namespace icome::geometry {

/// Finds the leaves of a tree whose surfaces are near a place, and with them all of the solid's surface. Owns
/// copies. Lengths m, tree's frame.
class CsgLeafSurfaces {
 public:
  struct Leaf {
    CsgLeaf leaf;
    CsgTree::Index node;
    std::size_t rank;  // from left to right
    bool even;         // distances from it are exact
  };

  /// Takes the leaves below the root that reach into `box`. Precondition: the tree is not empty.
  CsgLeafSurfaces(const CsgTree& tree, const Bounds& box);

  const std::vector<Leaf>& leaves() const { return leaves_; }

  /// Calls `visit(leaf)` for those that may come within `radius` of a place in the box, until it answers
  /// false.
  template <typename Visit>
  void near(const Vector3& place, double radius, const Visit& visit) const {
    boxes_.near(SegmentQuery(place, place, radius), [&](std::uint32_t i) { return visit(leaves_[i]); });
  }

 private:
  std::vector<Leaf> leaves_;  // sorted so that neighbours in space are near in memory
  BoxTree boxes_;
};

/// The distance of the place from the surface of the leaf; exact only for evenly stretched leaves.
double distance_to_surface(const CsgLeaf& leaf, const Vector3& place);

}  // namespace icome::geometry
