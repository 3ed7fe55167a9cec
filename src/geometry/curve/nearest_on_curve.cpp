#include "geometry/curve/nearest_on_curve.h"

#include <algorithm>
#include <cmath>

namespace icome::geometry {
namespace {

/// A polynomial of degree 5 on an interval, as its Bernstein coefficients there: it has at most as many roots
/// inside as their signs change, and none where they do not.
struct Quintic {
  std::array<double, 6> c;
  double from;
  double to;

  int sign_changes() const {
    int changes = 0;
    double last = 0.0;
    for (const double value : c) {
      if (value == 0.0) continue;
      changes += last * value < 0.0 ? 1 : 0;
      last = std::copysign(1.0, value);
    }
    return changes;
  }

  double largest() const {
    double largest = 0.0;
    for (const double value : c) largest = std::max(largest, std::abs(value));
    return largest;
  }

  /// Halves the interval: this becomes the left half, the right one is returned.
  Quintic halve() {
    Quintic right = {c, 0.5 * (from + to), to};
    to = right.from;
    for (std::size_t level = 1; level < c.size(); ++level) {
      for (std::size_t i = 0; i + level < c.size(); ++i) right.c[i] = 0.5 * (right.c[i] + right.c[i + 1]);
      c[level] = right.c[0];
    }
    return right;
  }
};

/// (f(t) - point) . f'(t) / 3, whose roots thesis 4.10 asks for.
Quintic slope_of_distance(const CubicBezier& part, const Vector2& point, double from, double to) {
  const Vector2 d[4] = {part.points[0] - point, part.points[1] - point, part.points[2] - point,
                        part.points[3] - point};
  const Vector2 v[3] = {part.points[1] - part.points[0], part.points[2] - part.points[1],
                        part.points[3] - part.points[2]};
  // The product of Bernstein forms of degrees 3 and 2: binomials (3 over i)(2 over j) / (5 over i + j).
  return {{d[0].dot(v[0]), 0.4 * d[0].dot(v[1]) + 0.6 * d[1].dot(v[0]),
           0.1 * d[0].dot(v[2]) + 0.6 * d[1].dot(v[1]) + 0.3 * d[2].dot(v[0]),
           0.1 * d[3].dot(v[0]) + 0.6 * d[2].dot(v[1]) + 0.3 * d[1].dot(v[2]),
           0.4 * d[3].dot(v[1]) + 0.6 * d[2].dot(v[2]), d[3].dot(v[2])},
          from,
          to};
}

/// The first t between `low` and `high`, where the slope has different signs, to the last few bits: Newton's
/// steps where they stay inside, halving where they do not.
double root_between(const CubicBezier& curve, const Vector2& point, double low, double high, bool rising) {
  double t = 0.5 * (low + high);
  for (int step = 0; step < 60; ++step) {
    const Vector2 away = curve.at(t) - point;
    const Vector2 first = curve.derivative(t);
    const double slope = away.dot(first);
    ((slope > 0.0) == rising ? high : low) = t;
    const double steepness = first.squaredNorm() + away.dot(curve.second_derivative(t));
    const double next = t - slope / steepness;
    if (std::abs(next - t) <= 1e-15) return t;
    t = next > low && next < high ? next : 0.5 * (low + high);
  }
  return t;
}

/// Searches the roots of an interval that is halved until each has at most one.
class RootSearch {
 public:
  RootSearch(const CubicBezier& curve, const Vector2& point) : curve_(curve), point_(point) {}

  void offer(double t) {
    const Vector2 place = curve_.at(t);
    const double distance = (place - point_).squaredNorm();
    if (found_ && !(distance < best_.distance_squared)) return;
    best_ = {t, place, distance};
    found_ = true;
  }

  void search(Quintic interval, double negligible, int halvings) {
    const int changes = interval.sign_changes();
    if (changes == 0 && interval.largest() > negligible) return;
    if (interval.largest() <= negligible || halvings == 0) {
      offer(0.5 * (interval.from + interval.to));  // the distance does not change here, as far as can be told
    } else if (changes == 1) {
      // Only where the distance stops falling is it least.
      const double first = first_sign(interval);
      if (first < 0.0) offer(root_between(curve_, point_, interval.from, interval.to, true));
    } else {
      const Quintic right = interval.halve();
      if (right.c[0] == 0.0) offer(right.from);  // a root that neither half has inside
      search(interval, negligible, halvings - 1);
      search(right, negligible, halvings - 1);
    }
  }

  const NearestOnCurve& best() const { return best_; }

 private:
  static double first_sign(const Quintic& interval) {
    for (const double value : interval.c)
      if (value != 0.0) return value;
    return 0.0;
  }

  const CubicBezier& curve_;
  Vector2 point_;
  NearestOnCurve best_;
  bool found_ = false;
};

constexpr int kSlopeHalvings = 40;
constexpr double kSlopeRounding = 1e-14;  // of the greatest products that the slope is a sum of

}  // namespace

NearestOnCurve nearest_on_curve(const CubicBezier& curve, const Vector2& point, double from, double to) {
  RootSearch search(curve, point);
  search.offer(from);
  const bool whole = from <= 0.0 && to >= 1.0;
  const CubicBezier part = whole ? curve : curve.part(from, to);
  const Quintic slope = slope_of_distance(part, point, from, to);
  double away = 0.0;
  double way = 0.0;
  for (std::size_t i = 0; i < 4; ++i) away = std::max(away, (part.points[i] - point).squaredNorm());
  for (std::size_t i = 0; i < 3; ++i)
    way = std::max(way, (part.points[i + 1] - part.points[i]).squaredNorm());
  search.search(slope, kSlopeRounding * std::sqrt(away * way), kSlopeHalvings);
  search.offer(to);
  return search.best();
}

}  // namespace icome::geometry
