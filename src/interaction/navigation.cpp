#include "interaction/navigation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace icome::interaction {
namespace {

using base::Matrix3;
using base::Quaternion;
using std::numbers::pi;

// The least and the greatest distance of view, m: from a part of the smallest primitive to the Moon.
constexpr double kNearest = 1e-10;
constexpr double kFarthest = 1e9;
constexpr double kMostShift = 100.0;  // a tangent

/// The value clamped to its range; `otherwise` where it is not finite.
double within(double value, double least, double most, double otherwise) {
  return std::isfinite(value) ? std::clamp(value, least, most) : otherwise;
}

double finite(double value) { return std::isfinite(value) ? value : 0.0; }

/// The angle (rad) wrapped to half a turn either way; 0 where it is not finite.
double wrapped(double angle) { return std::isfinite(angle) ? std::remainder(angle, 2.0 * pi) : 0.0; }

double sane_aspect(double aspect) { return within(aspect, 1e-3, 1e3, 1.0); }

bool reachable(const Vector3& position, double distance) {
  return position.allFinite() && position.cwiseAbs().maxCoeff() <= kFarthest && distance >= kNearest &&
         distance <= kFarthest;
}

Matrix3 about_y(double angle) { return Eigen::AngleAxisd(angle, Vector3::UnitY()).toRotationMatrix(); }

Matrix3 about_x(double angle) { return Eigen::AngleAxisd(angle, Vector3::UnitX()).toRotationMatrix(); }

/// The nearest rotation, so that rounding does not add up over the many turns of a day.
Matrix3 rigid(const Matrix3& rotation) { return Quaternion(rotation).normalized().toRotationMatrix(); }

/// Elevation of the eye above the point looked at, rad: beyond a quarter turn it is upside down.
double elevation(const Matrix3& rotation) { return std::atan2(rotation(1, 2), rotation(1, 1)); }

/// Direction of the picture's right, rad from +x about +y.
double heading(const Matrix3& rotation) { return std::atan2(-rotation(2, 0), rotation(0, 0)); }

/// Is the picture's right on the horizon, and its up not down?
bool is_level(const Matrix3& rotation) {
  constexpr double kRounding = 1e-9;
  return std::abs(rotation(1, 0)) < kRounding && rotation(1, 1) > -kRounding;
}

/// The rotation turned to the left about the vertical, and so that the eye would rise. Never over a pole; an
/// eye that is over one already can only come back.
Matrix3 turned(const Matrix3& rotation, double left, double rise) {
  const double now = elevation(rotation);
  const double limit = std::max(0.5 * pi, std::abs(now));
  const double then = std::clamp(now + finite(rise), -limit, limit);
  // Upside down, left in the picture is right in the world; a pole itself is not upside down.
  const double sense = std::abs(now) > 0.5 * pi + 1e-9 ? -1.0 : 1.0;
  return rigid(about_y(sense * wrapped(left)) * rotation * about_x(now - then));
}

/// The view moved there, or unchanged where that is out of reach.
View placed(const View& view, const Matrix3& rotation, const Vector3& eye, double distance) {
  if (!reachable(eye, distance)) return view;
  View result = view;
  result.world_from_eye.linear() = rotation;
  result.world_from_eye.translation() = eye;
  result.distance = distance;
  return result;
}

/// The axes of an eye (columns: right, up, back) that looks from there; `right` helps out where up and that
/// direction are the same.
Matrix3 eye_axes(const Vector3& toward_eye, const Vector3& up, const Vector3& right) {
  const bool from_somewhere = toward_eye.allFinite() && toward_eye.cwiseAbs().maxCoeff() > 0.0;
  // stableNormalized: neither tiny nor huge vectors lose their direction.
  const Vector3 back = from_somewhere ? toward_eye.stableNormalized() : Vector3::UnitZ();
  const Vector3 upright = up.allFinite() ? up.stableNormalized() : Vector3::UnitY();
  constexpr double kSame = 1e-6;
  Vector3 x = upright.cross(back);
  if (x.norm() < kSame) x = right - right.dot(back) * back;
  if (x.norm() < kSame) x = back.unitOrthogonal();
  x.normalize();
  Matrix3 axes;
  axes << x, back.cross(x), back;
  return axes;
}

/// Distance (m) from which an eye that looks at the box's centre sees all its corners.
double fit_distance(const Vector3& sizes, const Matrix3& axes, const Eigen::Vector2d& half_picture) {
  double distance = 0.0, nearest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 signs(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5);
    const Vector3 at = axes.transpose() * sizes.cwiseProduct(signs);
    nearest = std::max(nearest, at.z());
    const Eigen::Vector2d needed = at.head<2>().cwiseAbs().cwiseQuotient(half_picture);
    distance = std::max(distance, at.z() + needed.maxCoeff());
  }
  // A sheet or rod seen edge-on needs no room, but the eye must not lie on it.
  constexpr double kClear = 0.05;  // of the size
  return std::max(distance, nearest + kClear * sizes.norm());
}

}  // namespace

