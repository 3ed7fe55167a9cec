#include "interaction/techniques/technique_scene.h"

#include <algorithm>
#include <cmath>

#include "interaction/techniques/technique_cases.h"

namespace icome::interaction {
namespace {

TechniqueScene random_balls(base::Random& random, int count) {
  TechniqueScene scene;
  for (int i = 1; i <= count; ++i) {
    SceneTarget target;
    target.id = TargetId(i);
    target.world_from_target = random_pose(random, 2.0) * Eigen::Scaling(random.uniform(0.5, 2.0));
    target.centre = 0.1 * random.direction();
    target.radius = random.uniform(0.02, 0.2);
    EXPECT_TRUE(scene.add(target));
  }
  return scene;
}

TEST(TechniqueScene, RaysAndDistancesAreThoseOfBruteForce) {
  base::Random random(1);
  const TechniqueScene scene = random_balls(random, 60);
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3 eye = 3.0 * random.direction();
    const Ray ray{eye, (random.uniform(0.0, 2.0) * random.direction() - eye).normalized()};
    // Marched: no step is longer than the way to the nearest surface.
    double t = 0.0, distance = 1.0;
    while (t < 12.0 && distance > 1e-10) {
      distance = 1e9;
      for (const SceneTarget& target : scene.targets()) {
        const Vector3 centre = target.world_from_target * target.centre;
        const double radius = target.radius * target.world_from_target.linear().col(0).norm();
        distance = std::min(distance, (ray.origin + t * ray.direction - centre).norm() - radius);
      }
      t += std::max(distance, 1e-12);
    }
    const auto hit = scene.first_hit(ray);
    ASSERT_EQ(hit.has_value(), t < 12.0) << i;
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit->distance, t, 1e-6);
    const auto near = scene.nearest(ray.origin + hit->distance * ray.direction);
    ASSERT_TRUE(near);
    EXPECT_NEAR(near->distance, 0.0, 1e-12);
    EXPECT_FALSE(scene.nearest(ray.origin, scene.nearest(ray.origin)->distance - 1e-9));
    EXPECT_TRUE(scene.nearest(ray.origin, scene.nearest(ray.origin)->distance));
  }
  EXPECT_GT(hits, 20);
}

TEST(TechniqueScene, LightsWhatTheConeMeets) {
  base::Random random(5);
  const TechniqueScene scene = random_balls(random, 80);
  for (int i = 0; i < 50; ++i) {
    const SelectionCone cone{3.0 * random.direction(), random.direction(), 0.5};
    const auto lit = scene.lit_by(cone);
    std::size_t expected = 0;
    for (std::size_t t = 0; t < scene.targets().size(); ++t)
      expected += cone_meets_ball(cone, scene.ball(t).centre, scene.ball(t).radius) ? 1 : 0;
    EXPECT_EQ(lit.size(), expected);
    for (const auto& it : lit) {
      const TargetBall ball = ball_of(*scene.find(it.id));
      EXPECT_DOUBLE_EQ(it.off_axis, off_axis(cone, ball.centre));
      EXPECT_DOUBLE_EQ(it.depth, (ball.centre - cone.apex).dot(cone.direction));
    }
  }
}

TEST(TechniqueScene, TheRaysThatStartWithinSeeTheFarSide) {
  const TechniqueScene scene = scene_of({ball_target(1, Vector3::Zero(), 1.0)});
  const auto hit = scene.first_hit({Vector3(0.0, 0.0, 0.25), -Vector3::UnitZ()});
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->distance, 1.25);
  EXPECT_FALSE(scene.first_hit({Vector3(0.0, 0.0, 2.0), Vector3::UnitZ()}));
  EXPECT_DOUBLE_EQ(scene.nearest(Vector3(0.25, 0.0, 0.0))->distance, -0.75);
}

TEST(TechniqueScene, WhatCannotBeIsRefusedAndChangesNothing) {
  TechniqueScene scene = scene_of({ball_target(1, Vector3::Zero())});
  const double nan = std::nan("");
  EXPECT_FALSE(scene.add(ball_target(0, Vector3::Zero())));
  EXPECT_FALSE(scene.add(ball_target(1, Vector3::Zero())));
  EXPECT_FALSE(scene.add(ball_target(2, Vector3(nan, 0.0, 0.0))));
  for (const double radius : {0.0, -1.0, nan, HUGE_VAL})
    EXPECT_FALSE(scene.add(ball_target(2, Vector3::Zero(), radius))) << radius;
  base::Affine3 flat = base::Affine3::Identity();
  flat.linear().col(0).setZero();
  EXPECT_FALSE(scene.move(1, flat));
  EXPECT_FALSE(scene.move(2, base::Affine3::Identity()));
  EXPECT_EQ(scene.targets().size(), 1u);
  EXPECT_EQ(ball_of(*scene.find(1)).centre, Vector3(Vector3::Zero()));
  EXPECT_EQ(scene.find(2), nullptr);
  EXPECT_FALSE(TechniqueScene().nearest(Vector3::Zero()));
  EXPECT_TRUE(TechniqueScene().bounds().isEmpty());
}

}  // namespace
}  // namespace icome::interaction
