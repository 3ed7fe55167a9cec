#include "interaction/techniques/selection_cone.h"

#include <algorithm>
#include <cmath>

#include "interaction/techniques/technique_cases.h"

namespace icome::interaction {
namespace {

SelectionCone random_cone(base::Random& random) {
  return {random.uniform(0.0, 0.3) * random.direction(), random.direction(), random.uniform(0.05, 1.3)};
}

/// From the point to the nearest of the solid cone: along many of its generators in the point's plane.
double brute_distance(const SelectionCone& cone, const Vector3& point) {
  if (off_axis(cone, point) <= cone.half_angle) return 0.0;
  const Vector3 way = point - cone.apex;
  const double depth = cone.direction.dot(way);
  const double aside = (way - depth * cone.direction).norm();
  double least = way.norm();
  for (double s = 0.0; s < 6.0; s += 1e-4)
    least = std::min(
        least, std::hypot(depth - s * std::cos(cone.half_angle), aside - s * std::sin(cone.half_angle)));
  return least;
}

TEST(SelectionCone, MeetsBallsAsBruteForceSays) {
  base::Random random(2);
  int met = 0;
  for (int i = 0; i < 400; ++i) {
    const SelectionCone cone = random_cone(random);
    const Vector3 centre = random.uniform(0.0, 2.0) * random.direction();
    const double radius = random.uniform(0.01, 0.5);
    const double distance = brute_distance(cone, centre);
    if (std::abs(distance - radius) < 1e-3) continue;
    EXPECT_EQ(cone_meets_ball(cone, centre, radius), distance < radius) << i;
    met += distance < radius ? 1 : 0;
  }
  EXPECT_GT(met, 50);
  EXPECT_LT(met, 350);
}

TEST(SelectionCone, MeetsTrianglesAsBruteForceSays) {
  base::Random random(3);
  int met = 0, without_corners = 0;
  for (int i = 0; i < 600; ++i) {
    const SelectionCone cone = random_cone(random);
    std::array<Vector3, 3> corners;
    for (Vector3& corner : corners) corner = random.uniform(0.2, 2.0) * random.direction();
    constexpr int kParts = 120;
    double least = 10.0;
    for (int u = 0; u <= kParts; ++u)
      for (int v = 0; u + v <= kParts; ++v) {
        const Vector3 point = corners[0] + double(u) / kParts * (corners[1] - corners[0]) +
                              double(v) / kParts * (corners[2] - corners[0]);
        least = std::min(least, off_axis(cone, point) - cone.half_angle);
      }
    if (std::abs(least) < 0.08) continue;  // the grid cannot tell
    EXPECT_EQ(cone_meets_triangle(cone, corners), least < 0.0) << i;
    met += least < 0.0 ? 1 : 0;
    const bool corner = std::any_of(corners.begin(), corners.end(),
                                    [&](const Vector3& it) { return off_axis(cone, it) <= cone.half_angle; });
    without_corners += least < 0.0 && !corner ? 1 : 0;
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(without_corners, 10);
}

TEST(SelectionCone, GoesThroughTheMiddleOfATriangle) {
  const SelectionCone thin{Vector3::Zero(), -Vector3::UnitZ(), 0.01};
  const std::array<Vector3, 3> large = {Vector3(-5, -5, -1), Vector3(5, -5, -1), Vector3(0, 5, -1)};
  EXPECT_TRUE(cone_meets_triangle(thin, large));
  std::array<Vector3, 3> behind = large;
  for (Vector3& corner : behind) corner.z() = 1.0;
  EXPECT_FALSE(cone_meets_triangle(thin, behind));
}

}  // namespace
}  // namespace icome::interaction
