#include "interaction/techniques/technique_scene.h"

#include <fmt/format.h>

#include <cmath>

#include "base/decompositions.h"

namespace icome::interaction {
namespace {

bool is_target_place(const base::Affine3& place) {
  constexpr double kFarthestTarget = 1e9;  // m
  return place.matrix().allFinite() && place.matrix().cwiseAbs().maxCoeff() <= kFarthestTarget &&
         std::abs(place.linear().determinant()) > 0.0;
}

double longest_stretch(const base::Affine3& place) { return base::singular_values(place.linear()).values[0]; }

/// Distance along the ray at which it meets the ball, m: at its far side from within it.
std::optional<double> ball_hit(const TargetBall& ball, const Ray& ray) {
  const Vector3 way = ball.centre - ray.origin;
  const double along = way.dot(ray.direction);
  const double aside = (way - along * ray.direction).squaredNorm();
  const double square = ball.radius * ball.radius - aside;
  if (square < 0.0) return std::nullopt;
  const double half_chord = std::sqrt(square);
  if (along + half_chord < 0.0) return std::nullopt;
  return along - half_chord >= 0.0 ? along - half_chord : along + half_chord;
}

}  // namespace

TargetBall ball_of(const SceneTarget& target) {
  return {target.world_from_target * target.centre,
          target.radius * longest_stretch(target.world_from_target)};
}

base::Result<void> TechniqueScene::add(const SceneTarget& target) {
  if (target.id == 0) return base::fail("a target needs a number that is not 0.");
  if (places_.contains(target.id))
    return base::fail(fmt::format("there are two targets of number {}; give each its own.", target.id));
  const TargetBall ball = is_target_place(target.world_from_target) ? ball_of(target) : TargetBall{};
  if (!target.centre.allFinite() || !(target.radius > 0.0) || !(ball.radius > 0.0) ||
      !std::isfinite(ball.radius) || !ball.centre.allFinite())
    return base::fail(fmt::format("target {} has no size or no place; give it both.", target.id));
  places_.emplace(target.id, targets_.size());
  targets_.push_back(target);
  balls_.push_back(ball);
  return {};
}

bool TechniqueScene::move(TargetId id, const base::Affine3& world_from_target) {
  const auto place = places_.find(id);
  if (place == places_.end() || !is_target_place(world_from_target)) return false;
  SceneTarget moved = targets_[place->second];
  moved.world_from_target = world_from_target;
  const TargetBall ball = ball_of(moved);
  if (!ball.centre.allFinite() || !(ball.radius > 0.0)) return false;
  targets_[place->second] = moved;
  balls_[place->second] = ball;
  return true;
}

const SceneTarget* TechniqueScene::find(TargetId id) const {
  const auto place = places_.find(id);
  return place == places_.end() ? nullptr : &targets_[place->second];
}

base::Bounds TechniqueScene::bounds() const {
  base::Bounds bounds;
  for (const TargetBall& ball : balls_) {
    bounds.extend(Vector3(ball.centre.array() - ball.radius));
    bounds.extend(Vector3(ball.centre.array() + ball.radius));
  }
  return bounds;
}

std::optional<TechniqueScene::Found> TechniqueScene::nearest(const Vector3& point, double limit) const {
  std::optional<Found> found;
  double least = limit;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const double to_ball = (point - balls_[i].centre).norm() - balls_[i].radius;
    if (found ? to_ball >= least : to_ball > least) continue;
    double distance = to_ball;
    if (targets_[i].shape)
      distance = targets_[i].shape->distance(targets_[i].world_from_target, point, least);
    if (found ? distance >= least : distance > least) continue;
    least = distance;
    found = Found{targets_[i].id, distance};
  }
  return found;
}

std::optional<TechniqueScene::Found> TechniqueScene::first_hit(const Ray& ray) const {
  std::optional<Found> found;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    std::optional<double> hit = ball_hit(balls_[i], ray);
    if (hit && targets_[i].shape) hit = targets_[i].shape->first_hit(targets_[i].world_from_target, ray);
    if (hit && (!found || *hit < found->distance)) found = Found{targets_[i].id, *hit};
  }
  return found;
}

std::vector<TechniqueScene::Lit> TechniqueScene::lit_by(const SelectionCone& cone) const {
  std::vector<Lit> lit;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (!cone_meets_ball(cone, balls_[i].centre, balls_[i].radius)) continue;
    if (targets_[i].shape && !targets_[i].shape->meets(targets_[i].world_from_target, cone)) continue;
    lit.push_back(
        {targets_[i].id, off_axis(cone, balls_[i].centre), cone.direction.dot(balls_[i].centre - cone.apex)});
  }
  return lit;
}

}  // namespace icome::interaction
