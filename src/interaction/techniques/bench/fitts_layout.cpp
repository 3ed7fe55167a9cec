#include "interaction/techniques/bench/fitts_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace icome::interaction {
namespace {

constexpr double kClearance = 1.1;  // of a size, between the centres of two balls

double distance_to_segment(const Vector3& point, const Vector3& start, const Vector3& end) {
  const Vector3 way = end - start;
  const double along = std::clamp((point - start).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (point - start - along * way).norm();
}

std::vector<Vector3> ring_centres(const FittsCondition& condition, const Vector3& eyes) {
  constexpr double kLowered = 0.1;  // m, below the eyes
  const double lean = std::numbers::pi / 6.0;
  const Vector3 middle = eyes + Vector3(0.0, -kLowered, -condition.distance);
  const Vector3 up(0.0, std::cos(lean), std::sin(lean));
  std::vector<Vector3> centres;
  for (int i = 0; i < kRingTargets; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRingTargets;
    centres.emplace_back(middle + 0.5 * kRingShare * condition.distance *
                                      (std::cos(angle) * up + std::sin(angle) * Vector3::UnitX()));
  }
  return centres;
}

/// May a distractor stand there?
bool has_room(const Vector3& place, const std::vector<Vector3>& balls, double size, const Vector3& eyes,
              const Vector3& hand) {
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if ((balls[i] - place).norm() < kClearance * size) return false;
    if (i >= kRingTargets) continue;
    if (distance_to_segment(place, eyes, balls[i]) < size) return false;
    if (distance_to_segment(place, hand, balls[i]) < size) return false;
  }
  return true;
}

}  // namespace

FittsLayout fitts_layout(const FittsCondition& condition, const Vector3& eyes, const Vector3& hand,
                         base::Random& random) {
  constexpr int kTries = 40;                          // for each distractor, where there is little room
  constexpr double kNearest = 1.25, kFarthest = 3.0;  // sizes from the target
  std::vector<Vector3> balls = ring_centres(condition, eyes);
  for (std::size_t target = 0; target < kRingTargets; ++target) {
    int placed = 0;
    for (int i = 0; i < kTries * condition.distractors && placed < condition.distractors; ++i) {
      const double away = condition.size * random.uniform(kNearest, kFarthest);
      const Vector3 place = balls[target] + away * random.direction();
      if (!has_room(place, balls, condition.size, eyes, hand)) continue;
      balls.push_back(place);
      ++placed;
    }
  }
  FittsLayout layout;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    SceneTarget target;
    target.id = i + 1;
    target.world_from_target.translation() = balls[i];
    target.radius = 0.5 * condition.size;
    (void)layout.scene.add(target);
  }
  // Half way round and one less, so that all are visited.
  for (int i = 0; i < kRingTargets; ++i)
    layout.order.push_back(TargetId(i * (kRingTargets / 2) % kRingTargets + 1));
  return layout;
}

}  // namespace icome::interaction
