#include "geometry/implicit/implicit_walk.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "geometry/implicit/formula_allowance.h"

namespace icome::geometry {
namespace {

using base::Vector2;
using base::Vector3;
using TangentFrame = Eigen::Matrix<double, 3, 2>;

// Parts of the size up to which lengths count as nothing: rounding is some 1e-16 of it, contact
// arithmetic's slack some 1e-11.
constexpr double kExact = 1e-13;
constexpr double kOnIt = 1e-12;
constexpr double kNear = 1e-9;
constexpr double kUpright = 1e-6;  // sine of the angle between pull and normal up to which a place is a foot
constexpr int kMostLegs = 14;
constexpr int kFewLegs = 2;  // that are walked in any case
constexpr int kMostWalkSteps = 8;
constexpr int kSheetHalvings = 3;  // of ways that are not certain at once
// Legs are shortened by this factor until they are sure, and given up when they are that much shorter than
// the size.
constexpr double kShorter = 0.25;
constexpr double kBack = 0.4;  // of the last step: the most that the next goes back

/// Two unit vectors that are orthogonal to `normal` and to each other.
TangentFrame tangents(const Vector3& normal) {
  TangentFrame frame;
  frame.col(0) = normal.unitOrthogonal();
  frame.col(1) = normal.cross(frame.col(0));
  return frame;
}

/// A step of Newton's method for the nearest place to `goal` on the surface.
struct NewtonStep {
  Vector3 step;
  double length;       // along the surface
  double error_after;  // m, estimated
  bool curbed;         // shortened, or only downhill as no minimum is near
};

NewtonStep newton_step(const Formula::Bend& at, const Vector3& point, const Vector3& goal, double reach) {
  const double steepness = at.gradient.norm();
  const Vector3 normal = at.gradient / steepness;
  const TangentFrame frame = tangents(normal);
  const Vector3 pull = goal - point;
  const double above = pull.dot(normal);
  const double sink = -at.value / steepness;
  const base::Matrix3 bend = at.hessian / steepness;
  const Eigen::Matrix2d curvature = frame.transpose() * bend * frame;
  // The Hessian of distance^2 / 2 along the surface, and its slope where the surface will be met.
  const Eigen::Matrix2d hessian = Eigen::Matrix2d::Identity() + above * curvature;
  const Vector2 slope = frame.transpose() * (pull - above * sink * (bend * normal));
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(hessian);
  // A distance that curves downwards has no minimum near: any step downhill will do.
  constexpr double kFlattest = 0.02;
  const Vector2 bending = axes.eigenvalues().cwiseAbs().cwiseMax(kFlattest);
  const bool downhill_only = axes.eigenvalues().minCoeff() < kFlattest;
  const Vector2 turned = (axes.eigenvectors().transpose() * slope).cwiseQuotient(bending);
  Vector2 along = axes.eigenvectors() * turned;
  const double steepest_curve = curvature.norm();
  const double most = std::min(reach, steepest_curve > 0.0 ? 0.5 / steepest_curve : reach);
  const double wanted = along.norm();
  const bool too_long = wanted > most;
  if (too_long) along *= most / wanted;
  const double drop = -0.5 * along.dot(curvature * along);  // the fall of the surface over the step
  const double length = along.norm();
  return {frame * along + (sink + drop) * normal, length,
          steepest_curve * (length * length + sink * sink) / bending.minCoeff(), too_long || downhill_only};
}

bool is_usable(const Formula::Bend& at) {
  const double square = at.gradient.squaredNorm();
  return std::isfinite(at.value) && square > 0.0 && std::isfinite(square) && at.hessian.allFinite();
}

/// Does the goal lie straight above or below? Rounding keeps some walks from seeing that they have arrived.
bool is_upright(const ImplicitWalk::Place& place, const Vector3& goal, double size) {
  const Vector3 pull = goal - place.point;
  const Vector3 along = pull - pull.dot(place.normal) * place.normal;
  return along.norm() <= kUpright * pull.norm() + kNear * size;
}

}  // namespace

std::optional<Vector3> ImplicitWalk::normal(const Vector3& point) const {
  const Vector3 gradient = formula_.slope(point, time_).gradient;
  const double steepness = gradient.norm();
  if (!(steepness > 0.0) || !std::isfinite(steepness)) return std::nullopt;
  return gradient / steepness;
}

std::optional<ImplicitWalk::Place> ImplicitWalk::settle(const Vector3& point, double reach) const {
  Vector3 at = point;
  double last_height = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3 * kMostWalkSteps; ++i) {
    const Formula::Slope here = formula_.slope(at, time_);
    const double square = here.gradient.squaredNorm();
    if (!std::isfinite(here.value) || !(square > 0.0) || !std::isfinite(square)) return std::nullopt;
    const double steepness = std::sqrt(square);
    const double height = std::fabs(here.value) / steepness;
    const Vector3 next = at - here.value / square * here.gradient;
    if (height <= kExact * size_ || (height <= kNear * size_ && height > 0.5 * last_height)) {
      return Place{next, here.gradient / steepness};
    }
    last_height = height;
    at = next;
    if (!((at - point).squaredNorm() <= reach * reach)) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<ImplicitWalk::Leg> ImplicitWalk::leg(const Vector3& from, const Vector3& goal,
                                                   double reach) const {
  Vector3 at = from;
  Vector3 last = Vector3::Zero();
  double left = reach;
  for (int i = 0; i < kMostWalkSteps; ++i) {
    const Formula::Bend here = formula_.bend(at, time_);
    if (!is_usable(here)) return std::nullopt;
    // Half of what is left, so that something is left to go on beyond an edge.
    NewtonStep next = newton_step(here, at, goal, 0.5 * left);
    // On a surface that bends ever more, as of the power 1.5, Newton's method may go to and fro for ever.
    if (next.step.dot(last) < -0.5 * last.squaredNorm())
      next = newton_step(here, at, goal, std::min(0.5 * left, kBack * last.norm()));
    at += next.step;
    last = next.step;
    left -= next.length;
    // Beyond a crease the surface is not at the expected place.
    if (!next.curbed && next.error_after <= kExact * size_ &&
        std::fabs(formula_.value(at, time_)) <= kOnIt * size_ * here.gradient.norm()) {
      // The normal has turned by the last step only, which was short.
      const Vector3 turned = here.gradient + here.hessian * next.step;
      return Leg{{at, turned.normalized()}, true};
    }
    if (left <= 0.1 * reach) break;
  }
  const auto end = settle(at, reach);
  if (!end) return std::nullopt;
  return Leg{*end, false};
}

/// The decrease of the squared distance to `goal` from `from` to `to`.
double ImplicitWalk::gain(const Vector3& from, const Vector3& to, const Vector3& goal) const {
  return (from - to).dot(from + to - 2.0 * goal);
}

/// Are the places surely connected in a rectangle that holds both, upright on the way between them? They are
/// if f rises everywhere along `up` in it, and the surface can leave it neither above nor below.
bool ImplicitWalk::is_straight_on(const Place& from, const Place& to, const Vector3& up) const {
  const Vector3 way = to.point - from.point;
  const double rise = way.dot(up);
  const Vector3 level = way - rise * up;
  const double length = level.norm();
  if (!(length > kExact * size_)) return way.norm() <= kNear * size_;
  const Vector3 ahead = level / length;
  const double off = std::fabs(formula_.value(from.point, time_));
  double half_height = 0.25 * length + 2.0 * std::fabs(rise);
  for (int attempt = 0; attempt < 2; ++attempt) {
    const auto at =
        formula_.patch_range(from.point, ahead, up, {0.0, length}, {-half_height, half_height}, time_);
    const double steepness = at.slope[1].lo;
    if (!at.range.total || !(steepness > 0.0)) return false;
    const double needed = (off + magnitude(at.slope[0]) * length) / steepness;
    if (needed <= half_height) return true;
    if (needed > 3.0 * length) return false;
    half_height = 1.25 * needed;
  }
  return false;
}

/// Are the places surely on one sheet? Over long ways, this is shown by way of places in between.
bool ImplicitWalk::on_one_sheet(const Place& from, const Place& to, const Vector3& up, int halvings) const {
  if (is_straight_on(from, to, up)) return true;
  if (halvings == 0) return false;
  const double length = (to.point - from.point).norm();
  const auto middle = settle(0.5 * (from.point + to.point), 0.5 * length);
  if (!middle) return false;
  const auto mean = [](const Place& a, const Place& b) -> Vector3 {
    return (a.normal + b.normal).stableNormalized();
  };
  return on_one_sheet(from, *middle, mean(from, *middle), halvings - 1) &&
         on_one_sheet(*middle, to, mean(*middle, to), halvings - 1);
}

ImplicitWalk::Place ImplicitWalk::descend(const Vector3& from, const Vector3& goal) const {
  const double whole = size_ + (goal - from).norm();
  const auto start = settle(from, whole);
  if (!start) return {from, normal(from).value_or((from - goal).stableNormalized()), false};
  Place at = *start;
  double reach = whole;
  for (int i = 0; i < kMostLegs && reach > kExact * size_; ++i) {
    if (i >= kFewLegs && FormulaAllowance::spent()) break;
    // Rounding alone may seem to bring it closer or away.
    const double doubt = kExact * size_ * (at.point - goal).norm();
    const auto next = leg(at.point, goal, reach);
    if (next) {
      const double closer = gain(at.point, next->end.point, goal);
      if (closer > (next->arrived ? -doubt : doubt) &&
          on_one_sheet(at, next->end, (at.normal + next->end.normal).stableNormalized(), kSheetHalvings)) {
        reach = std::max(reach, 2.0 * (next->end.point - at.point).norm());
        at = next->end;
        if (next->arrived) return at;
        continue;
      }
    }
    Vector3 up;
    if (const auto along = crease_leg(at, goal, reach, up)) {
      const double closer = gain(at.point, along->end.point, goal);
      if (closer > (along->arrived ? -doubt : doubt) && on_one_sheet(at, along->end, up, kSheetHalvings)) {
        at = along->end;
        if (along->arrived) return at;
        continue;
      }
    }
    reach = kShorter * std::min(reach, next ? (next->end.point - at.point).norm() : reach);
  }
  at.reached = is_upright(at, goal, size_);
  return at;
}

}  // namespace icome::geometry
