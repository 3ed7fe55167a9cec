#include "haptics/contact/contact_fan.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace icome::haptics {
namespace {

using Kind = Element::Kind;

constexpr double kLift = 1.0 / 16.0;  // of the length of a way: height of stations above their edge
constexpr double kAlong = 1e-9;       // largest rate at which a way nears an edge that is parallel to it

/// height() of flat pieces under a point tip, the only elements here.
double above(const Element& e, const Vector3& position) { return e.axis.dot(position - e.origin); }

/// Calls `visit(inward, least)` for each edge of the element: inward . (place - origin) >= least within it.
template <typename Visit>
void for_each_rim(const Element& e, Visit&& visit) {
  if (e.kind == Kind::Triangle) {
    visit(e.u, e.a);
    visit(e.v, e.b);
    visit(e.w, e.c);
  } else if (e.kind == Kind::Parallelogram) {
    visit(e.u, -e.a);
    visit(-e.u, -e.a);
    visit(e.v, -e.b);
    visit(-e.v, -e.b);
  }
}

/// A way by t * along, t from `first` to `last`; none when `last` is less.
struct Stretch {
  double first, last;  // m
};

/// The part of the line from `foot` along an edge that lies in the element, no farther than `reach`.
Stretch edge_within(const Element& e, const Vector3& foot, const Vector3& along, double reach) {
  Stretch part{-reach, reach};
  for_each_rim(e, [&](const Vector3& inward, double least) {
    const double rate = inward.dot(along);
    if (std::abs(rate) <= kAlong) return;
    const double end = (least - inward.dot(foot - e.origin)) / rate;
    (rate > 0.0 ? part.first : part.last) = rate > 0.0 ? std::max(part.first, end) : std::min(part.last, end);
  });
  return part;
}

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

/// Calls `visit(foot, along, inward)` for each edge of the element whose line comes within `reach`: the point
/// of it nearest to the SCP, its unit direction, and the one at right angles to it into the element.
template <typename Visit>
void ContactFan::for_each_edge(std::size_t element, double reach, Visit&& visit) const {
  const Element& e = elements_[element];
  const Vector3 offset = position_ - e.origin;
  const Vector3 foot = position_ - e.axis * e.axis.dot(offset);
  for_each_rim(e, [&](const Vector3& inward, double least) {
    const double inside = inward.dot(offset) - least;
    if (std::abs(inside) <= reach)
      visit(Vector3(foot - inside * inward), Vector3(e.axis.cross(inward)), inward);
  });
}

void ContactFan::find_ways(const Vector3& pull) {
  const Vector3 direction = pull.normalized();
  consider(direction, direction, FanWay::kNone, 0.0);
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Vector3& normal = elements_[i].axis;
    const Vector3 along_face = direction - normal.dot(direction) * normal;
    const double low = std::max(0.0, tolerance_.gap - above(elements_[i], position_));
    consider(along_face, direction, i, low);
    // Along an edge no face comes nearer, so that none must be risen above: between the walls of a slot there
    // may be no room for it. But an SCP that rests before the edge begins may lie below its face.
    for_each_edge(i, length_, [&](const Vector3&, const Vector3& along_edge, const Vector3&) {
      const Vector3 along = along_edge.dot(direction) * along_edge;
      consider(along, direction, i, 0.0);
      if (low > 0.0) consider(along, direction, i, low);
    });
  }
  std::sort(ways_.begin(), ways_.begin() + way_count_,
            [](const FanWay& one, const FanWay& other) { return one.gain > other.gain; });
}

/// Adds a way `along`, whose length is the cosine of its angle to the pull, that ends `risen` metres farther
/// above the element it runs on.
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
    if (below_floor(way.end)) continue;
    if (sees(position_, way.end) || (!buried(way.end) && reachable(way.end))) return way;
  }
  return std::nullopt;
}

/// Tells whether a straight way passes through the element, or through its plane so near to its edge
/// that this is in doubt.
ContactFan::Passage ContactFan::passage(const Element& e, const Vector3& from, const Vector3& to) const {
  --looks_;
  const double before = above(e, from);
  const double after = above(e, to);
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

/// Is the place below an element that all others stand on? All of that side is then within the solid: in a
/// valley or a pit, where a tip rests most often, the search for a way is over at once.
bool ContactFan::below_floor(const Vector3& place) {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    if (above(elements_[i], place) < -tolerance_.behind() && is_floor(i)) return true;
  }
  return false;
}

bool ContactFan::is_floor(std::size_t element) {
  std::optional<bool>& known = floor_[element];
  if (known) return *known;
  if (extreme_count_ == 0) {
    for (std::size_t i = 0; i < elements_.size(); ++i) find_extremes(i);
  }
  const Element& e = elements_[element];
  const auto stands = [&](const Vector3& place) { return above(e, place) >= -tolerance_.touching(); };
  known = !e.two_sided && std::all_of(extremes_.begin(), extremes_.begin() + extreme_count_, stands) &&
          leads_on(element);
  return *known;
}

/// Collects the ends of the element's edges in the neighbourhood and the places farthest from these; for one
/// without an edge there, four places around the SCP's foot.
void ContactFan::find_extremes(std::size_t element) {
  const Element& e = elements_[element];
  const double reach = kNeighbourhood * length_;
  const std::size_t first = extreme_count_;
  for_each_edge(element, reach, [&](const Vector3& foot, const Vector3& along, const Vector3& inward) {
    const Stretch part = edge_within(e, foot, along, reach);
    if (part.first > part.last) return;
    extremes_[extreme_count_++] = foot + part.first * along;
    extremes_[extreme_count_++] = foot + part.last * along;
    const Vector3 middle = foot + 0.5 * (part.first + part.last) * along + reach * inward;
    if (covers(e, middle, tolerance_)) extremes_[extreme_count_++] = middle;
  });
  if (extreme_count_ == first) {
    const Vector3 foot = position_ - above(e, position_) * e.axis;
    const Vector3 side = reach * e.axis.unitOrthogonal();
    const Vector3 other = e.axis.cross(side);
    for (const Vector3& away : {side, Vector3(-side), other, Vector3(-other)})
      extremes_[extreme_count_++] = foot + away;
  }
}

/// Does each edge of the element in the neighbourhood belong to another one too? Beyond the rim of a sheet
/// one could come to its other side.
bool ContactFan::leads_on(std::size_t element) const {
  const double reach = kNeighbourhood * length_;
  bool shared = true;
  for_each_edge(element, reach, [&](const Vector3& foot, const Vector3& along, const Vector3&) {
    const Stretch part = edge_within(elements_[element], foot, along, reach);
    if (part.first > part.last) return;
    const Vector3 middle = foot + 0.5 * (part.first + part.last) * along;
    shared = shared && std::any_of(elements_.begin(), elements_.end(), [&](const Element& other) {
               return &other != &elements_[element] && std::abs(above(other, middle)) <= tolerance_.gap &&
                      covers(other, middle, tolerance_);
             });
  });
  return shared;
}

/// Places stations above each edge, on each of its faces, a way's length from its foot either way.
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
    for_each_edge(i, length_, [&](const Vector3& foot, const Vector3& along, const Vector3&) {
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
