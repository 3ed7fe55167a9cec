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

constexpr double kRootStep = 1e-12;  // Newton's steps square their error: the one after this is rounding

/// The t between `low` and `high`, where the slope has different signs, from `t` on: Newton's steps where
/// they stay inside, halving where they do not.
double root_between(const CubicBezier& curve, const Vector2& point, double low, double high, double t) {
  constexpr int kNewtonSteps = 20, kRootHalvings = 50;
  for (int step = 0; step < kNewtonSteps + kRootHalvings; ++step) {
    const Vector2 away = curve.at(t) - point;
    const Vector2 first = curve.derivative(t);
    const double slope = away.dot(first);
    (slope > 0.0 ? high : low) = t;
    const double steepness = first.squaredNorm() + away.dot(curve.second_derivative(t));
    const double next = t - slope / steepness;
    if (step >= kNewtonSteps || !(next >= low && next <= high)) {
      t = 0.5 * (low + high);
    } else {
      const bool is_there = std::abs(next - t) <= kRootStep;
      t = next;
      if (is_there) return t;
    }
  }
  return t;
}

constexpr int kSlopeHalvings = 40;

/// Searches the roots of an interval that is halved until each has at most one.
class RootSearch {
 public:
  RootSearch(const CubicBezier& curve, const Vector2& point, double guess)
      : curve_(curve), point_(point), guess_(guess) {}

  /// The whole part with its ends. Where the slope changes its sign at most once, they need not be offered
  /// unless they are it.
  void search_part(const Quintic& part, double negligible) {
    const bool is_flat = !(part.largest() > negligible);
    const int changes = part.sign_changes();
    const bool is_rising = first_sign(part) < 0.0;
    if (is_flat || changes > 1 || (changes == 1 && !is_rising)) {
      offer(part.from);
      search(part, negligible, kSlopeHalvings);
      offer(part.to);
    } else if (changes == 1) {
      offer_root(part);
    } else {
      offer(is_rising ? part.to : part.from);
    }
  }

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
      if (first_sign(interval) < 0.0) offer_root(interval);
    } else {
      const Quintic right = interval.halve();
      if (right.c[0] == 0.0) offer(right.from);  // a root that neither half has inside
      search(interval, negligible, halvings - 1);
      search(right, negligible, halvings - 1);
    }
  }

  const NearestOnCurve& best() const { return best_; }

 private:
  /// The only root of an interval in which the slope rises through zero.
  void offer_root(const Quintic& interval) {
    const bool is_inside = guess_ > interval.from && guess_ < interval.to;
    const double begin = is_inside ? guess_ : 0.5 * (interval.from + interval.to);
    offer(root_between(curve_, point_, interval.from, interval.to, begin));
  }

  static double first_sign(const Quintic& interval) {
    for (const double value : interval.c)
      if (value != 0.0) return value;
    return 0.0;
  }

  const CubicBezier& curve_;
  Vector2 point_;
  double guess_;
  NearestOnCurve best_;
  bool found_ = false;
};

constexpr double kSlopeRounding = 1e-14;  // of the greatest products that the slope is a sum of

}  // namespace

NearestOnCurve nearest_on_curve(const CubicBezier& curve, const Vector2& point, double from, double to,
                                double guess) {
  const bool whole = from <= 0.0 && to >= 1.0;
  const CubicBezier part = whole ? curve : curve.part(from, to);
  double away = 0.0;
  double way = 0.0;
  for (std::size_t i = 0; i < 4; ++i) away = std::max(away, (part.points[i] - point).squaredNorm());
  for (std::size_t i = 0; i < 3; ++i)
    way = std::max(way, (part.points[i + 1] - part.points[i]).squaredNorm());
  RootSearch search(curve, point, guess);
  search.search_part(slope_of_distance(part, point, from, to), kSlopeRounding * std::sqrt(away * way));
  return search.best();
}

NearestOnCurve nearest_on_curve(const CubicBezier& curve, const Vector2& point, double from, double to) {
  return nearest_on_curve(curve, point, from, to, 0.5 * (from + to));
}

}  // namespace icome::geometry
