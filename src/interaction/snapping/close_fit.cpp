#include "interaction/snapping/close_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "interaction/snapping/least_gap.h"

namespace icome::interaction {
namespace {

using Pair = MovingObjects::Pair;

constexpr double kSearched = 3.0;  // deviations: how far what may meet is looked for
constexpr double kMostOff = 2.5;   // deviations: the farthest correction
constexpr double kAgainstWay = 1e-6;

/// A place where two shapes are next to each other, and the gap that keeps them apart there.
struct NarrowPlace {
  std::size_t pair;  // number
  Vector3 place;     // m, world frame
  Vector3 normal;    // unit, from the other to the moved shape
  double gap;        // m, as far as is known; negative where they overlap
  double window;     // m: the surfaces there are surely not farther from the place
};

double least_side(const Passing& passing) {
  double least = std::numeric_limits<double>::infinity();
  const auto take = [&](const world::CollisionShape& shape, const Affine3& place) {
    if (!shape.unlimited()) least = std::min(least, shape.bounds().transformed(place).sizes().maxCoeff());
  };
  take(*passing.moved, passing.world_from_moved);
  take(*passing.other, passing.world_from_other);
  return least;
}

/// All shapes that are next to objects at a place, exact and not as triangles.
class Neighbourhood {
 public:
  Neighbourhood(const MovingObjects& objects, const Vector3& at, double tolerance)
      : at_(at), precision_(0.1 * tolerance) {
    constexpr double kMostOfSize = 0.1;  // next to what is far larger, and so is off by more
    deviation_ = std::min(objects.deviation(at), kMostOfSize * objects.size());
    if (deviation_ == 0.0) return;
    pairs_ = objects.beside(at, kSearched * deviation_);
    std::stable_partition(pairs_.begin(), pairs_.end(), [](const Pair& it) { return it.deviation() > 0.0; });
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (pairs_[i].deviation() == 0.0 && places_.empty()) break;
      find_places(i);
    }
  }

  /// The deviation of the triangles of neighbouring shapes, m.
  double deviation() const { return deviation_; }
  /// The narrow places; none where triangles tell as much.
  const std::vector<NarrowPlace>& places() const { return places_; }
  const Pair& pair(const NarrowPlace& it) const { return pairs_[it.pair]; }

  /// Measures the narrow places again for objects that are at `at`.
  void look(const Vector3& at) {
    const double reach = looked_ ? 0.25 : 1.0;
    for (NarrowPlace& it : places_) {
      Passing passing = pairs_[it.pair].passing;
      passing.world_from_moved = Eigen::Translation3d(at - at_) * passing.world_from_moved;
      const GapLines lines(passing, it.place, it.normal, it.window + 3.0 * (at - at_).norm());
      const auto found = least_gap(lines, reach * kReach * least_side(passing), precision_);
      it.gap = found ? found->gap : std::numeric_limits<double>::infinity();
      if (found) it.place = found->place;
      if (found) it.normal = found->normal;
    }
    if (!looked_) std::erase_if(places_, [](const NarrowPlace& it) { return std::isinf(it.gap); });
    looked_ = true;
  }

  double least() const {
    double least = std::numeric_limits<double>::infinity();
    for (const NarrowPlace& it : places_) least = std::min(least, it.gap);
    return least;
  }

  /// Do the objects at `at` overlap shapes that triangles describe exactly?
  bool goes_into_plain(const Vector3& at) const {
    return std::any_of(places_.begin(), places_.end(), [&](const NarrowPlace& place) {
      const Pair& it = pair(place);
      if (it.deviation() > 0.0) return false;
      Passing passing = it.passing;
      passing.world_from_moved = Eigen::Translation3d(at - at_) * passing.world_from_moved;
      return overlap_at(passing, 0.0);
    });
  }

 private:
  static constexpr double kReach = 0.03;  // of the size: about an edge of the triangles
  static constexpr std::size_t kMostPlaces = 12;

