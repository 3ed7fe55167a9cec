#include "haptics/judge/plain_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <queue>
#include <utility>
#include <vector>

namespace icome::haptics {
namespace {

using base::Bounds;
using base::Vector3;

constexpr double kSlopeStep = 1e-4;               // of a part's half diagonal, over which slopes are measured
constexpr double kSafety = 1.6;                   // times the fall of slopes that samples show
constexpr std::size_t kMostPartLooks = 20'000;    // at parts, for one question
constexpr std::size_t kMostFieldParts = 1 << 18;  // kept; some tens of MB
constexpr int kMostFalls = 3;
constexpr double kNothing = 1e-7;  // of a part: the depth up to which solid places may be left out
constexpr double kFinest = 0.3;    // fineness of parts, relative to the one asked for

/// Samples lie at these shares of the ways to a part's corners: uneven, so that a wave does not repeat there.
constexpr std::array<double, 8> kCornerShares{0.97, 0.83, 0.91, 0.79, 0.87, 0.95, 0.76, 0.89};

/// Values of a formula in a box, which is halved across its longest side again and again.
class PlainField {
 public:
  PlainField(geometry::PlainFormula value, const Bounds& box, bool changes)
      : value_(std::move(value)), box_(box), changes_(changes) {}

  double value(const Vector3& point, double time) const { return value_(point, time); }

  /// See MembershipSolid::nearest: the nearest parts are tested first.
  std::optional<Vector3> nearest(const Vector3& point, double time, double limit, double fineness) {
    make_ready(time, limit);
    // At an edge a part may hide its solid places: the next one is farther by its diagonal, twice the
    // half.
    fineness *= kFinest;
    Nearest found{point, limit, fineness, std::nullopt};
    std::priority_queue<Waiting, std::vector<Waiting>, Later> open;
    open.push({(point - closest(root_half_, box_.center(), point)).norm(), 0, box_.center(), root_half_});
    for (std::size_t looks = 0; !open.empty() && open.top().least < found.end() && looks < kMostPartLooks;
         ++looks) {
      const Waiting next = open.top();
      open.pop();
      if (next.half.maxCoeff() <= 0.5 * trusted_) {
        look_at(next);
        const Part& part = parts_[next.part];
        if (part.free) continue;
        const double least = std::max(next.least, least_distance(part, next, point));
        if (least >= found.end()) continue;
        take(part, next, found);
        if (next.half.norm() <= fineness) continue;
      }
      halve(next, point, found.end(), open);
    }
    unfinished_ += !open.empty() && open.top().least < found.end();
    return found.place;
  }

  std::uint64_t unfinished() const { return unfinished_; }

 private:
  struct Part {
    std::uint32_t halves = 0;  // the first of two; 0: not halved yet
    bool looked_at = false;
    bool free = false;   // nothing of it is solid
    bool known = false;  // are the members below known?
    double value = 0.0;  // in the middle
    Vector3 slope = Vector3::Zero();
    double fall = 0.0;  // possible decrease of slopes on the way from the middle
  };
  /// A part to be tested: no place of the solid in it is nearer than `least` (m).
  struct Waiting {
    double least;
    std::uint32_t part;
    Vector3 centre, half;
  };
  struct Later {
    bool operator()(const Waiting& one, const Waiting& other) const { return one.least > other.least; }
  };
  struct Nearest {
    Vector3 to;
    double least, fineness;
    std::optional<Vector3> place;

    /// Parts as far away need not be tested.
    double end() const { return place ? least - fineness : least; }
    bool is_nearer(const Vector3& other) const { return (other - to).norm() < least; }
    void take(const Vector3& other) {
      place = other;
      least = (other - to).norm();
    }
  };

  static Vector3 closest(const Vector3& half, const Vector3& centre, const Vector3& point) {
    return point.cwiseMax(centre - half).cwiseMin(centre + half);
  }

  /// Prepares for a question: samples are trusted in parts no larger than its reach.
  void make_ready(double time, double limit) {
    const bool old = changes_ && time != time_;
    if (old || limit > trusted_ || parts_.size() > kMostFieldParts) parts_.clear();
    trusted_ = std::max(trusted_, limit);
    time_ = time;
    if (parts_.empty()) parts_.emplace_back();
  }

