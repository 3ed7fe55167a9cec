#include "geometry/tree/box_tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace icome::geometry {

using detail::kRounding;
using detail::kTiny;

namespace {

FourFloats magnitude(FourFloats v) { return v < 0.0f ? -v : v; }

FourFloats positive(FourFloats v) { return v > 0.0f ? v : FourFloats{}; }

FourFloats square_root(FourFloats v) {
  for (unsigned i = 0; i < FourBoxes::kCount; ++i) v[i] = std::sqrt(v[i]);
  return v;
}

}  // namespace

FloatBox FloatBox::empty() {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  return {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
}

void FloatBox::extend(const FloatBox& other) {
  for (int axis = 0; axis < 3; ++axis) {
    lo[axis] = std::min(lo[axis], other.lo[axis]);
    hi[axis] = std::max(hi[axis], other.hi[axis]);
  }
}

FourBoxes::FourBoxes() {
  for (unsigned which = 0; which < kCount; ++which) set(which, FloatBox::empty());
}

FloatBox FourBoxes::get(unsigned which) const {
  return {{lo[0][which], lo[1][which], lo[2][which]}, {hi[0][which], hi[1][which], hi[2][which]}};
}

FloatBox FourBoxes::enclosing() const {
  FloatBox box = get(0);
  for (unsigned which = 1; which < kCount; ++which) box.extend(get(which));
  return box;
}

SegmentQuery::SegmentQuery(const Vector3& a, const Vector3& b, double radius_in, bool round_in)
    : round(round_in) {
  const Vector3 reach = Vector3::Constant(radius_in);
  const Vector3 low = a.cwiseMin(b) - reach;
  const Vector3 high = a.cwiseMax(b) + reach;
  box = float_box(Bounds(low, high));
  // An infinite box would meet the empty ones, too, which nodes with fewer than four children have.
  constexpr float kMost = std::numeric_limits<float>::max();
  for (float& it : box.lo) it = std::max(it, -kMost);
  for (float& it : box.hi) it = std::min(it, kMost);
  const double magnitude = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  rounding = float(16.0 * double(kRounding) * magnitude);
  radius = float(radius_in) + rounding;
  for (int axis = 0; axis < 3; ++axis) {
    centre[axis] = float(0.5 * (a[axis] + b[axis]));
    half[axis] = float(0.5 * (b[axis] - a[axis]));
  }
  slanted = (b - a).squaredNorm() > 4.0 * radius_in * radius_in;
}

SegmentQuery& SegmentQuery::only_in(const Bounds& other) {
  const FloatBox limits = float_box(other);
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = std::max(box.lo[axis], limits.lo[axis]);
    box.hi[axis] = std::min(box.hi[axis], limits.hi[axis]);
  }
  return *this;
}

BoxTree::BoxTree(std::span<const FloatBox> leaves) : leaf_count_(leaves.size()) {
  std::size_t total = 0;
  for (std::size_t count = leaves.size(); count > 0 && (levels_ == 0 || count > 1);) {
    assert(levels_ < kMaxLevels);
    count = (count + kWidth - 1) / kWidth;
    start_[levels_++] = std::uint32_t(total);
    total += count;
  }
  nodes_.assign(total, Node());
  refit(leaves);
}

void BoxTree::refit(std::span<const FloatBox> leaves) {
  assert(leaves.size() == leaf_count_);
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) set_child(0, leaf, leaves[leaf]);
  for (unsigned level = 1; level < levels_; ++level) {
    const std::size_t count = start_[level] - start_[level - 1];
    for (std::size_t child = 0; child < count; ++child) {
      set_child(level, child, nodes_[start_[level - 1] + child].enclosing());
    }
  }
}

void BoxTree::set_child(std::size_t level, std::size_t child, const FloatBox& box) {
  nodes_[start_[level] + child / kWidth].set(unsigned(child % kWidth), box);
}

// Separating axes between a box grown by the radius and a segment: the three cross products of the
// segment with the box axes (Ericson, Real-Time Collision Detection, 5.3.3); overlap_mask has tested
// the box axes themselves.
unsigned FourBoxes::beside_mask(const SegmentQuery& query) const {
  std::array<FourFloats, 3> middle{};
  std::array<FourFloats, 3> extent{};
  for (int axis = 0; axis < 3; ++axis) {
    middle[axis] = 0.5f * lo[axis] + 0.5f * hi[axis] - query.centre[axis];
    extent[axis] = 0.5f * hi[axis] - 0.5f * lo[axis] + query.radius;
    // The box may be much larger than the way: then its middle is rounded by more than the way is long.
    extent[axis] += 8.0f * kRounding * (magnitude(lo[axis]) + magnitude(hi[axis]));
  }
  detail::FourTruths apart{};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const FourFloats distance = magnitude(middle[u] * query.half[v] - middle[v] * query.half[u]);
    apart |= distance > extent[u] * std::abs(query.half[v]) + extent[v] * std::abs(query.half[u]);
  }
  return detail::mask_of(~apart);
}

// Tests the plane through the place of the box nearest to the middle of the segment, at right angles to the
// way there: the box lies behind it, and no point of the segment is nearer to the plane than its ends are.
unsigned FourBoxes::within_mask(const SegmentQuery& query) const {
  FourFloats squared{};
  FourFloats along{};
  float slack = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const float p = query.centre[axis];
    const FourFloats off = positive(lo[axis] - p) - positive(p - hi[axis]);
    squared += off * off;
    along += off * query.half[axis];
    slack += std::abs(query.half[axis]);
  }
  const FourFloats distance = square_root(squared);
  return detail::mask_of(distance * (distance - query.radius) <= magnitude(along) + query.rounding * slack);
}

BallWay::BallWay(const Vector3& start_in, const Vector3& step_in, double radius_in)
    : length(float(step_in.norm())) {
  for (int axis = 0; axis < 3; ++axis) {
    start[axis] = float(start_in[axis]);
    step[axis] = float(step_in[axis]);
  }
  const double magnitude = start_in.cwiseAbs().maxCoeff() + step_in.cwiseAbs().maxCoeff() + radius_in;
  radius = float(radius_in + 16.0 * double(kRounding) * magnitude);
}

// A box lies behind the plane through its place nearest to the start, at right angles to the way there.
FourFloats FourBoxes::entries(const BallWay& way) const {
  FourFloats squared{};
  FourFloats along{};
  for (int axis = 0; axis < 3; ++axis) {
    const float p = way.start[axis];
    const FourFloats off = positive(lo[axis] - p) - positive(p - hi[axis]);
    squared += off * off;
    along += off * way.step[axis];
  }
  const FourFloats distance = square_root(squared);
  const FourFloats nearer = positive(along) + 8.0f * kRounding * way.length * distance + kTiny;
  return positive(distance - way.radius) * distance / nearer;
}

double BoxTree::distance_squared(const Node& node, unsigned child, const FloatPoint& point) {
  float sum = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const float p = point.position[axis];
    const float outside = std::max(node.lo[axis][child] - p, p - node.hi[axis][child]) - point.rounding;
    sum += outside > 0.0f ? outside * outside : 0.0f;
  }
  return double(sum) * (1.0 - 8.0 * double(kRounding));
}

BoxTree::FloatPoint BoxTree::float_point(const Vector3& point) {
  return {{float(point.x()), float(point.y()), float(point.z())},
          4.0f * kRounding * float(point.cwiseAbs().maxCoeff())};
}

}  // namespace icome::geometry
