#include "haptics/contact_fan.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace icome::haptics {
namespace {

using Kind = Element::Kind;

constexpr double kLift = 1.0 / 16.0;  // of the length of a way: how high stations stand above their edge

}  // namespace

bool ContactFan::knows(std::span<const Element> elements) {
  return elements.size() <= kCapacity && std::all_of(elements.begin(), elements.end(), [](const Element& e) {
           return e.tip <= 0.0 && e.flat() && e.kind != Kind::Disc;
         });
}

ContactFan::ContactFan(std::span<const Element> elements, const Vector3& position, const Vector3& pull,
                       const Tolerance& tolerance)
    : elements_(elements), position_(position), tolerance_(tolerance), length_(kLength * tolerance.gap) {
  find_ways(pull);
}

/// Calls `visit(foot, along)` for each edge of the element that comes near: the point of its line nearest to
/// the SCP, and its unit direction.
template <typename Visit>
void ContactFan::for_each_edge(std::size_t element, Visit&& visit) const {
  const Element& e = elements_[element];
  const Vector3 offset = position_ - e.origin;
  const Vector3 foot = position_ - e.axis * e.axis.dot(offset);
  const auto edge = [&](const Vector3& inward, double least) {
    const double inside = inward.dot(offset) - least;
    if (std::abs(inside) <= length_) visit(Vector3(foot - inside * inward), Vector3(e.axis.cross(inward)));
  };
  if (e.kind == Kind::Triangle) {
    edge(e.u, e.a);
    edge(e.v, e.b);
    edge(e.w, e.c);
  } else if (e.kind == Kind::Parallelogram) {
    edge(e.u, -e.a);
    edge(-e.u, -e.a);
    edge(e.v, -e.b);
    edge(-e.v, -e.b);
  }
}

void ContactFan::find_ways(const Vector3& pull) {
  const Vector3 direction = pull.normalized();
  consider(direction, direction, FanWay::kNone, 0.0);
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Vector3& normal = elements_[i].axis;
    const Vector3 along_face = direction - normal.dot(direction) * normal;
    consider(along_face, direction, i, std::max(0.0, tolerance_.gap - height(elements_[i], position_)));
    // Along an edge no face comes nearer, so that none must be risen above: between the walls of a slot there
    // may be no room for it.
    for_each_edge(i, [&](const Vector3&, const Vector3& along_edge) {
      consider(along_edge.dot(direction) * along_edge, direction, i, 0.0);
    });
  }
  std::sort(ways_.begin(), ways_.begin() + way_count_,
            [](const FanWay& one, const FanWay& other) { return one.gain > other.gain; });
}

/// A way `along`, whose length is the cosine of its angle to the pull, that ends `risen` metres farther above
/// the element it runs on.
void ContactFan::consider(const Vector3& along, const Vector3& pull, std::size_t on, double risen) {
  const double cosine = along.norm();
  if (cosine * length_ <= tolerance_.touching()) return;
  Vector3 end = position_ + (length_ / cosine) * along;
  if (risen > 0.0) end += risen * elements_[on].axis;
  const double gain = pull.dot(end - position_) / length_;
  if (gain * length_ > tolerance_.touching()) ways_[way_count_++] = {end, gain, on};
}

std::optional<FanWay> ContactFan::steepest(double held) {
  for (const FanWay& way : std::span(ways_).first(way_count_)) {
    if (looks_ <= 0) break;
    if (way.on != FanWay::kNone && way.gain <= held) continue;
    if (sees(position_, way.end) || (!buried(way.end) && reachable(way.end))) return way;
  }
  return std::nullopt;
}

/// Whether a straight way passes through the element, or through its plane so near to its edge that this
/// cannot be told.
ContactFan::Passage ContactFan::passage(const Element& e, const Vector3& from, const Vector3& to) const {
  --looks_;
  const double before = height(e, from);
  const double after = height(e, to);
  if ((before > 0.0 && after > 0.0) || (before < 0.0 && after < 0.0)) return Passage::Free;
  const double share = before == after ? 0.5 : std::clamp(before / (before - after), 0.0, 1.0);
  const Vector3 crossing = from + share * (to - from);
  if (!covers(e, crossing, tolerance_)) return Passage::Free;
  return covers(e, crossing, Tolerance::reaching(-tolerance_.rim())) ? Passage::Through : Passage::AtAnEdge;
}

bool ContactFan::sees(const Vector3& from, const Vector3& to) const {
  return std::all_of(elements_.begin(), elements_.end(),
                     [&](const Element& e) { return passage(e, from, to) == Passage::Free; });
}

/// Is the place surely within a solid? The way there from the SCP, which lies outside, then passes an odd
/// number of its faces.
bool ContactFan::buried(const Vector3& place) const {
  int passed = 0;
  for (const Element& e : elements_) {
    const Passage found = passage(e, position_, place);
    if (e.two_sided || found == Passage::AtAnEdge) return false;
    if (found == Passage::Through) ++passed;
  }
  return passed % 2 == 1;
}

/// Above each edge as seen from each of its faces, a way's length along it, and at its foot.
void ContactFan::find_stations() {
  has_stations_ = true;
  const auto add = [&](const Vector3& station) {
    const bool known = (station - position_).norm() <= kNeighbourhood * length_;
    if (known && station_count_ < kMostStations) stations_[station_count_++] = station;
  };
  const auto add_above = [&](const Element& e, const Vector3& on_edge) {
    if (!covers(e, on_edge, tolerance_)) return;
    add(on_edge + kLift * length_ * e.axis);
    if (e.two_sided) add(on_edge - kLift * length_ * e.axis);
  };
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    for_each_edge(i, [&](const Vector3& foot, const Vector3& along) {
      add_above(elements_[i], foot + length_ * along);
      add_above(elements_[i], foot - length_ * along);
    });
  }
  look_around(position_);
}

/// Adds the stations seen from a place to those seen so far.
void ContactFan::look_around(const Vector3& from) {
  for (std::size_t i = seen_count_; i < station_count_; ++i) {
    if (sees(from, stations_[i])) std::swap(stations_[i], stations_[seen_count_++]);
  }
}

/// Does a chain of stations, each in sight of the one before, lead from the SCP to a place?
bool ContactFan::reachable(const Vector3& place) {
  if (!has_stations_) find_stations();
  for (std::size_t i = 0; i < seen_count_ && looks_ > 0; ++i) {
    if (i == looked_from_) look_around(stations_[looked_from_++]);
    if (sees(stations_[i], place)) return true;
  }
  return false;
}

}  // namespace icome::haptics
