#include "interaction/operations/objects/path_places.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace icome::interaction {
namespace {

using base::Matrix3;
using base::Vector3;

/// A straight part of the path.
struct Part {
  Vector3 begin, direction;  // unit
  double length, reached;    // m; of the whole path at its end
  Matrix3 turn;
};

std::vector<Part> parts_of(std::span<const Vector3> path) {
  std::vector<Part> parts;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector3 way = path[i] - path[i - 1];
    const double length = way.stableNorm();
    if (!(length > 0.0)) continue;
    Part part{path[i - 1], way / length, length, length, Matrix3::Identity()};
    if (!parts.empty()) {
      part.reached += parts.back().reached;
      part.turn = turn_between(parts.back().direction, part.direction) * parts.back().turn;
    }
    parts.push_back(part);
  }
  return parts;
}

}  // namespace

Matrix3 turn_between(const Vector3& from, const Vector3& to) {
  const Vector3 across = from.cross(to);
  const double angle = std::atan2(across.norm(), from.dot(to));
  constexpr double kOpposite = 3.14159;
  if (angle < kOpposite) return Eigen::AngleAxisd(angle, across.stableNormalized()).toRotationMatrix();
  const Vector3 up = std::abs(from.y()) < 0.9 ? Vector3::UnitY() : Vector3::UnitX();
  return Eigen::AngleAxisd(angle, (up - up.dot(from) * from).normalized()).toRotationMatrix();
}

base::Result<std::vector<PathPlace>> places_along(std::span<const Vector3> path, std::size_t count) {
  const std::vector<Part> parts = parts_of(path);
  if (parts.empty()) return base::fail("the path has no length: say two points or more that differ");
  const bool closed = path.front() == path.back();
  const double length = parts.back().reached;
  const double steps = std::max(1.0, double(closed ? count : count - 1));
  std::vector<PathPlace> places;
  auto part = parts.begin();
  for (std::size_t i = 0; i < count; ++i) {
    const double wanted = length * (double(i) / steps);
    while (part + 1 != parts.end() && part->reached <= wanted) ++part;
    const double along = std::min(wanted - (part->reached - part->length), part->length);
    places.push_back({part->begin + along * part->direction, part->turn});
  }
  if (!closed && count > 1) places.back().at = path.back();
  return places;
}

}  // namespace icome::interaction
