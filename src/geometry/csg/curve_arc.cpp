#include "geometry/csg/curve_arc.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace icome::geometry {
namespace {

constexpr int kCount = CurveArc::kDegree + 1;
constexpr int kMostParts = 160;    // parts of an arc that one sweep looks at before it traces those left
constexpr int kMostWaiting = 64;   // of them in store: one for each halving
constexpr int kMostTraced = 48;    // steps of a trace
constexpr int kMaxDescent = 32;    // steps downhill along an arc
constexpr double kArcShare = 0.1;  // of the slack: errors that are neglected

/// The first t >= 0 at which start + t step is within `reach` of the segment from `a` to `b`: a convex body,
/// the union of a cylinder and two balls, so the first of their own.
std::optional<double> capsule_hit(const Vector3& a, const Vector3& b, double reach, const Vector3& start,
                                  const Vector3& step) {
  double first = std::numeric_limits<double>::infinity();
  const auto enter = [&](double squared, double half, double constant) {
    if (constant <= 0.0) return std::optional(0.0);
    const double discriminant = half * half - squared * constant;
    if (half >= 0.0 || discriminant < 0.0) return std::optional<double>();
    return std::optional(constant / (std::sqrt(discriminant) - half));
  };
  for (const Vector3& end : {a, b}) {
    const Vector3 off = start - end;
    const auto t = enter(step.squaredNorm(), off.dot(step), off.squaredNorm() - reach * reach);
    if (t) first = std::min(first, *t);
  }
  const Vector3 chord = b - a;
  if (const double length = chord.norm(); length > 0.0) {
    const Vector3 axis = chord / length;
    const Vector3 off = start - a;
    const Vector3 away = off - axis.dot(off) * axis, along = step - axis.dot(step) * axis;
    if (const auto t = enter(along.squaredNorm(), away.dot(along), away.squaredNorm() - reach * reach)) {
      const double height = axis.dot(off + *t * step);
      if (height >= 0.0 && height <= length) first = std::min(first, *t);
    }
  }
  return first <= 1.0 ? std::optional(first) : std::nullopt;
}

}  // namespace

double CurveArc::node(int index) { return std::cos(std::numbers::pi * (index + 0.5) / kCount); }

CurveArc::CurveArc(const Places& at_nodes) {
  terms_.fill(Vector3::Zero());
  // Chebyshev's coefficients, turned into those of powers as the polynomials are made, one from two others.
  std::array<double, kCount> before{}, now{1.0};
  for (int k = 0; k < kCount; ++k) {
    Vector3 coefficient = Vector3::Zero();
    for (int j = 0; j < kCount; ++j)
      coefficient += std::cos(std::numbers::pi * k * (j + 0.5) / kCount) * at_nodes[j];
    coefficient *= (k == 0 ? 1.0 : 2.0) / kCount;
    for (int i = 0; i <= k; ++i) terms_[i] += now[i] * coefficient;
    std::array<double, kCount> next{};
    for (int i = 0; i + 1 < kCount; ++i) next[i + 1] = (k == 0 ? 1.0 : 2.0) * now[i];
    for (int i = 0; i < kCount; ++i) next[i] -= before[i];
    before = now;
    now = next;
  }
  bend_ = 0.0;
  for (int k = 2; k < kCount; ++k) bend_ += k * (k - 1) * terms_[k].norm();
}

CurveArc::CurveArc(const Vector3& from, const Vector3& to) : bend_(0.0) {
  terms_.fill(Vector3::Zero());
  terms_[0] = 0.5 * (from + to);
  terms_[1] = 0.5 * (to - from);
}

CurveArc CurveArc::part(double first, double last) const {
  CurveArc result = *this;
  result.first_ = first;
  result.last_ = last;
  return result;
}

Vector3 CurveArc::at(double s) const {
  Vector3 sum = terms_[kDegree];
  for (int k = kDegree; k-- > 0;) sum = s * sum + terms_[k];
  return sum;
}

Bounds CurveArc::bounds() const {
  Bounds box(at(first_));
  box.extend(at(last_));
  const Vector3 margin = Vector3::Constant(sagitta());
  return {box.min() - margin, box.max() + margin};
}

// Newton's method on the squared distance, where that is convex; else downhill. Never uphill, never beyond
// the ends.
double CurveArc::nearest(const Vector3& point, double from) const {
  double s = std::clamp(from, first_, last_);
  double squared = (at(s) - point).squaredNorm();
  for (int i = 0; i < kMaxDescent; ++i) {
    Vector3 place = terms_[kDegree], slope = Vector3::Zero(), bend = Vector3::Zero();
    for (int k = kDegree; k-- > 0;) {
      bend = s * bend + 2.0 * slope;
      slope = s * slope + place;
      place = s * place + terms_[k];
    }
    const Vector3 off = place - point;
    const double down = -off.dot(slope), speed = slope.squaredNorm();
    if (speed <= 0.0) return s;
    const double curved = std::max(speed + off.dot(bend), 0.1 * speed);
    double next = std::clamp(s + down / curved, first_, last_);
    if (next == s) return s;
    double there = (at(next) - point).squaredNorm();
    while (there > squared && std::abs(next - s) > 1e-9) {
      next = 0.5 * (s + next);
      there = (at(next) - point).squaredNorm();
    }
    if (std::abs(next - s) <= 1e-15) return next;
    if (there > squared) return s;
    s = next;
    squared = there;
  }
  return s;
}

