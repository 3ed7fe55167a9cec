#include "sketch/fit/stroke_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace icome::sketch {
namespace {

constexpr double kAtRest = 1e-3;  // of the error
constexpr double kLeastStretch =
    0.25;  // of the path's length, that lies between its ends where a pen goes on

/// The angle (rad, 0 to pi) between two directions of any length.
double angle_between(const Vector2& a, const Vector2& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

void add_point(StrokePath& path, const Vector2& point, std::uint32_t sample) {
  const double before = path.length();
  path.along.push_back(path.points.empty() ? 0.0 : before + (point - path.points.back()).norm());
  path.points.push_back(point);
  path.samples.push_back(sample);
}

/// The turning of the path at a point, seen over `reach` on both sides; less where the path is shorter. None
/// where both sides are tangles of a pen that hardly moves.
double turning_at(const StrokePath& path, std::size_t i, double reach) {
  const double here = path.along[i];
  const Vector2 before = path.at(std::max(0.0, here - reach));
  const Vector2 after = path.at(std::min(path.length(), here + reach));
  const auto is_tangle = [&](const Vector2& end, double length) {
    return (end - path.points[i]).norm() < kLeastStretch * length;
  };
  if (is_tangle(before, std::min(here, reach)) && is_tangle(after, std::min(path.length() - here, reach)))
    return 0.0;
  return angle_between(path.points[i] - before, after - path.points[i]);
}

}  // namespace

Vector2 in_units_of(double error, const Vector2& place, const Vector2& origin) {
  constexpr double kSteps = 1048576.0;  // a power of two, so that only the rounding rounds
  return ((place - origin) / error * kSteps).array().round().matrix() / kSteps;
}

Vector2 StrokePath::at(double distance) const {
  const auto after = std::upper_bound(along.begin(), along.end(), distance);
  if (after == along.begin()) return points.front();
  if (after == along.end()) return points.back();
  const auto i = std::size_t(after - along.begin());
  const double part = (distance - along[i - 1]) / (along[i] - along[i - 1]);
  return points[i - 1] + part * (points[i] - points[i - 1]);
}

void ConeSimplifier::begin(const Vector2& anchor) {
  anchor_ = anchor;
  farthest_ = 0.0;
  low_ = -std::numbers::pi;
  high_ = std::numbers::pi;
}

bool ConeSimplifier::reaches(const Vector2& next) {
  const Vector2 way = next - anchor_;
  const double distance = way.norm();
  if (farthest_ == 0.0) axis_ = way;
  // A point that goes back would be passed twice.
  if (distance < farthest_ - tolerance_) return false;
  const double angle = std::atan2(axis_.x() * way.y() - axis_.y() * way.x(), axis_.dot(way));
  if (farthest_ > tolerance_ && (angle < low_ || angle > high_)) return false;
  if (distance > tolerance_) {
    const double half = std::asin(tolerance_ / distance);
    low_ = std::max(low_, angle - half);
    high_ = std::min(high_, angle + half);
  }
  farthest_ = std::max(farthest_, distance);
  return true;
}

StrokePath path_of(const PenStroke& stroke, double error, double tolerance) {
  StrokePath path;
  if (stroke.empty()) return path;
  const Vector2 origin = stroke.front().place;
  ConeSimplifier cone(tolerance);
  cone.begin(Vector2::Zero());
  add_point(path, Vector2::Zero(), 0);
  Vector2 last = Vector2::Zero();  // the last sample that moved
  std::uint32_t last_sample = 0;
  for (std::size_t i = 1; i < stroke.size(); ++i) {
    const Vector2 point = in_units_of(error, stroke[i].place, origin);
    if ((point - last).norm() < kAtRest) continue;
    const bool passed = last_sample != path.samples.back();
    if (passed && !(tolerance > 0.0 && cone.reaches(point))) {
      add_point(path, last, last_sample);
      cone.begin(last);
      if (tolerance > 0.0) cone.reaches(point);
    } else if (!passed && tolerance > 0.0) {
      cone.reaches(point);
    }
    last = point;
    last_sample = std::uint32_t(i);
  }
  if (last_sample != path.samples.back()) add_point(path, last, last_sample);
  return path;
}

std::vector<std::size_t> corners_of(const StrokePath& path, double angle, double reach) {
  struct Corner {
    std::size_t point;
    double turning;
  };
  std::vector<Corner> found;
  for (std::size_t i = 1; i + 1 < path.points.size(); ++i) {
    const double turning = turning_at(path, i, reach);
    if (turning <= angle) continue;
    if (!found.empty() && path.along[i] - path.along[found.back().point] < reach) {
      if (turning > found.back().turning) found.back() = {i, turning};
    } else {
      found.push_back({i, turning});
    }
  }
  std::vector<std::size_t> corners;
  for (const Corner& corner : found) corners.push_back(corner.point);
  return corners;
}

}  // namespace icome::sketch
