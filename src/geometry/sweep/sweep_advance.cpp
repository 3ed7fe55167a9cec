#include "geometry/sweep/sweep_advance.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace icome::geometry {
namespace {

/// A quadratic from 0 to 1, by its Bernstein coefficients.
struct Quadratic {
  double at_0 = 0.0;
  double middle = 0.0;
  double at_1 = 0.0;

  /// Its value where it turns, when it does so between 0 and 1.
  std::optional<double> turning_value() const {
    const double bend = at_0 - 2.0 * middle + at_1;
    const double slope = at_0 - middle;
    if (bend == 0.0 || !(slope / bend > 0.0 && slope / bend < 1.0)) return std::nullopt;
    return at_0 - slope * (slope / bend);
  }
};

struct AdvanceRange {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void extend(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }

  void extend(const Quadratic& values) {
    extend(values.at_0);
    extend(values.at_1);
    if (const auto value = values.turning_value()) extend(*value);
  }
};

/// The normals of the sections on the straight way between two, as a quadratic.
using Normals = std::array<Vector3, 3>;

Quadratic seen_along(const Normals& normals, const Vector3& direction) {
  return {normals[0].dot(direction), normals[1].dot(direction), normals[2].dot(direction)};
}

/// Does a section nearly vanish on the way? It does so in half a turn.
bool vanishes_between(const Normals& normals) {
  constexpr double kHardlyAnything = 0x1p-20;
  const Quadratic areas = seen_along(normals, normals[0].normalized() + normals[2].normalized());
  const auto least = areas.turning_value();
  return least && *least < kHardlyAnything * std::min(areas.at_0, areas.at_1);
}

}  // namespace

SweepAdvance advance_between(const SweepSection& from, const SweepSection& to, double tolerance) {
  const Matrix3 a = from.place.linear();
  const Matrix3 b = to.place.linear();
  Normals normals = {from.normal(), 0.5 * (a.col(0).cross(b.col(1)) + b.col(0).cross(a.col(1))), to.normal()};
  const double longest = std::max({normals[0].norm(), normals[1].norm(), normals[2].norm()});
  for (Vector3& normal : normals) normal /= longest;
  AdvanceRange range;
  for (std::size_t i = 0; i < from.points.size(); ++i) {
    const Vector3 step = to.points[i] - from.points[i];
    range.extend(seen_along(normals, step));
  }
  if (vanishes_between(normals)) return SweepAdvance::Crossing;
  const bool some_forward = range.most > tolerance;
  const bool some_backward = range.least < -tolerance;
  if (some_forward && some_backward) return SweepAdvance::Crossing;
  if (some_forward) return SweepAdvance::Forward;
  return some_backward ? SweepAdvance::Backward : SweepAdvance::Level;
}

bool AdvanceRules::take(SweepAdvance advance) {
  const bool turns_back = latest_ != SweepAdvance::Level && advance != latest_;
  if (turns_back && (joined_ || flat_ != Flat::Shrinks)) return false;
  if (latest_ == SweepAdvance::Level) {
    first_ = advance;
    flat_at_start_ = flat_;
  }
  latest_ = advance;
  flat_ = Flat::None;
  return true;
}

bool AdvanceRules::take_level(bool shrinks) {
  const Flat flat = shrinks ? Flat::Shrinks : Flat::Grows;
  if (flat_ != Flat::None && flat_ != flat) return false;
  // It would lie on the first cap.
  if (capped_ && latest_ == SweepAdvance::Level && shrinks) return false;
  flat_ = flat;
  return true;
}

bool AdvanceRules::may_end() const {
  if (capped_) return flat_ != Flat::Grows;  // that would lie on the last cap
  return !joined_ || flat_ == Flat::None || flat_at_start_ == Flat::None || flat_ == flat_at_start_;
}

}  // namespace icome::geometry
