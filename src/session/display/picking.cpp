#include "session/display/picking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/segment.h"

namespace icome::session {
namespace {

using base::Bounds;
using base::Pose;
using base::Vector3;
using interaction::Ray;

constexpr double kHorizon = 1000.0;  // times the distance to what has no end

bool is_finite(const Bounds& bounds) { return bounds.min().allFinite() && bounds.max().allFinite(); }

double farthest_corner(const Bounds& bounds, const Vector3& from) {
  return (from - bounds.min()).cwiseAbs().cwiseMax((from - bounds.max()).cwiseAbs()).norm();
}

/// The part of the ray near an object, in the frame of its shape.
struct Candidate {
  std::uint32_t object = 0;
  double first = 0.0;  // m, along the ray
  Vector3 start = Vector3::Zero(), step = Vector3::Zero();
};

/// The part of the ray near the object; nothing where there is none.
std::optional<Candidate> candidate(const haptics::HapticScene& scene, std::uint32_t object, const Ray& ray,
                                   double elapsed) {
  const Pose object_from_world = scene.pose(object, elapsed).inverse();
  const Vector3 start = object_from_world * ray.origin;
  const Vector3 direction = object_from_world.linear() * ray.direction;
  const Bounds bounds = scene.objects()[object].shape->bounds();
  if (bounds.isEmpty()) return std::nullopt;
  if (!is_finite(bounds)) {
    const double reach = scene.bounds().isEmpty() ? 1.0 : farthest_corner(scene.bounds(), ray.origin);
    return Candidate{object, 0.0, start, std::max(reach, kHorizon * start.norm()) * direction};
  }
  const Vector3 step = 2.0 * farthest_corner(bounds, start) * direction;
  // From a start near the object, all results keep their digits however far off the eye is.
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * start.cwiseAbs().maxCoeff();
  const double margin = 1e-9 * bounds.diagonal().norm() + rounding;
  const auto part = geometry::part_within(bounds, start, step, margin);
  if (!part) return std::nullopt;
  const auto [first, last] = *part;
  return Candidate{object, first * step.norm(), start + first * step, (last - first) * step};
}

/// The candidates along the ray, nearest first.
std::vector<Candidate> candidates(const haptics::HapticScene& scene, const Ray& ray, double elapsed) {
  const double reach = scene.bounds().isEmpty() ? 0.0 : 2.0 * farthest_corner(scene.bounds(), ray.origin);
  std::vector<Candidate> found;
  scene.near(ray.origin, ray.origin + reach * ray.direction, 0.0, [&](std::uint32_t object) {
    if (const auto it = candidate(scene, object, ray, elapsed)) found.push_back(*it);
    return true;
  });
  std::sort(found.begin(), found.end(),
            [](const Candidate& a, const Candidate& b) { return a.first < b.first; });
  return found;
}

}  // namespace

std::optional<PickedThing> pick(const haptics::HapticScene& scene, const Ray& ray, double elapsed) {
  if (!ray.origin.allFinite() || !ray.direction.allFinite() || ray.direction.isZero(0.0)) return std::nullopt;
  const Ray unit{ray.origin, ray.direction.stableNormalized()};
  std::optional<PickedThing> best;
  for (const Candidate& it : candidates(scene, unit, elapsed)) {
    if (best && it.first > best->place.distance) break;
    const haptics::HapticObject& object = scene.objects()[it.object];
    const auto hit = object.shape->cast(it.start, it.step, scene.time(it.object, elapsed));
    if (!hit) continue;
    const double distance = it.first + hit->t * it.step.norm();
    if (best && distance >= best->place.distance) continue;
    const Pose world_from_object = scene.pose(it.object, elapsed);
    const Vector3 normal = world_from_object.linear() * hit->normal;
    best = PickedThing{
        object.id,
        {world_from_object * hit->point, normal.dot(unit.direction) > 0.0 ? -normal : normal, distance}};
  }
  return best;
}

}  // namespace icome::session
