#include "interaction/snapping/moving_objects.h"

#include <algorithm>
#include <cmath>

namespace icome::interaction {
namespace {

using base::Bounds;
using world::ObjectId;

constexpr std::size_t kMostContacts = 16;   // more do not change where a slide can go
constexpr double kSameNormal = 1.0 - 1e-6;  // cosine
constexpr double kAgainst = 1e-6;           // of the way: less is along it

bool has_normal(const std::vector<Contact>& contacts, const Vector3& normal) {
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const Contact& it) { return it.normal.dot(normal) > kSameNormal; });
}

}  // namespace

MovingObjects::MovingObjects(world::CollisionIndex& index, std::span<const ObjectId> objects,
                             world::Effort* effort)
    : index_(index), effort_(effort) {
  for (const ObjectId root : objects) {
    if (!root) continue;
    for (const Standing& it : index.standing(root)) moved_.push_back(it);
  }
  std::sort(moved_.begin(), moved_.end(), [](const Standing& a, const Standing& b) { return a.id < b.id; });
  const auto same = [](const Standing& a, const Standing& b) { return a.id == b.id; };
  moved_.erase(std::unique(moved_.begin(), moved_.end(), same), moved_.end());
  for (const Standing& it : moved_) {
    if (!it.shape->unlimited()) bounds_.extend(it.shape->bounds().transformed(it.world_from_object));
  }
}

void MovingObjects::add_obstacle(world::CollisionShape& shape, const Affine3& world_from_shape) {
  obstacles_.push_back({{}, &shape, world_from_shape});
}

bool MovingObjects::moves(ObjectId id) const {
  const auto found = std::lower_bound(moved_.begin(), moved_.end(), id,
                                      [](const Standing& it, ObjectId wanted) { return it.id < wanted; });
  return found != moved_.end() && found->id == id;
}

std::vector<MovingObjects::Pair> MovingObjects::pairs(const Vector3& at, const Vector3& step,
                                                      double reach) const {
  std::vector<Pair> result;
  for (const Standing& it : moved_) {
    const Affine3 place = Eigen::Translation3d(at) * it.world_from_object;
    std::vector<Standing> others;
    if (it.shape->unlimited()) {
      others = index_.standing();
    } else {
      const Bounds box = it.shape->bounds().transformed(place);
      const Bounds way = box.merged(box.translated(step));
      // Boxes this near may touch, as a CollisionIndex sees them.
      const double slack = 2e-10 * way.min().cwiseAbs().cwiseMax(way.max().cwiseAbs()).maxCoeff();
      others = index_.standing_in(grown(way, reach + slack));
    }
    others.insert(others.end(), obstacles_.begin(), obstacles_.end());
    for (const Standing& other : others) {
      if (other.id && moves(other.id)) continue;
      result.push_back(
          {{it.shape, place, other.shape, other.world_from_object, step, effort_}, it.id, other.id});
    }
  }
  return result;
}

double MovingObjects::free_share(const Vector3& at, const Vector3& step, double tolerance) const {
  if (!(step.norm() > 0.0)) return 1.0;
  const std::vector<Pair> others = pairs(at, step, 0.0);
  double share = 1.0;
  for (const Pair& it : others) {
    if (const auto found = stop(it.passing, share, fit_tolerance(it.passing, tolerance)))
      share = std::min(share, *found);
  }
  // Nothing changes between touches, but a touch is known to within rounding only.
  double back = tolerance / step.norm();
  const auto comes_in = [&](const Pair& it) {
    return overlap_at(it.passing, share) && !overlap_at(it.passing, 0.0);
  };
  while (share > 0.0 && std::any_of(others.begin(), others.end(), comes_in)) {
    share = std::max(0.0, share - back);
    back *= 2.0;
  }
  if (is_spent()) return 0.0;
  return share;
}

std::vector<Contact> MovingObjects::contacts(const Vector3& at, const Vector3& step, double tolerance) const {
  std::vector<Contact> result;
  const double length = step.norm();
  if (!(length > 0.0)) return result;
  for (const Pair& it : pairs(at, Vector3::Zero(), 4.0 * tolerance)) {
    Passing passing = it.passing;
    passing.step = step;
    const auto add = [&](const Vector3& normal) {
      if (result.size() < kMostContacts && normal.dot(step) < -kAgainst * length &&
          !has_normal(result, normal))
        result.push_back({it.moved, it.other, normal});
    };
    if (overlap_at(passing, 0.0)) {
      if (stop(passing, 1.0, fit_tolerance(passing, tolerance)) == 0.0) add(-step / length);
      continue;
    }
    const double window = 2.0 * fit_tolerance(passing, tolerance) / length;
    const auto visit = [&](const Touch& touch) {
      add(touch.normal);
      return window;
    };
    visit_touches(passing, -window, window, visit);
  }
  return result;
}

double MovingObjects::deviation(const Vector3& at) const {
  double most = 0.0;
  for (const Pair& it : beside(at, 0.0)) most = std::max(most, it.deviation());
  return most;
}

bool MovingObjects::overlap(const Vector3& at) const {
  const std::vector<Pair> others = pairs(at, Vector3::Zero(), 0.0);
  return std::any_of(others.begin(), others.end(),
                     [](const Pair& it) { return overlap_at(it.passing, 0.0); });
}

double MovingObjects::way_past_all(const Vector3& direction) const {
  if (bounds_.isEmpty()) return 0.0;
  Bounds all = bounds_;
  double way = 0.0;
  bool any = false;
  std::vector<Standing> others = index_.standing();
  others.insert(others.end(), obstacles_.begin(), obstacles_.end());
  for (const Standing& it : others) {
    if (it.id && moves(it.id)) continue;
    any = true;
    if (const auto space = it.shape->half_space(it.world_from_object)) {
      const double speed = -space->normal.dot(direction);
      const double height = space->normal.dot(bounds_.center() - space->foot) + size();
      if (speed > 1e-9) way = std::max(way, height / speed);
    } else {
      all.extend(it.shape->bounds().transformed(it.world_from_object));
    }
  }
  return any ? std::max(way, all.diagonal().norm()) : 0.0;
}

}  // namespace icome::interaction
