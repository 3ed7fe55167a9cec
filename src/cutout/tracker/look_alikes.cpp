#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cutout/tracker/known_triangles.h"

namespace icome::cutout {
namespace {

constexpr double kHalfTurn = std::numbers::pi;
constexpr double kOneDegree = kHalfTurn / 180.0;
constexpr double kAngleApart = 2.0 * kOneDegree;  // corners nearer to one another are taken for equal
constexpr double kHeightApart = 0.04;             // so are heights that differ by this share
constexpr double kLeastShare = 0.9;               // of a side that edges of others must lie along
constexpr double kMostShare = 1.03;               // beyond which triangles in its corners would overlap
constexpr std::size_t kMostInCorner = 24;         // triangles that are tried in a corner
constexpr std::size_t kMostWarnings = 30;

double base_of(const KnownTriangle& triangle) {
  return 2.0 * triangle.height / std::tan(triangle.base_angle);
}
double leg_of(const KnownTriangle& triangle) { return triangle.height / std::sin(triangle.base_angle); }
double apex_of(const KnownTriangle& triangle) { return kHalfTurn - 2.0 * triangle.base_angle; }

bool same_height(double one, double other) {
  return std::abs(one - other) <= kHeightApart * std::max(one, other);
}

bool look_alike(const KnownTriangle& one, const KnownTriangle& other) {
  return std::abs(one.base_angle - other.base_angle) <= kAngleApart && same_height(one.height, other.height);
}

/// A corner of a triangle, which may lie in a corner of another: the lengths of its two edges.
struct CornerOf {
  std::size_t triangle;
  double first, second;  // mm
};

/// Corners of other triangles that are about as wide as `angle`.
std::vector<CornerOf> corners_like(const KnownTriangles& known, std::size_t except, double angle) {
  std::vector<CornerOf> corners;
  for (std::size_t i = 0; i < known.triangles.size() && corners.size() < kMostInCorner; ++i) {
    if (i == except) continue;
    const KnownTriangle& triangle = known.triangles[i];
    const double base = base_of(triangle);
    const double leg = leg_of(triangle);
    if (std::abs(triangle.base_angle - angle) <= kAngleApart) {
      corners.push_back({i, base, leg});
      corners.push_back({i, leg, base});
    }
    if (std::abs(apex_of(triangle) - angle) <= kAngleApart) corners.push_back({i, leg, leg});
  }
  return corners;
}

bool covers(double one, double other, double side) {
  const double share = (one + other) / side;
  return share >= kLeastShare && share <= kMostShare;
}

/// Three others, one in each corner, whose edges lie along all of the triangle's sides.
std::string three_in_corners(const KnownTriangles& known, std::size_t of) {
  const KnownTriangle& whole = known.triangles[of];
  const auto at_base = corners_like(known, of, whole.base_angle);
  const auto at_apex = corners_like(known, of, apex_of(whole));
  const double base = base_of(whole);
  const double leg = leg_of(whole);
  // For a corner at the base, `first` lies along the base and `second` along the leg.
  for (const CornerOf& left : at_base)
    for (const CornerOf& right : at_base) {
      if (left.triangle >= right.triangle || !covers(left.first, right.first, base)) continue;
      for (const CornerOf& top : at_apex) {
        if (top.triangle == left.triangle || top.triangle == right.triangle) continue;
        if (!covers(left.second, top.first, leg) || !covers(right.second, top.second, leg)) continue;
        return fmt::format("'{}', '{}' and '{}' can lie so that their edges look like '{}'",
                           known.triangles[left.triangle].id, known.triangles[right.triangle].id,
                           known.triangles[top.triangle].id, whole.id);
      }
    }
  return {};
}

/// Corner angles of a triangle from the apex on, and the side across from each.
struct Outline {
  std::array<double, 3> angles;
  std::array<double, 3> across;
};

Outline outline_of(const KnownTriangle& triangle) {
  const double leg = leg_of(triangle);
  return {{apex_of(triangle), triangle.base_angle, triangle.base_angle}, {base_of(triangle), leg, leg}};
}

/// The triangle with these sides, if it is isosceles: the sides that are about equal are its legs.
bool makes(const std::array<double, 3>& sides, const KnownTriangle& whole) {
  for (std::size_t base = 0; base < 3; ++base) {
    const double one = sides[(base + 1) % 3];
    const double other = sides[(base + 2) % 3];
    if (!same_height(one, other)) continue;
    const double leg = 0.5 * (one + other);
    if (2.0 * leg <= sides[base]) continue;
    const double height = std::sqrt(leg * leg - 0.25 * sides[base] * sides[base]);
    if (look_alike({"", std::atan2(height, 0.5 * sides[base]), height, ""}, whole)) return true;
  }
  return false;
}

/// Can the two, laid together along an edge, look like the third?
bool joined_make(const KnownTriangle& one, const KnownTriangle& other, const KnownTriangle& whole) {
  const Outline a = outline_of(one);
  const Outline b = outline_of(other);
  // The shared edge ends where corners i and k meet in a straight angle, and at corners i + e and k + f.
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::abs(a.angles[i] + b.angles[k] - kHalfTurn) > kAngleApart) continue;
      for (std::size_t e = 1; e < 3; ++e)
        for (std::size_t f = 1; f < 3; ++f) {
          const std::size_t a_end = (i + e) % 3, a_free = (i + 3 - e) % 3;
          const std::size_t b_end = (k + f) % 3, b_free = (k + 3 - f) % 3;
          if (!same_height(a.across[a_free], b.across[b_free])) continue;
          if (makes({a.across[i], b.across[k], a.across[a_end] + b.across[b_end]}, whole)) return true;
        }
    }
  return false;
}

void warn_of_pairs(const KnownTriangles& known, std::size_t of, std::vector<std::string>& warnings) {
  const auto& all = known.triangles;
  const std::size_t count = std::min<std::size_t>(all.size(), 4 * kMostInCorner);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = i + 1; k < count; ++k) {
      if (i == of || k == of || !joined_make(all[i], all[k], all[of])) continue;
      warnings.push_back(
          fmt::format("'{}' and '{}', laid together, look like '{}'", all[i].id, all[k].id, all[of].id));
      return;
    }
}

}  // namespace

std::vector<std::string> warnings_of(const KnownTriangles& known) {
  const auto& all = known.triangles;
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::abs(all[i].base_angle - kHalfTurn / 3.0) <= 2.0 * kOneDegree)
      warnings.push_back(fmt::format(
          "'{}' has base angles of {:.4g} degrees: near 60 it looks the same when it is turned by a third",
          all[i].id, all[i].base_angle / kOneDegree));
    for (std::size_t k = i + 1; k < all.size() && warnings.size() <= kMostWarnings; ++k)
      if (look_alike(all[i], all[k]))
        warnings.push_back(
            fmt::format("'{}' and '{}' look alike: {:.4g} and {:.4g} degrees, {:.4g} and "
                        "{:.4g} mm",
                        all[i].id, all[k].id, all[i].base_angle / kOneDegree, all[k].base_angle / kOneDegree,
                        all[i].height, all[k].height));
    if (warnings.size() > kMostWarnings) break;
  }
  for (std::size_t i = 0; i < all.size() && warnings.size() <= kMostWarnings; ++i) {
    warn_of_pairs(known, i, warnings);
    if (std::string three = three_in_corners(known, i); !three.empty()) warnings.push_back(std::move(three));
  }
  if (warnings.size() > kMostWarnings) {
    warnings.resize(kMostWarnings);
    warnings.emplace_back("there are more such warnings");
  }
  return warnings;
}

}  // namespace icome::cutout
