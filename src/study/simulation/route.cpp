#include "study/simulation/route.h"

#include <algorithm>
#include <limits>

namespace icome::study {
namespace {

/// Corners lie a little farther from a box than the way must keep from it.
constexpr double kCornerMargin = 1.3;
constexpr std::size_t kMostBoxes = 24;  // the nearest to the straight way count

base::Bounds grown(const base::Bounds& box, double by) {
  const base::Vector3 margin = base::Vector3::Constant(by);
  return {box.min() - margin, box.max() + margin};
}

/// Does the straight way go through the box? (Slabs, Kay and Kajiya 1986.)
bool crosses(const base::Vector3& from, const base::Vector3& to, const base::Bounds& box) {
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = to[axis] - from[axis];
    if (way == 0.0) {
      if (from[axis] <= box.min()[axis] || from[axis] >= box.max()[axis]) return false;
      continue;
    }
    const double one = (box.min()[axis] - from[axis]) / way;
    const double other = (box.max()[axis] - from[axis]) / way;
    enter = std::max(enter, std::min(one, other));
    leave = std::min(leave, std::max(one, other));
  }
  return enter < leave;
}

/// Places between which the way may go, and a test whether they see each other.
class Map {
 public:
  Map(const base::Vector3& from, const base::Vector3& to, const std::vector<base::Bounds>& boxes,
      double clearance) {
    for (const base::Bounds& box : boxes) {
      const base::Bounds kept = grown(box, clearance);
      if (!kept.contains(from) && !kept.contains(to)) boxes_.push_back(kept);
    }
    std::ranges::sort(boxes_, {}, [&](const base::Bounds& box) {
      return box.exteriorDistance(from) + box.exteriorDistance(to);
    });
    if (boxes_.size() > kMostBoxes) boxes_.resize(kMostBoxes);
    places_ = {from, to};
    for (const base::Bounds& box : boxes_) add_places_round(grown(box, (kCornerMargin - 1.0) * clearance));
  }

  /// The shortest way from the first place to the second, by Dijkstra's algorithm; straight if none is free.
  std::vector<base::Vector3> shortest() const {
    const std::size_t count = places_.size();
    std::vector<double> length(count, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> before(count, 0);
    std::vector<bool> done(count, false);
    length[0] = 0.0;
    for (;;) {
      std::size_t next = count;
      for (std::size_t i = 0; i < count; ++i)
        if (!done[i] && (next == count || length[i] < length[next])) next = i;
      if (next == count || !std::isfinite(length[next])) return {places_[1]};
      if (next == 1) break;
      done[next] = true;
      for (std::size_t i = 0; i < count; ++i) {
        const double through = length[next] + (places_[i] - places_[next]).norm();
        if (done[i] || through >= length[i] || !sees(places_[next], places_[i])) continue;
        length[i] = through;
        before[i] = next;
      }
    }
    std::vector<base::Vector3> way;
    for (std::size_t at = 1; at != 0; at = before[at]) way.push_back(places_[at]);
    std::ranges::reverse(way);
    return way;
  }

 private:
  void add(const base::Vector3& place) {
    if (std::ranges::none_of(boxes_, [&](const base::Bounds& it) { return it.contains(place); }))
      places_.push_back(place);
  }

  /// Adds the corners of a box, and the point of each edge that the straight way passes nearest.
  void add_places_round(const base::Bounds& box) {
    for (int number = 0; number < 8; ++number) {
      const base::Vector3 corner = box.corner(base::Bounds::CornerType(number));
      add(corner);
      for (int axis = 0; axis < 3; ++axis)
        if (corner[axis] == box.min()[axis]) add(nearest_on_edge(corner, axis, box.sizes()[axis]));
    }
  }

  /// The point of an edge that is nearest to the straight way (Ericson 2005, 5.1.9), inside both.
  base::Vector3 nearest_on_edge(const base::Vector3& corner, int axis, double length) const {
    const base::Vector3 way = places_[1] - places_[0];
    const base::Vector3 off = places_[0] - corner;
    const double along = way[axis], squared = way.squaredNorm();
    const double apart = squared - along * along;
    const double part = apart > 0.0 ? std::clamp((along * off[axis] - way.dot(off)) / apart, 0.0, 1.0) : 0.0;
    base::Vector3 point = corner;
    point[axis] += std::clamp(off[axis] + part * along, 0.0, length);
    return point;
  }

  bool sees(const base::Vector3& from, const base::Vector3& to) const {
    return std::ranges::none_of(boxes_, [&](const base::Bounds& box) { return crosses(from, to, box); });
  }

  std::vector<base::Bounds> boxes_;
  std::vector<base::Vector3> places_;
};

}  // namespace

std::vector<base::Vector3> route(const base::Vector3& from, const base::Vector3& to,
                                 const std::vector<base::Bounds>& boxes, double clearance) {
  return Map(from, to, boxes, clearance).shortest();
}

}  // namespace icome::study