double CurveArc::nearest(const Vector3& point) const {
  double best = first_, least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 4; ++i) {
    const double s = first_ + 0.25 * i * (last_ - first_);
    const double squared = (at(s) - point).squaredNorm();
    if (squared >= least) continue;
    least = squared;
    best = s;
  }
  return nearest(point, best);
}

double CurveArc::least_distance(const Vector3& a, const Vector3& b) const {
  return segment_distance(a, b, at(first_), at(last_)) - sagitta();
}

/// A part of an arc, between two parameters.
struct CurveArc::Part {
  double from, to;
  Vector3 begin, end;  // the places there
};

/// Advances from `t`, where the ball is clear of the part, to its touch, or at most to `last`: the distance
/// to each place changes no faster than the angle to it allows. For balls that meet a whole part at once,
/// such as one that drops into a ring, where halving finds no end.
double CurveArc::traced(const Part& part, double radius, const Vector3& start, const Vector3& step, double t,
                        double last, double slack) const {
  const CurveArc arc = this->part(part.from, part.to);
  const double width = 0.5 * (part.end - part.begin).norm() + arc.sagitta();
  for (int i = 0; i < kMostTraced && t < last; ++i) {
    const Vector3 centre = start + t * step;
    const double distance = (arc.at(arc.nearest(centre)) - centre).norm();
    const double clear = distance - radius;
    if (clear <= kArcShare * slack) break;
    const double slope =
        std::min((centre - part.begin).normalized().dot(step), (centre - part.end).normalized().dot(step)) -
        step.norm() * std::min(2.0, width / distance);
    if (slope >= 0.0) return last;
    t += clear / std::min(-slope, step.norm());
  }
  return std::min(t, last);
}

// Halves the arc wherever the ball meets a capsule around the chord of a part, until the capsules are as thin
// as the slack. Parts that the centre goes away from throughout are left out: a ball clear of them stays so.
std::optional<CurveArc::Touch> CurveArc::first_touch(double radius, const Vector3& start, const Vector3& step,
                                                     double slack) const {
  std::array<Part, kMostWaiting> waiting;
  std::size_t count = 0;
  waiting[count++] = {first_, last_, at(first_), at(last_)};
  std::optional<Touch> best;
  const double length = step.norm();
  for (int looks = 0; count > 0; ++looks) {
    const Part part = waiting[--count];
    const double stray = sagitta(part.from, part.to);
    const double nearest_ahead = std::max(part.begin.dot(step), part.end.dot(step)) + stray * length;
    if (nearest_ahead <= start.dot(step)) continue;
    const auto meets = capsule_hit(part.begin, part.end, radius + stray, start, step);
    const double latest = best ? best->t : std::nextafter(1.0, 2.0);
    if (!meets || *meets >= latest) continue;
    double t = *meets;
    const bool thin = stray <= kArcShare * slack;
    if (thin || looks >= kMostParts || count + 2 > kMostWaiting) {
      if (!thin) t = traced(part, radius, start, step, t, latest, slack);
      if (t >= latest) continue;
      const CurveArc arc = this->part(part.from, part.to);
      const double s = arc.nearest(start + t * step);
      // At the start a ball that rests on the arc may leave.
      if (t == 0.0 && (start - at(s)).dot(step) >= 0.0) continue;
      best = Touch{t, s};
      continue;
    }
    const double middle = 0.5 * (part.from + part.to);
    const Part lower{part.from, middle, part.begin, at(middle)}, upper{middle, part.to, lower.end, part.end};
    const Vector3 there = start + t * step;
    const bool lower_first = (there - part.begin).squaredNorm() <= (there - part.end).squaredNorm();
    waiting[count++] = lower_first ? upper : lower;
    waiting[count++] = lower_first ? lower : upper;
  }
  return best;
}

double segment_distance(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const Vector3 u = b - a, v = d - c, w = a - c;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double denominator = uu * vv - uv * uv;
  double s = denominator > 0.0 ? std::clamp((uv * vw - vv * uw) / denominator, 0.0, 1.0) : 0.0;
  double t = vv > 0.0 ? (uv * s + vw) / vv : 0.0;
  if (t < 0.0 || t > 1.0 || vv <= 0.0) {
    t = std::clamp(t, 0.0, 1.0);
    s = uu > 0.0 ? std::clamp((uv * t - uw) / uu, 0.0, 1.0) : 0.0;
  }
  return (w + s * u - t * v).norm();
}

}  // namespace icome::geometry
