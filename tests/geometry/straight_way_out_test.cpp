// The nearest free place along 26 straight lines, against closed forms.
#include "geometry/straight_way_out.h"

#include <gtest/gtest.h>

#include <cmath>

namespace icome::geometry {
namespace {

const Bounds kAround(Vector3(-2, -2, -2), Vector3(2, 2, 2));
constexpr double kBeyond = 1e-3;  // m

TEST(StraightWayOut, LeavesASlabByItsNearerSide) {
  const auto within = [](const Vector3& centre) { return std::abs(centre.y()) < 0.5; };
  const auto place = straight_way_out(Vector3(0.1, 0.2, 0.3), kAround, 0.1, kBeyond, within);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->normal, Vector3::UnitY());
  EXPECT_LT((place->point - Vector3(0.1, 0.5 + kBeyond, 0.3)).norm(), 1e-12);
}

TEST(StraightWayOut, TakesADiagonalWhereThatIsNearest) {
  const Vector3 diagonal = Vector3(1, 0, -1).normalized();
  const auto within = [&](const Vector3& centre) { return centre.dot(diagonal) < 0.25; };
  const auto place = straight_way_out(Vector3::Zero(), kAround, 0.1, kBeyond, within);
  ASSERT_TRUE(place);
  EXPECT_LT((place->normal - diagonal).norm(), 1e-15);
  EXPECT_LT((place->point - (0.25 + kBeyond) * diagonal).norm(), 1e-12);
}

TEST(StraightWayOut, IsFreeFromEverywhereInABall) {
  const auto within = [](const Vector3& centre) { return centre.norm() < 1.0; };
  for (const double radius : {0.01, 0.1, 1.0}) {
    for (double x = -0.99; x < 1.0; x += 0.09) {
      const auto place = straight_way_out(Vector3(x, 0.1, -0.05), kAround, radius, kBeyond, within);
      ASSERT_TRUE(place);
      EXPECT_FALSE(within(place->point)) << x;
    }
  }
}

}  // namespace
}  // namespace icome::geometry
