#include "haptics/contact/tip_room.h"

#include <algorithm>
#include <cmath>

namespace icome::haptics {
namespace {

constexpr int kMostPushes = 40;
constexpr int kDirections = 48;
constexpr double kLeastAdvance = 0.05;  // radii; least step along a direction
constexpr double kGoldenAngle = 2.399963229728653;
constexpr double kDirectEnough = 1.25;  // of the overlap: no shorter way out is worth a search

/// One of kDirections unit vectors, evenly around: a spiral from pole to pole.
Vector3 spiral_direction(int which) {
  const double z = 1.0 - 2.0 * (which + 0.5) / kDirections;
  const double across = std::sqrt(1.0 - z * z);
  return {across * std::cos(kGoldenAngle * which), across * std::sin(kGoldenAngle * which), z};
}

}  // namespace

std::optional<TipRoom::Overlap> TipRoom::overlap_with(std::uint32_t object, const Vector3& place) const {
  const HapticObject& it = scene_.objects()[object];
  const Pose from_object = scene_.pose_in(frame_.origin, object, frame_.elapsed);
  const Vector3 own = from_object.inverse() * place;
  const double gap = std::max(scene_.tolerance_near(object, own).gap,
                              Tolerance::for_coordinates(place.cwiseAbs().maxCoeff()).gap);
  const bool solid = it.surface.sides == TouchableSides::Front;
  const auto inside = solid ? it.shape->way_out(own, scene_.time(object, frame_.elapsed)) : std::nullopt;
  if (inside) {
    const double depth = frame_.tip + (inside->point - own).norm();
    return Overlap{depth, from_object.linear() * inside->normal, 2.0 * gap};
  }
  const auto nearest = it.shape->nearest(own, frame_.tip, it.surface.sides);
  if (!nearest) return std::nullopt;
  const double depth = frame_.tip - (nearest->point - own).norm();
  return Overlap{depth, from_object.linear() * nearest->normal, 2.0 * gap};
}

std::optional<TipRoom::Overlap> TipRoom::deepest(const Vector3& place) const {
  std::optional<Overlap> most;
  const Vector3 at = frame_.origin + place;
  scene_.near(at, at, frame_.tip, [&](std::uint32_t object) {
    const std::optional<Overlap> found = overlap_with(object, place);
    if (found && (!most || found->depth > most->depth)) most = found;
    return true;
  });
  return most;
}

/// Moves the tip out of its deepest overlap, again and again: in a groove it settles between the walls.
std::optional<Vector3> TipRoom::pushed_out(const Vector3& place, double farthest) const {
  Vector3 at = place;
  for (int i = 0; i < kMostPushes; ++i) {
    const std::optional<Overlap> overlap = deepest(at);
    if (!overlap) return at;
    at += (overlap->depth + overlap->gap) * overlap->out;
    if ((at - place).norm() > farthest) break;
  }
  return std::nullopt;
}

/// Distance (m) along a direction at which the tip fits first; `farthest` where it does not.
double TipRoom::along(const Vector3& place, const Vector3& direction, double farthest) const {
  double way = 0.0;
  while (way < farthest) {
    const std::optional<Overlap> overlap = deepest(place + way * direction);
    if (!overlap) return way;
    way += std::max(overlap->depth + overlap->gap, kLeastAdvance * frame_.tip);
  }
  return farthest;
}

std::optional<Vector3> TipRoom::near(const Vector3& place) const {
  const std::optional<Overlap> overlap = deepest(place);
  if (!overlap) return place;
  double shortest = kFarthest * frame_.tip;
  std::optional<Vector3> best = pushed_out(place, shortest);
  if (best) shortest = (*best - place).norm();
  if (best && shortest <= kDirectEnough * overlap->depth) return best;
  for (int i = 0; i < kDirections; ++i) {
    const Vector3 direction = spiral_direction(i);
    const double way = along(place, direction, shortest);
    if (way >= shortest) continue;
    shortest = way;
    best = place + way * direction;
  }
  return best;
}

}  // namespace icome::haptics