View usable(const View& view) {
  View result = view;
  const View standard;
  result.field = within(view.field, 0.05, 2.5, standard.field);
  result.distance = within(view.distance, kNearest, kFarthest, standard.distance);
  for (double& it : result.shift) it = within(it, -kMostShift, kMostShift, 0.0);
  const Vector3 eye = view.world_from_eye.translation();
  result.world_from_eye.translation() = eye.allFinite()
                                            ? Vector3(eye.cwiseMax(-kFarthest).cwiseMin(kFarthest))
                                            : Vector3(standard.world_from_eye.translation());
  const Matrix3 linear = view.world_from_eye.linear();
  if (!linear.isUnitary(1e-6) || linear.determinant() < 0.0) {
    const Matrix3 nearest = rigid(linear);
    result.world_from_eye.linear() = nearest.isUnitary(1e-6) ? nearest : Matrix3::Identity();
  }
  result.world_from_eye.makeAffine();
  return result;
}

Eigen::Vector2d half_picture(const View& view, double aspect) {
  const double shorter = std::tan(0.5 * usable(view).field);
  const double shape = sane_aspect(aspect);
  return {shorter * std::max(1.0, shape), shorter * std::max(1.0, 1.0 / shape)};
}

Ray ray_through(const View& view, double x, double y, double aspect) {
  const Eigen::Vector2d half = half_picture(view, aspect);
  const View from = usable(view);
  const Vector3 direction(from.shift.x() + half.x() * within(x, -1e3, 1e3, 0.0),
                          from.shift.y() + half.y() * within(y, -1e3, 1e3, 0.0), -1.0);
  return {from.world_from_eye.translation(), from.world_from_eye.linear() * direction.normalized()};
}

Vector3 looked_at(const View& view) {
  return view.world_from_eye * (view.distance * Vector3(view.shift.x(), view.shift.y(), -1.0));
}

bool is_same_view(const View& one, const View& other) {
  return one.world_from_eye.matrix() == other.world_from_eye.matrix() && one.field == other.field &&
         one.distance == other.distance && one.shift == other.shift;
}

View orbited(const View& view, double right, double up) {
  const View from = usable(view);
  const Matrix3 rotation = turned(from.world_from_eye.linear(), right, up);
  return placed(from, rotation, looked_at(from) + from.distance * rotation.col(2), from.distance);
}

View looked_around(const View& view, double right, double up) {
  const View from = usable(view);
  // Looking up lowers the place that an eye going round would take.
  const Matrix3 rotation = turned(from.world_from_eye.linear(), -right, -up);
  return placed(from, rotation, from.world_from_eye.translation(), from.distance);
}

View panned(const View& view, double right, double up) {
  const View from = usable(view);
  const double picture = 2.0 * std::tan(0.5 * from.field) * from.distance;
  const Vector3 step(-picture * finite(right), -picture * finite(up), 0.0);
  return placed(from, from.world_from_eye.linear(), from.world_from_eye * step, from.distance);
}

View zoomed(const View& view, double factor, const Vector3& towards) {
  const View from = usable(view);
  if (!std::isfinite(factor) || factor <= 0.0 || !towards.allFinite()) return from;
  const Vector3 eye = from.world_from_eye.translation();
  return placed(from, from.world_from_eye.linear(), towards + factor * (eye - towards),
                factor * from.distance);
}

View flown(const View& view, const devices::NavigationState& state, double dt) {
  const View from = usable(view);
  if (!std::isfinite(dt) || dt <= 0.0 || !state.push.allFinite() || !state.turn.allFinite()) return from;
  const auto axes = [](const Vector3& it) { return Vector3(it.cwiseMax(-1.0).cwiseMin(1.0)); };
  const Vector3 step = from.distance * dt * axes(state.push);
  const Vector3 turn = 0.5 * pi * dt * axes(state.turn);
  const View moved = placed(from, from.world_from_eye.linear(), from.world_from_eye * step, from.distance);
  return looked_around(moved, -turn.y(), turn.x());
}

