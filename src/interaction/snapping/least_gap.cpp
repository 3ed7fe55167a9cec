// A bundle method (Lemarechal 1975; Kiwiel 1985) in two dimensions: each line that is tried gives a plane
// through its gap, and the next is where the largest of these is least, within a distance that shrinks where
// that proves too optimistic. So ridges, rims and corners are found as well as round places.
#include "interaction/snapping/least_gap.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace icome::interaction {
namespace {

using base::Vector2;

constexpr std::uint64_t kUnitsALine = 60;  // of effort

struct GapPlane {
  Vector2 at;
  double gap;
  Vector2 slope;

  double value(const Vector2& place) const { return gap + slope.dot(place - at); }
};

/// The largest of some planes, within a square.
class GapModel {
 public:
  static constexpr std::size_t kMostPlanes = 8;

  GapModel(const std::vector<GapPlane>& planes, const Vector2& centre, double half)
      : planes_(planes), centre_(centre), half_(half) {}

  double value(const Vector2& place) const {
    double most = -std::numeric_limits<double>::infinity();
    for (const GapPlane& it : planes_) most = std::max(most, it.value(place));
    return most;
  }

  /// The place where value() is least: at a corner of the square, where two planes meet on a side of it,
  /// or where three planes meet.
  Vector2 lowest() {
    for (const double u : {-half_, half_}) {
      for (const double v : {-half_, half_}) consider(centre_ + Vector2(u, v));
    }
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        on_sides(planes_[i], planes_[j]);
        for (std::size_t k = 0; k < j; ++k) where_three_meet(planes_[i], planes_[j], planes_[k]);
      }
    }
    return best_;
  }

 private:
  void consider(const Vector2& place) {
    if (!place.allFinite() || (place - centre_).cwiseAbs().maxCoeff() > half_ * (1.0 + 1e-9)) return;
    const double here = value(place);
    if (!(here < least_)) return;
    least_ = here;
    best_ = place;
  }

  void on_sides(const GapPlane& one, const GapPlane& other) {
    const Vector2 slope = one.slope - other.slope;
    const double apart = one.value(centre_) - other.value(centre_);
    for (const int axis : {0, 1}) {
      for (const double side : {-half_, half_}) {
        Vector2 off;
        off[axis] = side;
        off[1 - axis] = -(apart + slope[axis] * side) / slope[1 - axis];
        consider(centre_ + off);
      }
    }
  }

  void where_three_meet(const GapPlane& one, const GapPlane& other, const GapPlane& third) {
    Eigen::Matrix2d slopes;
    slopes << (one.slope - other.slope).transpose(), (one.slope - third.slope).transpose();
    const double determinant = slopes.determinant();
    if (determinant == 0.0) return;
    const Vector2 apart(one.value(centre_) - other.value(centre_), one.value(centre_) - third.value(centre_));
    const Vector2 off(slopes(1, 1) * apart.x() - slopes(0, 1) * apart.y(),
                      slopes(0, 0) * apart.y() - slopes(1, 0) * apart.x());
    consider(centre_ - off / determinant);
  }

  const std::vector<GapPlane>& planes_;
  Vector2 centre_;
  double half_;
  Vector2 best_ = centre_;
  double least_ = std::numeric_limits<double>::infinity();
};

/// Keeps the planes that tell something about the gap within `reach` of the lowest line: none may be above
/// the gap there, as that of a concave surface can be.
void tidy(std::vector<GapPlane>& planes, const GapPlane& lowest, double reach) {
  std::erase_if(planes, [&](const GapPlane& it) { return (it.at - lowest.at).norm() > 4.0 * reach; });
  for (GapPlane& it : planes) it.gap -= std::max(0.0, it.value(lowest.at) - lowest.gap);
  const auto other = [&](const GapPlane& it) { return it.at != lowest.at; };
  while (planes.size() > GapModel::kMostPlanes) planes.erase(std::ranges::find_if(planes, other));
}

