#include "geometry/implicit/implicit_cells.h"

#include <algorithm>

namespace icome::geometry {
namespace {

using base::Bounds;
using base::Vector3;

constexpr std::size_t kMostLeaves = 4096;
// Steps of programs spent on the tree: a long formula gets a coarser one, so that all take about a second.
constexpr std::size_t kMostWork = 4'000'000;

Bounds eighth_of(const Bounds& box, unsigned number) {
  const Vector3 middle = box.min() + 0.5 * box.sizes();
  Bounds eighth = box;
  for (int axis = 0; axis < 3; ++axis) {
    ((number >> axis & 1U) != 0 ? eighth.min() : eighth.max())[axis] = middle[axis];
  }
  return eighth;
}

/// A leaf so far.
struct GrowingCell {
  std::uint32_t node;
  Bounds box;
};

/// Does the segment come within `reach` of the box, or nearly? (The box is enlarged by it along each axis.)
bool may_reach(const Vector3& a, const Vector3& step, double reach, const Bounds& box) {
  double first = 0.0, last = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = box.min()[axis] - reach - a[axis], hi = box.max()[axis] + reach - a[axis];
    if (step[axis] == 0.0) {
      if (lo > 0.0 || hi < 0.0) return false;
      continue;
    }
    const double s = lo / step[axis], t = hi / step[axis];
    first = std::max(first, std::min(s, t));
    last = std::min(last, std::max(s, t));
  }
  // Rounded towards yes.
  return first <= last + 1e-12 * (1.0 + last);
}

}  // namespace

Formula::Box4 always_in(const Bounds& box) {
  Formula::Box4 ranges;
  for (int i = 0; i < 3; ++i) ranges[static_cast<std::size_t>(i)] = {box.min()[i], box.max()[i]};
  // Thirty years, not for ever: values that overflow are not sure to be defined.
  ranges[3] = {-1e9, 1e9};
  return ranges;
}

int sign_in_box(const Formula& formula, const Bounds& box) {
  const Formula::Box4 ranges = always_in(box);
  const auto at = formula.slope_range(ranges);
  if (at.range.never || at.range.value.lo > 0.0) return 1;  // undefined counts as outside
  if (!at.range.total) return 0;
  if (at.range.value.hi < 0.0) return -1;
  // The mean value form in x, y and z, for every time.
  Formula::Box4 centre = ranges;
  Interval value{0.0, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const double middle = ranges[i].lo + 0.5 * (ranges[i].hi - ranges[i].lo);
    centre[i] = {middle, middle};
    value = value + at.slope[i] * Interval{ranges[i].lo - middle, ranges[i].hi - middle};
  }
  value = value + formula.range(centre).value;
  if (value.lo > 0.0) return 1;
  return value.hi < 0.0 ? -1 : 0;
}

struct ImplicitCells::Visit {
  const Vector3& a;
  Vector3 step;
  double reach;
  base::FunctionRef<bool(const Bounds&)> call;
};

ImplicitCells::ImplicitCells(const Bounds& box, std::size_t work,
                             base::FunctionRef<bool(const Bounds& part)> may_hold)
    : box_(box) {
  nodes_.push_back({0, 0});
  std::vector<GrowingCell> level;
  if (may_hold(box)) level.push_back({0, box});
  std::size_t worked = 0;
  // Level by level, so that leaves are of one size, until the next level might be too much.
  while (!level.empty() && level.size() * 4 <= kMostLeaves && worked < kMostWork) {
    std::vector<GrowingCell> next;
    for (const GrowingCell& cell : level) {
      nodes_[cell.node].first = static_cast<std::uint32_t>(nodes_.size());
      std::uint8_t eighths = 0;
      for (unsigned i = 0; i < 8; ++i) {
        const Bounds eighth = eighth_of(cell.box, i);
        if (!may_hold(eighth)) continue;
        eighths = static_cast<std::uint8_t>(eighths | 1U << i);
        next.push_back({static_cast<std::uint32_t>(nodes_.size()), eighth});
        nodes_.push_back({0, 0});
      }
      nodes_[cell.node].eighths = eighths;
    }
    worked += level.size() * 8 * work;
    level = std::move(next);
  }
  for (const GrowingCell& cell : level) bounds_.extend(cell.box);
  nodes_.shrink_to_fit();
}

bool ImplicitCells::near(const Vector3& a, const Vector3& b, double reach,
                         base::FunctionRef<bool(const Bounds&)> visit) const {
  if (bounds_.isEmpty()) return true;
  return near(Visit{a, b - a, reach, visit}, 0, box_);
}

bool ImplicitCells::near(const Visit& visit, std::uint32_t index, const Bounds& box) const {
  if (!may_reach(visit.a, visit.step, visit.reach, box)) return true;
  const Node& node = nodes_[index];
  if (node.first == 0) return visit.call(box);
  std::uint32_t child = node.first;
  for (unsigned i = 0; i < 8; ++i) {
    if ((node.eighths >> i & 1U) == 0) continue;
    if (!near(visit, child++, eighth_of(box, i))) return false;
  }
  return true;
}

}  // namespace icome::geometry
