#include "drawing/outline/swept_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/algebra/polynomial.h"

namespace icome::drawing {
namespace {

/// A part of the parameters of a segment.
struct TRange {
  double from, to;
};

double cross_of(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The square of the speed by t as a polynomial.
std::array<double, 5> speed_squared(const CubicBezier& c) {
  const Vector2 a = 3.0 * (c.points[1] - c.points[0]);
  const Vector2 b = 6.0 * (c.points[2] - 2.0 * c.points[1] + c.points[0]);
  const Vector2 d = 3.0 * (c.points[3] - 3.0 * c.points[2] + 3.0 * c.points[1] - c.points[0]);
  return {a.dot(a), 2.0 * a.dot(b), b.dot(b) + 2.0 * a.dot(d), 2.0 * b.dot(d), d.dot(d)};
}

constexpr double kSlowest = 0.3;  // of the speed nearby: slower is a cusp, at which the curve turns round
constexpr int kMostCuspHalvings = 30;

/// The range around `t` in which the curve turns round, if it does so within a speck.
std::optional<TRange> cusp_at(const CubicBezier& c, double t, double speck) {
  double reach = 0.25;
  TRange range{};
  for (int i = 0; i < kMostCuspHalvings; ++i, reach *= 0.5) {
    range = {std::max(0.0, t - reach), std::min(1.0, t + reach)};
    if (c.part(range.from, range.to).hull_bounds().diagonal().norm() <= speck) break;
  }
  const double nearby = std::max(c.derivative(range.from).norm(), c.derivative(range.to).norm());
  return c.derivative(t).norm() < kSlowest * nearby ? std::optional(range) : std::nullopt;
}

/// The cusps of a segment in order, those at its ends, where a control point lies on the end, too.
std::vector<TRange> cusps_of(const CubicBezier& c, double speck) {
  const auto speed = speed_squared(c);
  const std::array<double, 4> change = {speed[1], 2.0 * speed[2], 3.0 * speed[3], 4.0 * speed[4]};
  std::vector<double> places = {0.0};
  const auto slowest = geometry::real_roots(change, 0.0, 1.0);
  places.insert(places.end(), slowest.all().begin(), slowest.all().end());
  places.push_back(1.0);
  std::vector<TRange> cusps;
  for (const double t : places) {
    const auto cusp = cusp_at(c, t, speck);
    if (!cusp) continue;
    if (!cusps.empty() && cusp->from <= cusps.back().to) {
      cusps.back().to = std::max(cusps.back().to, cusp->to);
    } else {
      cusps.push_back(*cusp);
    }
  }
  return cusps;
}

/// Parts in order. Of those that are still, without a way, the only ones kept are wider than their
/// neighbours.
class PartList {
 public:
  explicit PartList(double speck) : speck_(speck) {}

  void add(const SweptPart& part) {
    drop_still_within(part.radius_at(part.from));
    parts_.push_back(part);
  }

  void add_still(const SweptPart& part) {
    const double radius = part.radius_at(part.from);
    drop_still_within(radius);
    if (!parts_.empty() && parts_.back().radius_at(parts_.back().to) >= radius - speck_) return;
    parts_.push_back(part);
    ends_still_ = true;
  }

  std::vector<SweptPart> take() && { return std::move(parts_); }

 private:
  void drop_still_within(double radius) {
    if (ends_still_ && parts_.back().radius_at(parts_.back().to) <= radius + speck_) parts_.pop_back();
    ends_still_ = false;
  }

  double speck_;
  std::vector<SweptPart> parts_;
  bool ends_still_ = false;
};

/// Cuts one segment.
class SegmentSweep {
 public:
  SegmentSweep(const CubicBezier& curve, double speck, PartList& parts)
      : curve_(curve), speck_(speck), cusps_(cusps_of(curve, speck)), parts_(parts) {}

  /// The part in `range` in which the radius is linear.
  void add(const TRange& range, double radius, double radius_by_t) {
    double from = range.from;
    for (const TRange& cusp : cusps_) {
      // Where the width changes much there, the disc outgrows its way, and nothing needs to be left out.
      if (std::abs(radius_by_t) * (cusp.to - cusp.from) > speck_) continue;
      if (cusp.to <= from || cusp.from >= range.to) continue;
      add_smooth({from, cusp.from}, radius, radius_by_t);
      from = cusp.to;
    }
    add_smooth({from, range.to}, radius, radius_by_t);
  }

 private:
  void add_smooth(const TRange& range, double radius, double radius_by_t) {
    if (range.from >= range.to) return;
    auto excess = speed_squared(curve_);
    excess[0] -= radius_by_t * radius_by_t;
    const auto roots = geometry::real_roots(excess, range.from, range.to);
    double from = range.from;
    const auto add_until = [&](double to) {
      if (to <= from) return;
      const bool outgrown = curve_.derivative(0.5 * (from + to)).norm() <= std::abs(radius_by_t);
      const DiscMotion motion = !outgrown           ? DiscMotion::Sweeps
                                : radius_by_t > 0.0 ? DiscMotion::Grows
                                                    : DiscMotion::Shrinks;
      parts_.add({curve_, from, to, radius, radius_by_t, motion});
      from = to;
    };
    for (const double root : roots.all()) add_until(root);
    add_until(range.to);
  }

  const CubicBezier& curve_;
  double speck_;
  std::vector<TRange> cusps_;
  PartList& parts_;
};

/// The part of a width segment on curve segment `i`: calls `add(range, radius at t = 0, radius by t)`.
template <typename Add>
void for_width_on_segment(const WidthSegment& piece, std::size_t i, const Add& add) {
  const double begin = double(i);
  const TRange range{std::max(piece.from - begin, 0.0), std::min(piece.to - begin, 1.0)};
  const bool none = piece.from_width <= 0.0 && piece.to_width <= 0.0;
  if (range.from >= range.to || none) return;
  const double by_t = 0.5 * (piece.to_width - piece.from_width) / (piece.to - piece.from);
  add(range, 0.5 * piece.from_width + (begin - piece.from) * by_t, by_t);
}

}  // namespace

Vector2 SweepingDisc::touching(double side) const {
  const Vector2 normal(-tangent.y(), tangent.x());
  return -radius_slope * tangent + side * lean_sine() * normal;
}

double SweepingDisc::lean_sine() const { return std::sqrt(1.0 - radius_slope * radius_slope); }

double SweepingDisc::rim_speed(double side) const {
  const double sine = lean_sine();
  return sine * sine - radius * (side * curvature * sine + radius_bending);
}

double SweepingDisc::crossing(double side) const {
  const double sine = lean_sine();
  const double closing = side * curvature * sine + radius_bending;
  return closing > 0.0 ? std::min(radius, sine * sine / closing) : radius;
}

double SweptPart::radius_at(double t) const { return std::max(0.0, radius + t * radius_by_t); }

SweepingDisc SweptPart::disc_at(double t) const {
  const Vector2 way = curve.derivative(t);
  const Vector2 turning = curve.second_derivative(t);
  const double speed = way.norm();
  SweepingDisc disc{curve.at(t), radius_at(t), Vector2::Zero(), 0.0, 0.0, 0.0};
  if (speed <= 0.0) {
    disc.tangent = curve.at(to) - curve.at(from);
    if (!disc.tangent.isZero(0.0)) disc.tangent.stableNormalize();
    return disc;
  }
  disc.tangent = way / speed;
  disc.radius_slope = std::clamp(radius_by_t / speed, -1.0, 1.0);
  disc.radius_bending = -(radius_by_t / speed) * (disc.tangent.dot(turning) / speed) / speed;
  disc.curvature = cross_of(disc.tangent, turning / speed) / speed;
  return disc;
}

std::vector<SweptPart> swept_parts(const Curve& curve, double speck) {
  PartList parts(speck);
  auto piece = curve.widths.begin();
  for (std::size_t i = 0; i < curve.segments.size(); ++i) {
    const CubicBezier& segment = curve.segments[i];
    SegmentSweep sweep(segment, speck, parts);
    const bool point = segment.hull_bounds().diagonal().norm() <= speck;
    while (piece != curve.widths.end() && piece->to <= double(i)) ++piece;
    for (auto on = piece; on != curve.widths.end() && on->from < double(i) + 1.0; ++on) {
      for_width_on_segment(*on, i, [&](const TRange& range, double radius, double by_t) {
        const bool still = point && std::abs(by_t) * (range.to - range.from) <= speck;
        if (still) {
          parts.add_still({segment, range.from, range.to, radius, by_t, DiscMotion::Shrinks});
        } else {
          sweep.add(range, radius, by_t);
        }
      });
    }
  }
  return std::move(parts).take();
}

}  // namespace icome::drawing
