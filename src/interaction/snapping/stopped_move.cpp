#include "interaction/snapping/stopped_move.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "interaction/snapping/close_fit.h"
#include "world/shape/solid_geometry.h"

namespace icome::interaction {
namespace {

using world::ObjectId;

constexpr double kLongestWay = 1e6;  // of the size: beyond it, tolerances drown in rounding

/// The surfaces next to a place that the way on would lead into.
class Corner {
 public:
  Corner(const MovingObjects& objects, const Vector3& at, const Vector3& rest, double tolerance)
      : objects_(objects), at_(at), rest_(rest), tolerance_(tolerance) {}

  /// The way along one of them, or between two, that leads on the furthest; zero where none does.
  Vector3 way_along(const std::vector<Contact>& contacts) const {
    std::vector<Vector3> ways;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Vector3& normal = contacts[i].normal;
      ways.push_back(rest_ - rest_.dot(normal) * normal);
      for (std::size_t j = 0; j < i; ++j) {
        const Vector3 crease = normal.cross(contacts[j].normal);
        if (crease.squaredNorm() < 1e-12) continue;
        ways.push_back(rest_.dot(crease) / crease.squaredNorm() * crease);
      }
    }
    std::stable_sort(ways.begin(), ways.end(),
                     [](const Vector3& a, const Vector3& b) { return a.norm() > b.norm(); });
    for (const Vector3& way : ways) {
      if (way.norm() > kTrial * tolerance_ && leads_on(way)) return way;
    }
    return Vector3::Zero();
  }

 private:
  static constexpr double kTrial = 10.0;  // tolerances: shorter ways are not worth a turn

  /// Does the way lead on? A normal where edges end may be that of no surface: only trying tells.
  bool leads_on(const Vector3& way) const {
    return objects_.free_share(at_, kTrial * tolerance_ * way.normalized(), 0.1 * tolerance_) > 0.5;
  }

  const MovingObjects& objects_;
  Vector3 at_, rest_;
  double tolerance_;  // m
};

/// For objects that go into others by little, as those do that were placed by numbers, and surfaces that are
/// known by their triangles: the nearest place, along one of six ways, where they do not. None where they go
/// in by more than that.
std::optional<Vector3> lifted(const MovingObjects& moving, const Vector3& from, double tolerance) {
  double taken = 0.0;  // share of their size
  for (const double share : {1e-6, 1e-5, 1e-4, 1e-3, 4e-3, 0.012, 0.03}) {
    for (const int axis : {1, 0, 2}) {
      for (const double side : {1.0, -1.0}) {
        const Vector3 way = side * moving.size() * Vector3::Unit(axis);
        if (moving.overlap(from + share * way)) continue;
        double free = share;
        while ((free - taken) * moving.size() > tolerance) {
          const double middle = 0.5 * (free + taken);
          (moving.overlap(from + middle * way) ? taken : free) = middle;
        }
        return from + free * way;
      }
    }
    taken = share;
  }
  return std::nullopt;
}

/// For objects that go into others by no more than the deviation of triangles: the place back along their
/// way where they do not; else the place where they are.
Vector3 drawn_back(const MovingObjects& moving, const Vector3& from, const Vector3& direction,
                   double tolerance) {
  const double most = 2.0 * moving.deviation(from);
  double taken = 0.0;
  for (const double share : {0.01, 0.1, 0.3, 1.0}) {
    double free = share * most;
    if (moving.overlap(from - free * direction)) {
      taken = free;
      continue;
    }
    while (free - taken > tolerance) {
      const double middle = 0.5 * (free + taken);
      (moving.overlap(from - middle * direction) ? taken : free) = middle;
    }
    return from - free * direction;
  }
  return from;
}

/// The beginning of the way, which is free by triangles where such a place is near.
Vector3 where_it_begins(const MovingObjects& moving, const Vector3& from, const Vector3& way, bool slide,
                        double tolerance) {
  if (!moving.overlap(from)) return from;
  if (slide) return lifted(moving, from, tolerance).value_or(from);
  return way.isZero(0.0) ? from : drawn_back(moving, from, way.normalized(), tolerance);
}

base::Result<void> check_tolerance(double tolerance) {
  if (tolerance > 0.0 && tolerance < 0.1) return {};
  return base::fail("The tolerance of a move is a share of the objects' size: choose one from 1e-9 to 1e-4.");
}

base::Result<void> check_way(const MovingObjects& objects, const Vector3& way) {
  if (!way.allFinite()) return base::fail("A move needs finite numbers: choose another place.");
  if (!(way.norm() <= kLongestWay * std::max(1.0, objects.size())))
    return base::fail("That is too far away to be moved to in one go: choose a nearer place.");
  return {};
}

/// The move as far as triangles let them go.
StoppedMove stopped_by_triangles(const MovingObjects& moving, const Vector3& from, const Vector3& wanted,
                                 const StopSettings& settings) {
  const double tolerance = settings.tolerance * moving.size();
  StoppedMove result{from, false, {}};
  Vector3& at = result.offset;
  at = where_it_begins(moving, from, wanted - from, settings.slide, tolerance);
  for (int turn = 0; turn <= (settings.slide ? settings.most_slides : 0); ++turn) {
    const double share = moving.free_share(at, wanted - at, 0.1 * tolerance);
    if (share >= 1.0) return StoppedMove{wanted, false, {}};
    at += share * (wanted - at);
    if (moving.is_spent()) break;
    result.contacts = moving.contacts(at, wanted - at, tolerance);
    if (!settings.slide || turn == settings.most_slides) break;
    const Vector3 way = Corner(moving, at, wanted - at, tolerance).way_along(result.contacts);
    if (way.isZero(0.0)) break;
    at += moving.free_share(at, way, 0.1 * tolerance) * way;
  }
  return result;
}

}  // namespace

