#include "geometry/implicit/implicit_loss.h"

#include <gtest/gtest.h>

namespace icome::geometry {
namespace {

/// A mesh of one large ball.
TriangleMesh ball(double radius) { return tessellate(Sphere{radius}, 1e-4 * radius); }

TEST(ImplicitLoss, FindsASmallBodyBesideALargeOne) {
  const Bounds box(Vector3(-1.0, -1.0, -1.0), Vector3(1.0, 1.0, 1.0));
  for (const double radius : {0.05, 0.01}) {
    const std::string formula =
        "min(x^2+y^2+z^2-0.25, (x-0.7)^2+y^2+z^2-" + std::to_string(radius * radius) + ")";
    const auto surface = ImplicitSurface::create(formula, box).value();
    const auto place = place_that_mesh_lacks(*surface, 0.0, ball(0.5), 0.008);
    ASSERT_TRUE(place) << radius;
    EXPECT_LT((*place - Vector3(0.7, 0.0, 0.0)).norm(), radius);
  }
}

TEST(ImplicitLoss, FindsNothingWhereNothingIsLost) {
  const Bounds box(Vector3(-1.0, -1.0, -1.0), Vector3(1.0, 1.0, 1.0));
  const auto surface = ImplicitSurface::create("x^2+y^2+z^2-0.25", box).value();
  EXPECT_FALSE(place_that_mesh_lacks(*surface, 0.0, ball(0.5), 0.008));
  EXPECT_TRUE(place_that_mesh_lacks(*surface, 0.0, ball(0.3), 0.008));
}

}  // namespace
}  // namespace icome::geometry
