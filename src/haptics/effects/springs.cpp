#include "haptics/effects/springs.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace icome::haptics {
namespace {

Vector3 without_component(const Vector3& vector, const Vector3& unit) {
  return vector - vector.dot(unit) * unit;
}

// The point of a segment nearest to `position`, and the unit direction in which the tip may slide there
// (zero at an end, where it is held on all sides).
struct Foot {
  Vector3 point;
  Vector3 slide;
};

Foot nearest_on_segment(const Vector3& from, const Vector3& to, const Vector3& position) {
  const Vector3 along = to - from;
  const double squared = along.squaredNorm();
  if (squared <= 0.0) return {from, Vector3::Zero()};
  const double t = (position - from).dot(along) / squared;
  if (t <= 0.0) return {from, Vector3::Zero()};
  if (t >= 1.0) return {to, Vector3::Zero()};
  return {from + t * along, along.normalized()};
}

}  // namespace

Vector3 Spring::pull(const Vector3& offset, const Vector3& resisted, const EffectInput& input) const {
  const double stiffness = stable_stiffness(input.device_mass, input.dt, settings_.stiffness);
  const double damping = stable_damping(stiffness, input.device_mass, input.dt, settings_.damping);
  return stiffness * offset - damping * resisted;
}

Vector3 PointSpring::force(const EffectInput& input) {
  return pull(point_ - input.position, input.velocity, input);
}

LineSpring::LineSpring(const Vector3& point, const Vector3& direction, const SpringSettings& settings)
    : Spring(settings), point_(point), direction_(direction.normalized()) {
  assert(direction.squaredNorm() > 0.0);
}

Vector3 LineSpring::force(const EffectInput& input) {
  return pull(without_component(point_ - input.position, direction_),
              without_component(input.velocity, direction_), input);
}

PlaneSpring::PlaneSpring(const Vector3& point, const Vector3& normal, const SpringSettings& settings)
    : Spring(settings), point_(point), normal_(normal.normalized()) {
  assert(normal.squaredNorm() > 0.0);
}

Vector3 PlaneSpring::force(const EffectInput& input) {
  const double offset = (point_ - input.position).dot(normal_);
  return pull(offset * normal_, input.velocity.dot(normal_) * normal_, input);
}

CurveSpring::CurveSpring(std::vector<Vector3> points, const SpringSettings& settings)
    : Spring(settings), points_(std::move(points)) {
  assert(!points_.empty());
}

Vector3 CurveSpring::force(const EffectInput& input) {
  Foot best{points_.front(), Vector3::Zero()};
  double least = (best.point - input.position).squaredNorm();
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const Foot foot = nearest_on_segment(points_[i - 1], points_[i], input.position);
    const double squared = (foot.point - input.position).squaredNorm();
    if (squared < least) {
      least = squared;
      best = foot;
    }
  }
  return pull(best.point - input.position, without_component(input.velocity, best.slide), input);
}

}  // namespace icome::haptics
