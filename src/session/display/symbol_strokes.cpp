#include "session/display/symbol_strokes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace icome::session {
namespace {

using base::Vector3;

/// Calls `visit` with all strokes of a symbol: straight pieces with a radius.
template <typename Visit>
void for_each_stroke(const render::SceneOverlay& symbol, Visit&& visit) {
  for (const auto& line : symbol.lines)
    for (std::size_t i = 1; i < line.points.size(); ++i) visit(line.points[i - 1], line.points[i], 0.0);
  for (const auto& arrow : symbol.arrows) visit(arrow.from, arrow.to, arrow.radius);
  for (const auto& ball : symbol.balls) visit(ball.centre, ball.centre, ball.radius);
}

/// The place where the ray passes a piece; nothing where that is behind the ray's origin.
std::optional<PassedStroke> passed(const interaction::Ray& ray, const Vector3& from, const Vector3& to,
                                   double radius) {
  const auto across = [&](const Vector3& way) -> Vector3 {
    return way - way.dot(ray.direction) * ray.direction;
  };
  const Vector3 off = across(from - ray.origin), along = across(to - from);
  const double squared = along.squaredNorm();
  const double share = squared > 0.0 ? std::clamp(-off.dot(along) / squared, 0.0, 1.0) : 0.0;
  const Vector3 place = from + share * (to - from);
  const double depth = (place - ray.origin).dot(ray.direction);
  if (!(depth > 0.0)) return std::nullopt;
  const double distance = std::max(0.0, (off + share * along).norm() - radius);
  return PassedStroke{{place, -ray.direction, depth}, distance / depth};
}

}  // namespace

void SymbolPen::line(std::vector<Vector3> points) {
  for (Vector3& point : points) point = world_from_symbol_ * point;
  overlay_.lines.push_back({std::move(points), colour_, 1.5});
}

void SymbolPen::circle(const Vector3& centre, const Vector3& axis, double radius) {
  const Vector3 first = axis.unitOrthogonal(), second = axis.normalized().cross(first);
  std::vector<Vector3> points;
  for (int i = 0; i <= kAround; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kAround;
    points.push_back(centre + radius * (std::cos(angle) * first + std::sin(angle) * second));
  }
  line(std::move(points));
}

void SymbolPen::sphere(const Vector3& centre, double radius) {
  for (int axis = 0; axis < 3; ++axis) circle(centre, Vector3::Unit(axis), radius);
}

void SymbolPen::box(const base::Bounds& box) {
  const auto corner = [&](int which) {
    return Vector3(box.corner(base::Bounds::CornerType(which)));  // bits: x, y, z
  };
  for (const int z : {0, 4}) line({corner(z), corner(z + 1), corner(z + 3), corner(z + 2), corner(z)});
  for (int side = 0; side < 4; ++side) line({corner(side), corner(side + 4)});
}

void SymbolPen::cross(const Vector3& centre, double size) {
  for (int axis = 0; axis < 3; ++axis)
    line({centre - size * Vector3::Unit(axis), centre + size * Vector3::Unit(axis)});
}

void SymbolPen::arrow(const Vector3& from, const Vector3& way) {
  if (!(way.norm() > 4.0 * kThin)) return;
  overlay_.arrows.push_back({world_from_symbol_ * from, world_from_symbol_ * (from + way), kThin, colour_});
}

void SymbolPen::ball(const Vector3& centre, double radius) {
  overlay_.balls.push_back({world_from_symbol_ * centre, radius, colour_});
}

std::optional<PassedStroke> passed_strokes(const render::SceneOverlay& symbol, const interaction::Ray& ray) {
  std::optional<PassedStroke> best;
  for_each_stroke(symbol, [&](const Vector3& from, const Vector3& to, double radius) {
    const auto met = passed(ray, from, to, radius);
    if (met && (!best || met->off < best->off)) best = met;
  });
  return best;
}

double distance_to_strokes(const render::SceneOverlay& symbol, const Vector3& place) {
  double least = std::numeric_limits<double>::infinity();
  for_each_stroke(symbol, [&](const Vector3& from, const Vector3& to, double radius) {
    const Vector3 along = to - from;
    const double squared = along.squaredNorm();
    const double share = squared > 0.0 ? std::clamp((place - from).dot(along) / squared, 0.0, 1.0) : 0.0;
    const double distance = (place - from - share * along).norm() - radius;
    if (distance < least) least = std::max(0.0, distance);  // no number where a line is parted
  });
  return least;
}

bool is_shown_in(const world::World& world, world::SceneId scene, world::ObjectId id) {
  const world::Scene* const shown = world.find(scene);
  if (!shown) return true;
  for (const world::PhysicalObject* object = world.find(id); object;
       id = object->parent, object = world.find(id))
    if (std::ranges::find(shown->roots, id) != shown->roots.end()) return true;
  return false;
}

}  // namespace icome::session
