#include "interaction/snapping/least_gap.h"

#include <array>

#include "geometry/csg/csg_tree.h"
#include "interaction/snapping/clutter.h"
#include "world/shape/solid_geometry.h"

namespace icome::interaction {
namespace {

world::GeometryPointer as_tree(const geometry::Primitive& it) {
  geometry::CsgTree tree;
  tree.add_leaf(it);
  return std::make_shared<world::CsgGeometry>(tree);
}

/// A block under y = 0 with a hole along y at the origin.
world::GeometryPointer block_with_hole(double radius) {
  geometry::CsgTree tree;
  const auto block = tree.add_leaf(geometry::Primitive(geometry::Box{{0.5, 0.1, 0.5}}), at(0.0, -0.1, 0.0));
  const auto hole = tree.add_leaf(geometry::Primitive(geometry::Cylinder{radius, 1.0}),
                                  turned(0.5 * std::numbers::pi, Vector3::UnitX()));
  tree.add(geometry::CsgOperator::Difference, block, hole);
  return std::make_shared<world::CsgGeometry>(tree);
}

TEST(LeastGap, OfTwoBallsIsWhereTheirCentresLie) {
  base::Random random(1);
  world::CollisionShape one(as_tree(geometry::Sphere{0.1})), other(as_tree(geometry::Sphere{0.2}));
  for (int i = 0; i < 20; ++i) {
    const Vector3 between = random.direction();
    const double apart = random.uniform(-0.002, 0.002);
    const Passing passing{&one, Affine3(Eigen::Translation3d((0.3 + apart) * between)), &other,
                          Affine3::Identity(), Vector3::Zero()};
    const Vector3 direction = (between + 0.05 * random.direction()).normalized();
    const GapLines lines(passing, 0.2 * between + 0.01 * random.direction(), direction, 0.02);
    const auto found = least_gap(lines, 0.005, 1e-9);
    ASSERT_TRUE(found) << i;
    // By so much the one has to go along the direction.
    const double along = (0.3 + apart) * between.dot(direction);
    const double across = (0.3 + apart) * (between - between.dot(direction) * direction).norm();
    const double gap = along - std::sqrt(0.09 - across * across);
    EXPECT_NEAR(found->gap, gap * found->normal.dot(direction), 2e-8) << i;
    EXPECT_GT(found->normal.dot(between), 0.999) << i;
  }
}

TEST(LeastGap, OfABallOverTheRimOfAHoleIsAtTheRim) {
  world::CollisionShape ball(solid(geometry::Sphere{0.05})), block(block_with_hole(0.03));
  // The nearer to the middle, the less do places of the rim differ.
  const std::vector<std::array<double, 2>> cases = {{0.001, 3e-6}, {0.004, 4e-7}, {0.01, 2e-8}, {0.02, 2e-8}};
  for (const auto& [beside, most_off] : cases) {
    // Its centre is off the axis of the hole: it rests on the place of the rim on that side.
    const double to_rim = 0.03 - beside;
    const double height = std::sqrt(0.0025 - to_rim * to_rim);
    const Vector3 rim(0.03, 0.0, 0.0);
    const Vector3 centre(beside, height + 1e-4, 0.0);
    const Passing passing{&ball, Affine3(Eigen::Translation3d(centre)), &block, Affine3::Identity(),
                          Vector3::Zero()};
    const Vector3 direction = (Vector3(beside, height, 0.0) - rim).normalized();
    for (const double angle : {0.0, 0.1, -0.2, 0.4}) {
      std::optional<LeastGap> found;
      Vector3 from(0.03 * std::cos(angle), 0.0, 0.03 * std::sin(angle));
      for (const double reach : {0.005, 0.00125, 0.00125}) {
        found = least_gap(GapLines(passing, from, direction, 0.01), reach, 1e-10);
        ASSERT_TRUE(found) << beside << " " << angle;
        from = found->place;
      }
      const Vector3 off = centre - rim;
      // Along the direction, until the rim is the ball's radius from its centre.
      const double along = off.dot(direction);
      const double gap = along - std::sqrt(0.0025 - (off - along * direction).squaredNorm());
      EXPECT_NEAR(found->gap, gap, most_off) << beside << " " << angle;
    }
  }
}

TEST(LeastGap, OfABoxStandingOnACornerIsThere) {
  world::CollisionShape box(solid(geometry::Box{{0.1, 0.1, 0.1}})), ball(as_tree(geometry::Sphere{1.0}));
  const Affine3 turn = turned(0.6, {1.0, 2.0, 0.5});
  Vector3 lowest(0.0, 1.0, 0.0);
  for (unsigned i = 0; i < 8; ++i) {
    const Vector3 corner = turn * Vector3(i & 1U ? 0.1 : -0.1, i & 2U ? 0.1 : -0.1, i & 4U ? 0.1 : -0.1);
    if (corner.y() < lowest.y()) lowest = corner;
  }
  const Passing passing{&box, Eigen::Translation3d(Vector3(0.0, 1.003, 0.0) - lowest) * turn, &ball,
                        Affine3::Identity(), Vector3::Zero()};
  const GapLines lines(passing, Vector3(0.004, 1.0, -0.003), Vector3::UnitY(), 0.03);
  const auto found = least_gap(lines, 0.01, 1e-9);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->gap, 0.003, 2e-8);
}

}  // namespace
}  // namespace icome::interaction
