#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "base/vector.h"

namespace icome::geometry {

using base::Bounds;
using base::Vector3;

/// A box in single precision that never loses what it encloses: conversion rounds outwards.
struct FloatBox {
  std::array<float, 3> lo;
  std::array<float, 3> hi;

  static FloatBox empty();
  void extend(const FloatBox& other);
};
inline FloatBox float_box(const Bounds& bounds);

struct SegmentQuery;
struct BallWay;

/// Four numbers that one instruction works on.
using FourFloats [[gnu::vector_size(16)]] = float;

/// Four boxes, transposed so that one instruction looks at all of them. Empty when default-constructed.
struct FourBoxes {
  static constexpr unsigned kCount = 4;

  FourBoxes();
  void set(unsigned which, const FloatBox& box);
  FloatBox get(unsigned which) const;
  FloatBox enclosing() const;
  /// Bit i is set when box i meets `box`. Real-time safe.
  unsigned overlap_mask(const FloatBox& box) const;
  /// Bit i is set when box i comes near the query's segment. Real-time safe.
  unsigned near_mask(const SegmentQuery& query) const;
  /// For each box a share of the way before which the ball does not meet it. Real-time safe.
  FourFloats entries(const BallWay& way) const;

  FourFloats lo[3];
  FourFloats hi[3];

 private:
  unsigned beside_mask(const SegmentQuery& query) const;
  unsigned within_mask(const SegmentQuery& query) const;
};

/// "Which boxes come within `radius` of the segment from `a` to `b`?" A ball where a equals b.
struct SegmentQuery {
  /// `round`: the radius is large against the boxes and the way, as that of a sphere tip is, so that
  /// distances are worth measuring: a ball fills half of the box around it.
  SegmentQuery(const Vector3& a, const Vector3& b, double radius, bool round = false);
  /// Leaves out boxes that do not meet this one either.
  SegmentQuery& only_in(const Bounds& other);

  FloatBox box;                 // around the capsule
  std::array<float, 3> centre;  // of the segment
  std::array<float, 3> half;    // half the segment, signed
  float rounding;               // m, the possible error of single precision
  float radius;                 // with room for that
  bool slanted;                 // worth more than the test against `box`
  bool round;                   // worth a distance
};

/// The straight way of a ball of `radius` (m) from `start` by `step`, to be swept.
struct BallWay {
  BallWay(const Vector3& start, const Vector3& step, double radius);

  std::array<float, 3> start;
  std::array<float, 3> step;
  float length;
  float radius;  // m, with room for rounding
};

/// A tree over boxes that are already in spatial order (see hilbert_order): four children a node,
/// no pointers, children found by counting (a packed Hilbert R-tree). Costs 32 bytes a leaf box.
/// Owns its nodes. Queries never allocate and may run in several threads.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::span<const FloatBox> leaves);

  /// New boxes for the same leaves, in the same order: O(leaves), takes no memory.
  void refit(std::span<const FloatBox> leaves);

  /// Calls `visit(leaf)` for every leaf box that comes within the query's radius of its segment, and
  /// for some that only nearly do, until it returns false. Real-time safe when `visit` is.
  template <typename Visit>
  void near(const SegmentQuery& query, Visit&& visit) const;

  /// Calls `visit(leaf)` on leaf boxes nearer to `point` than the square root of `limit` (m^2),
  /// nearer subtrees first; `visit` returns the new limit. Real-time safe when `visit` is.
  template <typename Visit>
  void nearest(const Vector3& point, double limit, Visit&& visit) const;

  /// Calls `visit(leaf)` for the leaf boxes that a ball of `radius` (m) can meet on its way from `start` by
  /// `step`, roughly in the order of its way; `visit` returns the share of the way that still counts, which
  /// never grows. `announce(leaf)` is called some time before, to fetch what a visit needs. Real-time safe
  /// when both are.
  template <typename Announce, typename Visit>
  void sweep(const Vector3& start, const Vector3& step, double radius, Announce&& announce,
             Visit&& visit) const;

  std::size_t leaf_count() const { return leaf_count_; }
  /// The box of one leaf. Real-time safe.
  FloatBox leaf_box(std::size_t leaf) const { return nodes_[leaf / kWidth].get(unsigned(leaf % kWidth)); }
  std::size_t bytes() const { return nodes_.capacity() * sizeof(Node); }

 private:
  static constexpr unsigned kWidth = FourBoxes::kCount;
  static constexpr unsigned kMaxLevels = 16;  // 4^16 leaves

  using Node = FourBoxes;
  struct Place {
    std::uint32_t level, index;
  };
  struct FloatPoint {
    std::array<float, 3> position;
    float rounding;  // m, the possible error of the position
  };

  void set_child(std::size_t level, std::size_t child, const FloatBox& box);
  /// A lower bound, so that rounding never prunes the nearest.
  static double distance_squared(const Node& node, unsigned child, const FloatPoint& point);
  static FloatPoint float_point(const Vector3& point);

  std::vector<Node> nodes_;                        // level 0 (above the leaves) first, the root last
  std::array<std::uint32_t, kMaxLevels> start_{};  // of each level in nodes_
  unsigned levels_ = 0;
  std::size_t leaf_count_ = 0;
};