  /// The places where triangles touch when the shape goes a little along some axis.
  std::vector<NarrowPlace> touches_of(std::size_t number) const {
    constexpr double kFacing = 0.57;  // cosine: each normal faces one of the axes as much
    std::vector<NarrowPlace> found;
    const double around = 4.0 * pairs_[number].deviation() + 100.0 * precision_;
    for (int axis = 0; axis < 3; ++axis) {
      Passing passing = pairs_[number].passing;
      passing.step = kSearched * deviation_ * Vector3::Unit(axis);
      const auto visit = [&](const Touch& touch) {
        if (std::abs(touch.normal[axis]) < kFacing) return 1.0;
        const double gap = std::abs(touch.normal.dot(passing.step) * touch.share);
        const Vector3 normal = touch.share < 0.0 ? Vector3(-touch.normal) : touch.normal;
        const Vector3 between = touch.place - 0.5 * touch.share * passing.step;
        found.push_back({number, between, normal, gap, 2.0 * gap + around});
        return 1.0;
      };
      visit_touches(passing, -1.0, 1.0, visit);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const NarrowPlace& a, const NarrowPlace& b) { return a.gap < b.gap; });
    return found;
  }

  /// Does the way down from one lead to the other, or do both lie between the same two planes?
  bool alike(const NarrowPlace& one, const NarrowPlace& other, double apart) const {
    const double turn = 1.0 - one.normal.dot(other.normal);
    const bool flush = turn < 1e-9 && std::abs(one.gap - other.gap) < precision_ &&
                       std::abs(one.normal.dot(one.place - other.place)) < precision_;
    return flush || (turn < 0.01 && (one.place - other.place).norm() < apart);
  }

  void find_places(std::size_t number) {
    const double apart = 0.5 * kReach * least_side(pairs_[number].passing);
    const auto first = std::ptrdiff_t(places_.size());
    const std::vector<NarrowPlace> touches = touches_of(number);
    if (touches.empty() || overlap_at(pairs_[number].passing, 0.0)) return;
    for (const NarrowPlace& it : touches) {
      if (places_.size() == std::size_t(first) + kMostPlaces) break;
      const bool known = std::any_of(places_.begin() + first, places_.end(),
                                     [&](const NarrowPlace& other) { return alike(it, other, apart); });
      if (!known) places_.push_back(it);
    }
  }

  Vector3 at_;
  double precision_;
  std::vector<Pair> pairs_;
  std::vector<NarrowPlace> places_;
  double deviation_ = 0.0;
  bool looked_ = false;
};

/// The step nearest to a wanted one by which each gap stays, or becomes, `margin` at least: by Hildreth's
/// method (1957). Where there is none, a long one.
Vector3 step_next_to(const Vector3& wanted, const std::vector<NarrowPlace>& places, double margin) {
  constexpr int kMostSweeps = 300;
  std::vector<double> pushes(places.size(), 0.0);
  Vector3 step = wanted;
  double most = margin;
  for (int sweep = 0; sweep < kMostSweeps && most > 1e-3 * margin; ++sweep) {
    most = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double missing = margin - places[i].gap - places[i].normal.dot(step);
      const double push = std::max(missing, -pushes[i]);
      pushes[i] += push;
      step += push * places[i].normal;
      most = std::max(most, std::abs(push));
    }
  }
  return step;
}

/// The step straight along the way to a wanted one (or back) that keeps these gaps; nothing where none does.
std::optional<Vector3> step_along(const Vector3& wanted, const Vector3& direction,
                                  const std::vector<NarrowPlace>& places, double margin) {
  constexpr double kAlong = 1e-3;  // cosine
  double most = wanted.dot(direction);
  for (const NarrowPlace& it : places) {
    const double climb = it.normal.dot(direction);
    if (climb < -kAlong) most = std::min(most, (it.gap - margin) / -climb);
    if (climb >= -kAlong && it.gap < 0.0) return std::nullopt;
  }
  return most * direction;
}

