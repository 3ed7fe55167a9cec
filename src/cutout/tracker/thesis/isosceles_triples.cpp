#include "cutout/tracker/thesis/isosceles_triples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace icome::cutout {
namespace {

using base::Vector2;

constexpr double kParallel = 0.15;         // rad between two lines that count as parallel
constexpr double kEqualAngles = 0.055;     // rad between the two base angles
constexpr double kBaseAngleReach = 0.035;  // rad from a known base angle
constexpr double kHeightShare = 0.03;      // of a known height
constexpr double kHeightPixels = 2;        // and pixels

/// The angles of the triangle that three lines make; that at corner i, which lies opposite line i.
std::array<double, 3> angles_of_triple(std::span<const HoughLine> lines,
                                       const std::array<std::size_t, 3>& triple) {
  // With the lines in the order of theta, two angles are the turns from one to the next.
  std::array<std::size_t, 3> order = {0, 1, 2};
  const auto theta = [&](std::size_t i) { return lines[triple[order[i]]].theta; };
  if (theta(0) > theta(1)) std::swap(order[0], order[1]);
  if (theta(1) > theta(2)) std::swap(order[1], order[2]);
  if (theta(0) > theta(1)) std::swap(order[0], order[1]);
  std::array<double, 3> angles;
  angles[order[2]] = theta(1) - theta(0);
  angles[order[0]] = theta(2) - theta(1);
  angles[order[1]] = std::numbers::pi - theta(2) + theta(0);
  return angles;
}

Vector2 crossing_of(const HoughLine& a, const HoughLine& b) {
  return Vector2(a.rho * std::sin(b.theta) - b.rho * std::sin(a.theta),
                 b.rho * std::cos(a.theta) - a.rho * std::cos(b.theta)) /
         std::sin(b.theta - a.theta);
}

void match_apex(std::span<const HoughLine> lines, const std::array<std::size_t, 3>& triple,
                const std::array<double, 3>& angles, std::size_t apex, const KnownTriangles& known,
                double pixel, std::vector<KnownTriple>& found) {
  const std::size_t left = (apex + 1) % 3, right = (apex + 2) % 3;
  const double base_angle = (angles[left] + angles[right]) / 2;
  const HoughLine &base = lines[triple[apex]], &one = lines[triple[left]], &other = lines[triple[right]];
  std::optional<Vector2> tip, middle;
  for (std::size_t i = 0; i < known.triangles.size(); ++i) {
    const KnownTriangle& triangle = known.triangles[i];
    const double off_angle = std::abs(triangle.base_angle - base_angle);
    if (off_angle > kBaseAngleReach) continue;
    if (!tip) {
      tip = crossing_of(one, other);
      middle = (crossing_of(base, one) + crossing_of(base, other)) / 2;
    }
    const Vector2 way = *tip - *middle;
    const double off_height = std::abs(triangle.height - way.norm());
    const double reach = kHeightShare * triangle.height + kHeightPixels * pixel;
    if (off_height > reach) continue;
    KnownTriple match;
    match.triangle = i;
    match.pose.centroid = *middle + way / 3;
    match.pose.angle = std::atan2(-way.y(), way.x());
    match.mismatch = off_angle / kBaseAngleReach + off_height / reach;
    match.votes = std::min({base.votes, one.votes, other.votes});
    match.lines = triple;
    found.push_back(match);
  }
}

}  // namespace

std::vector<KnownTriple> isosceles_triples(std::span<const HoughLine> lines, const KnownTriangles& known,
                                           double pixel) {
  std::vector<KnownTriple> found;
  for (std::size_t i = 2; i < lines.size(); ++i)
    for (std::size_t j = 1; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const std::array<std::size_t, 3> triple = {i, j, k};
        const std::array<double, 3> angles = angles_of_triple(lines, triple);
        for (std::size_t apex = 0; apex < 3; ++apex) {
          if (std::abs(angles[(apex + 1) % 3] - angles[(apex + 2) % 3]) > kEqualAngles) continue;
          if (angles[0] < kParallel || angles[1] < kParallel || angles[2] < kParallel) continue;
          match_apex(lines, triple, angles, apex, known, pixel, found);
        }
      }
  return found;
}

}  // namespace icome::cutout