base::Result<StoppedMove> stopped_move(world::CollisionIndex& index, std::span<const ObjectId> objects,
                                       const Vector3& wanted, const StopSettings& settings) {
  return stopped_move(MovingObjects(index, objects), Vector3::Zero(), wanted, settings);
}

base::Result<StoppedMove> stopped_move(const MovingObjects& moving, const Vector3& from,
                                       const Vector3& wanted, const StopSettings& settings) {
  if (auto fine = check_tolerance(settings.tolerance); !fine) return tl::unexpected(fine.error());
  if (auto fine = check_way(moving, wanted - from); !fine) return tl::unexpected(fine.error());
  if (!settings.stop) return StoppedMove{wanted, false, {}};
  const double tolerance = settings.tolerance * moving.size();
  StoppedMove result = stopped_by_triangles(moving, from, wanted, settings);
  Vector3& at = result.offset;
  if (const auto fit = close_fit(moving, {from, at, wanted, settings.slide, tolerance})) {
    at = fit->offset;
    if (!fit->contacts.empty()) result.contacts = fit->contacts;
  }
  result.spent = moving.is_spent();
  // The effort was spent before the stop could be fitted to the exact shapes.
  if (result.spent && moving.deviation(at) > 0.0) at = from;
  if (result.spent) result.contacts.clear();
  result.stopped = (wanted - at).norm() > tolerance;
  // Objects that rest at a surface do not creep up to it.
  if (result.stopped && (at - from).norm() <= tolerance) at = from;
  return result;
}

base::Result<StoppedMove> landing(world::CollisionIndex& index, std::span<const ObjectId> objects,
                                  const LandSettings& settings) {
  if (auto fine = check_tolerance(settings.tolerance); !fine) return tl::unexpected(fine.error());
  const double length = settings.direction.norm();
  if (!std::isfinite(length) || length == 0.0)
    return base::fail("Objects fall along a direction: choose one with a length.");
  const Vector3 direction = settings.direction / length;
  MovingObjects moving(index, objects);
  if (moving.empty() || moving.bounds().isEmpty())
    return base::fail("There is nothing that could fall: choose objects with a shape.");
  world::CollisionShape floor(std::make_shared<world::PrimitiveGeometry>(geometry::Plane{}, world::Axis::Y));
  if (settings.floor && direction.y() < 0.0) moving.add_obstacle(floor, Affine3::Identity());
  const double tolerance = settings.tolerance * moving.size();
  const Vector3 from = where_it_begins(moving, Vector3::Zero(), direction, false, tolerance);
  if (moving.overlap(from))
    return base::fail("It goes through something where it is: move it out before it lands.");
  const Vector3 way = moving.way_past_all(direction) * direction;
  if (auto fine = check_way(moving, way); !fine) return tl::unexpected(fine.error());
  const double share = moving.free_share(from, way, 0.1 * tolerance);
  if (share >= 1.0)
    return base::fail("There is nothing below to land on: put something there, or let it fall to the floor.");
  StoppedMove result{from + share * way, true, {}};
  result.contacts = moving.contacts(result.offset, way, tolerance);
  const Vector3 beyond = result.offset + way;
  if (const auto fit = close_fit(moving, {Vector3::Zero(), result.offset, beyond, false, tolerance}))
    result.offset = fit->offset;
  return result;
}

}  // namespace icome::interaction