class Fitting {
 public:
  Fitting(const MovingObjects& objects, const StoppedWay& way)
      : objects_(objects), way_(way), near_(objects, way.at, way.tolerance) {}

  std::optional<CloseFit> run() {
    if (near_.deviation() == 0.0 || near_.places().empty()) return std::nullopt;
    near_.look(way_.at);
    if (near_.places().empty()) return std::nullopt;
    const auto settled = settle();
    if (objects_.is_spent()) return std::nullopt;
    if (settled)
      return *settled == way_.at ? std::nullopt : std::optional(CloseFit{*settled, contacts(*settled)});
    return CloseFit{back(), {}};
  }

 private:
  double margin() const { return 0.25 * way_.tolerance; }
  bool fits(const Neighbourhood& near) const { return near.least() >= -margin(); }

  Vector3 cut(const Vector3& way) const {
    const double most = near_.deviation() / std::max(way.norm(), near_.deviation());
    return most * way;
  }

  std::optional<Vector3> step(const Vector3& onwards) const {
    const Vector3 line = way_.wanted - way_.from;
    if (way_.slide || line.isZero(0.0)) return step_next_to(onwards, near_.places(), margin());
    return step_along(onwards, line.normalized(), near_.places(), margin());
  }

  /// The place next to the stop where the objects fit, as far on as they come.
  std::optional<Vector3> settle() {
    constexpr int kMostRounds = 8;
    Vector3 at = way_.at;
    Vector3 onwards = cut(way_.wanted - at);
    for (int round = 0; round < kMostRounds; ++round) {
      const auto found = step(onwards);
      if (!found || objects_.is_spent()) return std::nullopt;
      // Objects that rest are left alone.
      if (fits(near_) && (round > 0 || found->norm() <= way_.tolerance))
        return near_.goes_into_plain(at) ? std::nullopt : std::optional(at);
      const bool arrives = (at + *found - way_.wanted).norm() < 1e-3 * way_.tolerance;
      at = arrives ? way_.wanted : Vector3(at + *found);
      if ((at - way_.at).norm() > kMostOff * near_.deviation()) return std::nullopt;
      onwards.setZero();
      near_.look(at);
    }
    return std::nullopt;
  }

  /// The place on the way back where the objects fit.
  Vector3 back() const {
    constexpr int kLooks = 6;
    const Vector3 all = way_.from - way_.at;
    double share = 0.0;
    for (int i = 0; i < kLooks && !all.isZero(0.0); ++i) {
      Neighbourhood there(objects_, way_.at + share * all, way_.tolerance);
      there.look(way_.at + share * all);
      if (objects_.is_spent()) break;
      if (fits(there) && !objects_.overlap(way_.at + share * all)) return way_.at + share * all;
      share = share == 0.0 ? std::min(0.25, near_.deviation() / all.norm()) : 3.0 * share;
      if (share >= 1.0) break;
    }
    return way_.from;
  }

  std::vector<Contact> contacts(const Vector3& at) const {
    std::vector<Contact> result;
    const Vector3 rest = way_.wanted - at;
    for (const NarrowPlace& it : near_.places()) {
      const bool touches = it.gap <= 4.0 * way_.tolerance;
      const bool known = std::any_of(result.begin(), result.end(), [&](const Contact& other) {
        return other.normal.dot(it.normal) > 1.0 - 1e-6;
      });
      if (touches && !known && it.normal.dot(rest) < -kAgainstWay * rest.norm())
        result.push_back({near_.pair(it).moved, near_.pair(it).other, it.normal});
    }
    return result;
  }

  const MovingObjects& objects_;
  StoppedWay way_;
  Neighbourhood near_;
};

}  // namespace

std::optional<CloseFit> close_fit(const MovingObjects& objects, const StoppedWay& way) {
  return Fitting(objects, way).run();
}

}  // namespace icome::interaction
