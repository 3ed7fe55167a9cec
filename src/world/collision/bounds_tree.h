#pragma once
#include <cstdint>
#include <vector>

#include "base/vector.h"

namespace icome::world {

/// Boxes that come, go and move, found by place: a balanced tree of boxes around boxes. Each box has a number
/// of the caller's. Changing one of n takes O(log n).
class BoundsTree {
 public:
  using Leaf = std::uint32_t;
  static constexpr Leaf kNone = 0xffffffff;

  /// The box is not empty.
  Leaf insert(std::uint32_t number, const base::Bounds& box);
  void remove(Leaf leaf);

  /// Calls `visit(number)` for every box that meets `box`, and the leaf itself once if it does.
  template <typename Visit>
  void meeting(const base::Bounds& box, Visit&& visit) const {
    if (root_ == kNone) return;
    std::vector<std::uint32_t> stack{root_};
    while (!stack.empty()) {
      const Node& node = nodes_[stack.back()];
      stack.pop_back();
      if (!node.box.intersects(box)) continue;
      if (node.children[0] == kNone) {
        visit(node.number);
      } else {
        stack.push_back(node.children[0]);
        stack.push_back(node.children[1]);
      }
    }
  }

  /// Bounds of all boxes; empty when there are none.
  base::Bounds bounds() const { return root_ == kNone ? base::Bounds() : nodes_[root_].box; }
  std::size_t bytes() const { return nodes_.capacity() * sizeof(Node) + free_.capacity() * sizeof(Leaf); }

 private:
  struct Node {
    base::Bounds box;
    std::uint32_t parent = kNone;
    std::uint32_t children[2] = {kNone, kNone};  // kNone in a leaf
    std::uint32_t number = 0;                    // of a leaf
    int height = 0;                              // 0 in a leaf
  };

  std::uint32_t take_node();
  std::uint32_t sibling_for(const base::Bounds& box) const;
  void replace(std::uint32_t parent, std::uint32_t child, std::uint32_t by);
  void mend_upwards(std::uint32_t from);
  void mend(std::uint32_t node);
  std::uint32_t balance(std::uint32_t node);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> free_;
  std::uint32_t root_ = kNone;
};

}  // namespace icome::world
