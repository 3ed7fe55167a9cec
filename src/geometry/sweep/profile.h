#pragma once
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// A drawing in the plane z = 0, metres: the outline of a piece of it, or an open line.
struct Profile {
  std::vector<Vector2> points = {};  ///< in order, either way round
  bool open = false;                 ///< a line from the first point to the last, with nothing inside
  std::vector<Vector2> places = {};  ///< texture coordinates of the points; none, or as many
};

/// The difference above which two neighbouring numbers of a sweep count as different, as a share of the
/// largest coordinate: far more than rounding errors, far less than anybody draws.
inline constexpr double kSweepTolerance = 0x1p-40;

/// The smallest extent and the largest coordinate of a profile, m: those of the primitives.
inline constexpr double kSmallestProfile = 1e-9;
inline constexpr double kLargestProfile = 1e6;

/// The largest texture coordinate of a profile.
inline constexpr double kFarthestPictureRepeat = 1e6;

/// The polygon of `corners` equal sides around `centre`, counter-clockwise from the corner at +x. Many
/// corners make a circle.
base::Result<Profile> regular_polygon(int corners, double radius, const Vector2& centre = Vector2::Zero());

/// The profile prepared for a sweep: repeated corners left out, outlines counter-clockwise. Fails for numbers
/// that are not finite or out of range, for too few or too many corners (kMaximumPolygonCorners), for an
/// outline without area, for places that are not as many or out of range, and for edges that cross or touch.
/// O(n^2) at worst, nearly O(n) as a rule.
base::Result<Profile> checked_profile(const Profile& profile);

/// The direction of the line that all points keep to within `tolerance` (m), zero where they are one point;
/// nothing where there is no such line. Precondition: at least one point.
std::optional<Vector3> common_line(std::span<const Vector3> points, double tolerance);

}  // namespace icome::geometry