/// The line through the place, or one that hits both close to it.
Vector2 first_line(const GapLines& lines, double reach) {
  if (lines.at(Vector2::Zero())) return Vector2::Zero();
  constexpr int kAround = 6;
  for (const double far : {0.01 * reach, 0.1 * reach}) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      const Vector2 beside = far * Vector2(std::cos(angle), std::sin(angle));
      if (lines.at(beside)) return beside;
    }
  }
  return Vector2::Zero();
}

}  // namespace

GapLines::GapLines(const Passing& passing, const Vector3& place, const Vector3& direction, double window)
    : moved_{passing.moved, passing.world_from_moved.inverse()},
      other_{passing.other, passing.world_from_other.inverse()},
      place_(place),
      direction_(direction),
      window_(window),
      effort_(passing.effort) {
  across_.col(0) = direction.unitOrthogonal();
  across_.col(1) = direction.cross(Vector3(across_.col(0)));
}

std::optional<GapLines::Hit> GapLines::hit(const Side& side, const Vector3& middle,
                                           const Vector3& way) const {
  const auto met = side.shape->first_hit(side.shape_from_world * Vector3(middle - way),
                                         side.shape_from_world * Vector3(middle + way));
  if (!met) return std::nullopt;
  const Vector3 normal = (side.shape_from_world.linear().transpose() * met->normal).normalized();
  return Hit{(2.0 * met->share - 1.0) * direction_.dot(way), normal};
}

std::optional<GapLines::Gap> GapLines::within(const Vector3& middle, double window) const {
  constexpr double kGrazing = 1e-6;  // cosine
  if (effort_ && !effort_->spend(kUnitsALine)) return std::nullopt;
  const auto lower = hit(other_, middle, -window * direction_);
  if (!lower) return std::nullopt;
  const auto upper = hit(moved_, middle, window * direction_);
  if (!upper) return std::nullopt;
  const double climb = lower->normal.dot(direction_), dive = upper->normal.dot(direction_);
  if (std::abs(climb) < kGrazing || std::abs(dive) < kGrazing) return std::nullopt;
  const Vector2 slope = across_.transpose() * (lower->normal / climb - upper->normal / dive);
  return Gap{upper->height - lower->height, slope, middle + lower->height * direction_, lower->normal};
}

/// Tries close to the place first: farther off there may be other walls of the two.
std::optional<GapLines::Gap> GapLines::at(const Vector2& beside) const {
  const Vector3 middle = place_ + across_ * beside;
  const auto found = within(middle, 0.25 * window_);
  return found ? found : within(middle, window_);
}

std::optional<LeastGap> least_gap(const GapLines& lines, double reach, double precision) {
  constexpr int kMostLines = 60;
  constexpr double kLeastReach = 1e-7;  // of what it was
  constexpr double kLevel = 0.05;       // slope
  const Vector2 start = first_line(lines, reach);
  const auto first = lines.at(start);
  if (!first) return std::nullopt;
  GapLines::Gap found = *first;
  GapPlane lowest{start, found.gap, found.slope};
  std::vector<GapPlane> planes{lowest};
  double half = reach;
  for (int i = 0; i < kMostLines && half > kLeastReach * reach; ++i) {
    GapModel model(planes, lowest.at, half);
    const Vector2 next = model.lowest();
    const double promised = lowest.gap - model.value(next);
    if (promised < precision) break;
    const auto there = lines.at(next);
    if (!there) {
      half *= 0.5;
      continue;
    }
    const GapPlane plane{next, there->gap, there->slope};
    planes.push_back(plane);
    const double kept = (lowest.gap - plane.gap) / promised;
    if (kept > 0.0) {
      lowest = plane;
      found = *there;
    }
    if (kept < 0.1) half *= 0.5;
    if (kept > 0.5) half = std::min(2.0 * half, reach);
    tidy(planes, lowest, half);
  }
  // At a round place the surface says which way is out; at a rim or corner only the direction is sure.
  const Vector3 normal = lowest.slope.norm() < kLevel ? found.normal : lines.direction();
  return LeastGap{lowest.gap * normal.dot(lines.direction()), found.place, normal};
}

}  // namespace icome::interaction