  void look_at(const Waiting& of) {
    Part& part = parts_[of.part];
    if (part.looked_at) return;
    part.looked_at = true;
    const double corner = of.half.norm();
    part.value = value_(of.centre, time_);
    part.slope = slope_at(of.centre, part.value, kSlopeStep * corner);
    part.known = std::isfinite(part.value) && part.slope.allFinite();
    bool defined = !std::isnan(part.value);
    std::array<Vector3, 9> places{Vector3::Zero()}, slopes{part.slope};
    std::array<double, 9> values{part.value};
    for (unsigned i = 0; i < 8; ++i) {
      const Vector3 way = kCornerShares[i] * of.half.cwiseProduct(corner_direction(i));
      const double there = value_(of.centre + way, time_);
      defined = defined || !std::isnan(there);
      if (!part.known) continue;
      places[i + 1] = way;
      values[i + 1] = there;
      slopes[i + 1] = slope_at(of.centre + way, there, -kSlopeStep * corner);
      const double fall = (part.value + part.slope.dot(way) - there) / way.norm();
      part.known = std::isfinite(fall) && slopes[i + 1].allFinite();
      part.fall = std::max(part.fall, kSafety * fall);
    }
    if (part.known) part.fall = std::max(part.fall, kSafety * most_fall(places, slopes));
    double lowest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < places.size() && part.known; ++i) {
      const double beside = places[i].norm() + corner;
      const double middle = values[i] - slopes[i].dot(places[i]);  // of the plane through the sample
      lowest = std::max(lowest, middle - slopes[i].cwiseAbs().dot(of.half) - part.fall * beside);
    }
    lowest += kNothing * part.slope.norm() * corner;  // a value that only comes to zero is not solid
    part.free = part.known ? lowest > 0.0 : !defined && corner <= 0.25 * trusted_;
  }

  /// The largest decrease of the slope along the way from one sample to another. There is none where
  /// functions are joined by max, however sharp the edge.
  static double most_fall(const std::array<Vector3, 9>& places, const std::array<Vector3, 9>& slopes) {
    double most = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Vector3 way = places[i] - places[j];
        most = std::max(most, -(slopes[i] - slopes[j]).dot(way) / way.norm());
      }
    }
    return most;
  }

  static Vector3 corner_direction(unsigned i) {
    return {i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0};
  }

  /// The slope, by differences over steps that stay within the box.
  Vector3 slope_at(const Vector3& point, double here, double step) const {
    Vector3 slope;
    for (int axis = 0; axis < 3; ++axis) {
      const double along = point[axis] > box_.center()[axis] ? -std::abs(step) : std::abs(step);
      slope[axis] = (value_(point + along * Vector3::Unit(axis), time_) - here) / along;
    }
    return slope;
  }

  /// Distance (m) to a plane beyond which all that is solid in the part lies; 0 where none is known.
  static double least_distance(const Part& part, const Waiting& of, const Vector3& point) {
    const double steepness = part.slope.norm();
    if (!part.known || !(steepness > 0.0)) return 0.0;
    const double above = part.value + part.slope.dot(point - of.centre) - part.fall * of.half.norm();
    return above / steepness;
  }

  /// Takes the part's middle if it is solid, and the place where the way down the slope gets solid.
  void take(const Part& part, const Waiting& of, Nearest& found) const {
    if (part.value < 0.0 && found.is_nearer(of.centre)) found.take(of.centre);
    const double square = part.slope.squaredNorm();
    if (!part.known || !(square > 0.0)) return;
    const Vector3 start = closest(of.half, of.centre, found.to);
    double height = part.value + part.slope.dot(start - of.centre);
    Vector3 at = start;
    for (int i = 0; i < kMostFalls; ++i) {
      const double fall = std::max(0.0, height) + 0.1 * found.fineness * std::sqrt(square);
      at = closest(of.half, of.centre, at - fall / square * part.slope);
      if (!found.is_nearer(at)) return;
      height = value_(at, time_);
      if (height < 0.0) return found.take(at);
    }
  }

  template <typename Queue>
  void halve(const Waiting& of, const Vector3& point, double end, Queue& open) {
    if (parts_[of.part].halves == 0) {
      parts_[of.part].halves = std::uint32_t(parts_.size());
      parts_.resize(parts_.size() + 2);
    }
    Eigen::Index axis = 0;
    of.half.maxCoeff(&axis);
    Vector3 half = of.half;
    half[axis] *= 0.5;
    for (const unsigned upper : {0U, 1U}) {
      Vector3 centre = of.centre;
      centre[axis] += upper ? half[axis] : -half[axis];
      const double least = std::max(of.least, (closest(half, centre, point) - point).norm());
      if (least < end) open.push({least, parts_[of.part].halves + upper, centre, half});
    }
  }

  const geometry::PlainFormula value_;
  const Bounds box_;
  const bool changes_;
  const Vector3 root_half_ = 0.5 * box_.sizes();
  double time_ = 0.0;     // s, of the parts that are kept
  double trusted_ = 0.0;  // m
  std::vector<Part> parts_;
  std::uint64_t unfinished_ = 0;  // questions that took too many looks
};

}  // namespace

MembershipSolid plain_solid(const geometry::PlainFormula& value, const Bounds& box, bool changes) {
  const auto field = std::make_shared<PlainField>(value, box, changes);
  return {[field](const Vector3& point, double time) { return field->value(point, time) < 0.0; }, box,
          [field](const Vector3& point, double time, double limit, double fineness) {
            return field->nearest(point, time, limit, fineness);
          },
          [field] { return field->unfinished(); }};
}

}  // namespace icome::haptics
