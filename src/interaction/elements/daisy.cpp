#include "interaction/elements/daisy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/decompositions.h"

namespace icome::interaction {
namespace {

using base::Quaternion;
using base::Vector3;

/// A tile as it lies on a sphere.
struct DaisyTile {
  Quaternion turn;  // from the front
  Vector3 direction;
};

DaisyTile tile_of(const DaisySphere& sphere, const Vector2& place) {
  const Quaternion turn = sphere.turn_to(place);
  return {turn, turn * Vector3::UnitZ()};
}

/// Do two rectangles of that size overlap, of which one has its middle at `offset` from the other's and is
/// rolled by an angle (rad)? Separating axes.
bool overlap(const Vector2& size, const Vector2& offset, double roll) {
  const double c = std::cos(roll), s = std::sin(roll);
  const Vector2 reach = 0.5 * size + 0.5 * Vector2(std::abs(c) * size.x() + std::abs(s) * size.y(),
                                                   std::abs(s) * size.x() + std::abs(c) * size.y());
  const Vector2 rolled(c * offset.x() + s * offset.y(), -s * offset.x() + c * offset.y());
  return (offset.cwiseAbs().array() < reach.array()).all() &&
         (rolled.cwiseAbs().array() < reach.array()).all();
}

/// Does one tile lie over another? Judged on the plane of each of the two.
bool lie_over_each_other(const DaisyTile& one, const DaisyTile& other, const Vector2& size, double radius) {
  const Quaternion between = one.turn.conjugate() * other.turn;
  const Vector3 towards = between * Vector3::UnitZ();
  const double sine = std::hypot(towards.x(), towards.y());
  if (sine < 1e-12) return true;
  const double angle = std::atan2(sine, towards.z());
  const Vector2 offset = radius * angle / sine * Vector2(towards.x(), towards.y());
  const Quaternion shortest = base::rotation_between(Vector3::UnitZ(), towards);
  const Vector3 right = (shortest.conjugate() * between) * Vector3::UnitX();
  return overlap(size, offset, std::atan2(right.y(), right.x()));
}

/// Places on the sheet that a tile may take, the nearest to the middle first.
std::vector<Vector2> candidates(const Vector2& tile, double reach) {
  const Vector2 step(tile.x() / 6.0, tile.y() / 2.0);
  const int columns = int(reach / step.x()), rows = int(reach / step.y());
  std::vector<Vector2> places;
  for (int row = -rows; row <= rows; ++row)
    for (int column = -columns; column <= columns; ++column) {
      const Vector2 place(column * step.x(), row * step.y());
      if (place.norm() <= reach) places.push_back(place);
    }
  // As people read: among places that are equally near, the upper one comes first, then the left one.
  std::ranges::sort(places, {}, [](const Vector2& it) {
    return std::array<double, 3>{std::round(1e9 * it.norm()), -it.y(), it.x()};
  });
  return places;
}

/// Takes the nearest places that are free; fewer than `count` where the sphere is too small.
std::vector<Vector2> places_on(const DaisySphere& sphere, std::size_t count, const Vector2& tile) {
  const double far_apart = std::min(tile.norm() / sphere.radius, std::numbers::pi);
  std::vector<Vector2> taken;
  std::vector<DaisyTile> tiles;
  for (const Vector2& place : candidates(tile, kDaisyReach * sphere.radius)) {
    if (taken.size() == count) break;
    const DaisyTile next = tile_of(sphere, place);
    const bool is_free = std::ranges::none_of(tiles, [&](const DaisyTile& it) {
      return it.direction.dot(next.direction) > std::cos(far_apart) &&
             (lie_over_each_other(it, next, tile, sphere.radius) ||
              lie_over_each_other(next, it, tile, sphere.radius));
    });
    if (!is_free) continue;
    taken.push_back(place);
    tiles.push_back(next);
  }
  return taken;
}

}  // namespace

Quaternion DaisySphere::turn_to(const Vector2& place) const {
  const double length = place.norm();
  if (!(length > 0.0)) return Quaternion::Identity();
  const Vector3 axis(-place.y() / length, place.x() / length, 0.0);
  return Quaternion(Eigen::AngleAxisd(length / radius, axis));
}

double DaisySphere::angle_between(const Vector2& one, const Vector2& other) const {
  const Vector3 a = turn_to(one) * Vector3::UnitZ(), b = turn_to(other) * Vector3::UnitZ();
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

base::Pose DaisySphere::tile_at(const Vector2& place, const Vector2& front) const {
  const Quaternion turn = turn_to(front).conjugate() * turn_to(place);
  base::Pose pose = base::Pose::Identity();
  pose.linear() = turn.toRotationMatrix();
  pose.translation() = radius * (turn * Vector3::UnitZ() - Vector3::UnitZ());
  return pose;
}

DaisyLayout daisy_layout(std::size_t count, const Vector2& tile, double least_radius) {
  constexpr double kGrowth = 1.06;
  // The cap of the sphere that is used must at least be as large as all tiles; a single one wants a ball too.
  const double cap = 2.0 * std::numbers::pi * (1.0 - std::cos(kDaisyReach));
  double radius =
      std::max({least_radius, 0.6 * tile.maxCoeff(), std::sqrt(double(count) * tile.prod() / cap)});
  for (;; radius *= kGrowth) {
    std::vector<Vector2> places = places_on({radius, 0.0}, count, tile);
    if (places.size() == count) return {radius, std::move(places)};
  }
}

}  // namespace icome::interaction