namespace detail {

// One rounding from double is half of this; the rest covers the arithmetic of the tests.
constexpr float kRounding = 1.2e-7f;
constexpr float kTiny = 1e-37f;

inline float below(double value) {
  const auto rounded = float(value);
  return rounded - (std::abs(rounded) * kRounding + kTiny);
}

inline float above(double value) {
  const auto rounded = float(value);
  return rounded + (std::abs(rounded) * kRounding + kTiny);
}

/// The result of comparing FourFloats: all bits of a number are set where the comparison holds.
using FourTruths = decltype(FourFloats() < FourFloats());

/// Bit i is set where number i holds.
inline unsigned mask_of(const FourTruths& truths) {
#if defined(__SSE2__)
  return unsigned(_mm_movemask_ps(_mm_castsi128_ps(__m128i(truths))));
#else
  unsigned mask = 0;
  for (unsigned i = 0; i < FourBoxes::kCount; ++i) mask |= unsigned(truths[i] != 0) << i;
  return mask;
#endif
}

}  // namespace detail

inline FloatBox float_box(const Bounds& bounds) {
  const Vector3& min = bounds.min();
  const Vector3& max = bounds.max();
  return {{detail::below(min.x()), detail::below(min.y()), detail::below(min.z())},
          {detail::above(max.x()), detail::above(max.y()), detail::above(max.z())}};
}

inline void FourBoxes::set(unsigned which, const FloatBox& box) {
  for (int axis = 0; axis < 3; ++axis) {
    lo[axis][which] = box.lo[axis];
    hi[axis][which] = box.hi[axis];
  }
}

inline unsigned FourBoxes::overlap_mask(const FloatBox& box) const {
  auto in = (lo[0] <= box.hi[0]) & (hi[0] >= box.lo[0]);
  for (int axis = 1; axis < 3; ++axis) in &= (lo[axis] <= box.hi[axis]) & (hi[axis] >= box.lo[axis]);
  return detail::mask_of(in);
}

inline unsigned FourBoxes::near_mask(const SegmentQuery& query) const {
  unsigned mask = overlap_mask(query.box);
  if (mask != 0 && query.slanted) mask &= beside_mask(query);
  if (mask != 0 && query.round) mask &= within_mask(query);
  return mask;
}

template <typename Visit>
void BoxTree::near(const SegmentQuery& query, Visit&& visit) const {
  if (levels_ == 0) return;
  std::array<Place, kMaxLevels*(kWidth - 1) + 1> stack;
  unsigned depth = 0;
  stack[depth++] = {levels_ - 1, 0};
  while (depth > 0) {
    const Place place = stack[--depth];
    const Node& node = nodes_[start_[place.level] + place.index];
    for (unsigned mask = node.near_mask(query); mask != 0; mask &= mask - 1) {
      const auto child = unsigned(__builtin_ctz(mask));
      const std::uint32_t index = place.index * kWidth + child;
      if (place.level == 0) {
        if (!visit(index)) return;
      } else {
        stack[depth++] = {place.level - 1, index};
        __builtin_prefetch(&nodes_[start_[place.level - 1] + index]);
      }
    }
  }
}

template <typename Announce, typename Visit>
void BoxTree::sweep(const Vector3& start, const Vector3& step, double radius, Announce&& announce,
                    Visit&& visit) const {
  struct Candidate {
    Place place;
    float entry;
  };
  if (levels_ == 0) return;
  const BallWay way(start, step, radius);
  SegmentQuery query(start, start + step, radius);
  float share = 1.0f;
  // Leaves come on top of nodes, so that a way that is stopped soon looks at few nodes.
  std::array<Candidate, kMaxLevels * kWidth + 1> stack;
  unsigned depth = 0;
  stack[depth++] = {{levels_, 0}, 0.0f};
  while (depth > 0) {
    const Candidate top = stack[--depth];
    if (top.entry > share) continue;
    if (top.place.level == 0) {
      const double now = visit(top.place.index);
      if (now >= double(share)) continue;
      share = std::nextafter(float(now), 2.0f);
      query = SegmentQuery(start, start + now * step, radius);
      continue;
    }
    const Node& node = nodes_[start_[top.place.level - 1] + top.place.index];
    const FourFloats entries = node.entries(way);
    const unsigned first = depth;
    for (unsigned mask = node.near_mask(query); mask != 0; mask &= mask - 1) {
      const auto child = unsigned(__builtin_ctz(mask));
      const float entry = entries[child];
      if (entry > share) continue;
      const Place place{top.place.level - 1, top.place.index * kWidth + child};
      if (place.level == 0) {
        announce(place.index);
      } else {
        __builtin_prefetch(&nodes_[start_[place.level - 1] + place.index]);
      }
      unsigned slot = depth++;  // insertion keeps the one that is met first on top
      for (; slot > first && stack[slot - 1].entry < entry; --slot) stack[slot] = stack[slot - 1];
      stack[slot] = {place, entry};
    }
  }
}

template <typename Visit>
void BoxTree::nearest(const Vector3& point, double limit, Visit&& visit) const {
  struct Candidate {
    Place place;
    double distance;
  };
  if (levels_ == 0) return;
  const FloatPoint p = float_point(point);
  std::array<Candidate, kMaxLevels * kWidth + 1> stack;
  unsigned depth = 0;
  stack[depth++] = {{levels_ - 1, 0}, 0.0};
  while (depth > 0) {
    const Candidate top = stack[--depth];
    if (top.distance >= limit) continue;
    const Node& node = nodes_[start_[top.place.level] + top.place.index];
    const unsigned first = depth;
    for (unsigned child = 0; child < kWidth; ++child) {
      const double distance = distance_squared(node, child, p);
      if (!(distance < limit)) continue;
      const std::uint32_t index = top.place.index * kWidth + child;
      if (top.place.level == 0) {
        limit = visit(index);
        continue;
      }
      unsigned slot = depth++;  // insertion keeps the nearest on top
      for (; slot > first && stack[slot - 1].distance < distance; --slot) stack[slot] = stack[slot - 1];
      stack[slot] = {{top.place.level - 1, index}, distance};
    }
  }
}

}  // namespace icome::geometry