View fitted(const View& view, const Bounds& bounds, const Vector3& toward_eye, const Vector3& up,
            double aspect) {
  constexpr double kRoom = 0.92;  // of the picture, for what is looked at
  const View from = usable(view);
  const Matrix3 axes = eye_axes(toward_eye, up, from.world_from_eye.linear().col(0));
  const Eigen::Vector2d picture = kRoom * half_picture(from, aspect);
  Vector3 centre = Vector3::Zero();
  double distance = 0.0;
  if (bounds.isEmpty() || !bounds.sizes().allFinite()) {
    const double shorter = picture.minCoeff();
    distance = 0.1 * std::hypot(1.0, shorter) / shorter;  // a ball of 0.1 m touches the picture's edge
  } else {
    centre = bounds.center();
    distance = fit_distance(bounds.sizes(), axes, picture);
  }
  if (distance <= 0.0) distance = from.distance;
  distance = std::clamp(distance, kNearest, kFarthest);
  return placed(from, axes, centre + distance * axes.col(2), distance);
}

ViewFlight::ViewFlight(const View& from, const View& to, double seconds)
    : from_(usable(from)),
      to_(usable(to)),
      seconds_(seconds > 0.0 && std::isfinite(seconds) ? seconds : 0.0) {}

// The path of equal optical speed, with the paper's names: u the way along, w the width of the view; both as
// a distance at which the picture is that wide.
ViewFlight::Stage ViewFlight::stage(double progress) const {
  const double w0 = from_.distance;
  const double w1 = to_.distance;
  const double width = 2.0 * std::tan(0.5 * std::min(from_.field, to_.field));
  const double u1 = (looked_at(to_) - looked_at(from_)).norm() / width;
  constexpr double kRho = 1.4;  // preference for stepping back over going sideways
  constexpr double kRho2 = kRho * kRho;
  constexpr double kStraight = 1e-6;  // sideways so little that the formulas would lose their digits
  if (u1 < kStraight * std::min(w0, w1)) return {progress, w0 * std::pow(w1 / w0, progress)};
  // r = ln(sqrt(b^2 + 1) - b), as the paper has it, loses all digits of a large b; -asinh(b) does not.
  const double rise = (w1 - w0) * (w1 + w0) + kRho2 * kRho2 * u1 * u1;
  const double fall = (w1 - w0) * (w1 + w0) - kRho2 * kRho2 * u1 * u1;
  const double r0 = -std::asinh(rise / (2.0 * w0 * kRho2 * u1));
  const double r1 = -std::asinh(fall / (2.0 * w1 * kRho2 * u1));
  const double r = std::lerp(r0, r1, progress);
  const double distance = w0 * std::cosh(r0) / std::cosh(r);
  // tanh r - tanh r0, as one quotient.
  const double way = w0 / kRho2 * std::sinh(r - r0) / std::cosh(r);
  return {std::clamp(way / u1, 0.0, 1.0), distance};
}

View ViewFlight::at(double time) const {
  if (over(time)) return to_;
  const double t = std::clamp(time / seconds_, 0.0, 1.0);
  const double progress = t * t * t * (t * (6.0 * t - 15.0) + 10.0);  // speed and acceleration start at 0
  const Matrix3 start = from_.world_from_eye.linear();
  const Matrix3 end = to_.world_from_eye.linear();
  Matrix3 rotation;
  if (is_level(start) && is_level(end)) {  // and stays so on the way, which a turn about one axis does not
    const double turn = wrapped(heading(end) - heading(start));
    const double height = std::lerp(elevation(start), elevation(end), progress);
    rotation = about_y(heading(start) + progress * turn) * about_x(-height);
  } else {
    rotation = Quaternion(start).slerp(progress, Quaternion(end)).normalized().toRotationMatrix();
  }
  View view = to_;
  const Stage now = stage(progress);
  const Vector3 centre = looked_at(from_) + now.along * (looked_at(to_) - looked_at(from_));
  view.field = std::lerp(from_.field, to_.field, progress);
  return usable(placed(view, rotation, centre + now.distance * rotation.col(2), now.distance));
}

}  // namespace icome::interaction
