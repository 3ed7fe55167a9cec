// A tip that glides along exactly below an edge, or over it into the air.
#include <gtest/gtest.h>

#include "geometry/mesh/geodesic_sphere.h"
#include "haptics/contact_world.h"
#include "haptics/judge/contact_judge.h"
#include "repeats.h"

namespace icome::haptics {
namespace {

constexpr double kGlideDepth = 0.002;  // m

/// A bar along x whose edge at y = 0, z = 0 lies between a horizontal face and one that falls off by `angle`.
TriangleMesh roof(double angle) {
  const base::Vector2 down(0.03 * std::cos(angle), -0.03 * std::sin(angle));
  TriangleMesh mesh = prism({{0.0, 0.0}, {-0.05, 0.0}, {-0.05, -0.05}, down}, {{0, 1, 2}, {0, 2, 3}}, 0.1);
  for (Vector3& p : mesh.positions) p = Vector3(p.z(), p.x(), p.y());
  return mesh;
}

/// The SCP's largest distance to the tip (m) while that glides along below the edge, at places that a file
/// rounds to nine digits.
double farthest_below_edge(double angle, const Pose& pose, double error) {
  Toucher toucher(HapticScene::compile({object(1, shape_of(shared(roof(angle))), pose)}));
  toucher.go(pose * Vector3(-0.04, -0.004, 0.001), pose * Vector3(-0.04, -0.004, -kGlideDepth), 30);
  toucher.go(pose * Vector3(-0.04, -0.004, -kGlideDepth), pose * Vector3(-0.03, 0.0, -kGlideDepth), 100);
  double farthest = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Vector3 tip = pose * Vector3(-0.03 + 1e-4 * i, error * (i % 3 - 1), -kGlideDepth);
    farthest = std::max(farthest, (toucher.step(tip).scp - tip).norm());
  }
  return farthest;
}

TEST(ScpEdge, WhoGlidesBelowAnEdgeFindsTheNearerFace) {
  Random random(7);
  for (const double degrees : {15.0, 40.0, 75.0, 89.0}) {
    const double angle = degrees * 3.141592653589793 / 180.0;
    for (const double error : {0.0, 1e-12, 1e-9}) {
      for (int i = 0; i < 5; ++i) {
        const Pose pose = random_pose(random, 0.1);
        EXPECT_LT(farthest_below_edge(angle, pose, error), kGlideDepth * std::cos(angle) + 1e-6)
            << degrees << " degrees, " << error;
      }
    }
  }
}

// Coplanar triangles of a file are level but for its rounding. On their edge each of two may hand the SCP to
// the other, by steps too small to meet it.
TEST(ScpEdge, WhoPressesOnAHairlineValleyFeelsIt) {
  Random random(11);
  for (const double deep : {0.0, 1e-11, 1e-10, 1e-9, 5e-9, 1e-8, 1e-7}) {
    const TriangleMesh valley =
        prism({{-0.05, 0.0}, {-0.05, -0.05}, {0.05, -0.05}, {0.05, 0.0}, {0.0, -deep}},
              {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}}, 0.1);
    for (int i = 0; i < repeats(30); ++i) {
      const Pose pose = random_pose(random, 0.1);
      Toucher toucher(HapticScene::compile({object(1, shape_of(shared(valley)), pose)}));
      toucher.step(pose * Vector3(0.0, 0.003, -0.03));
      for (int tick = 0; tick < 100; ++tick) {
        const Vector3 tip(1e-9 * (random.index(3) - 1.0), -3e-4 * random.uniform(0.1, 3.0),
                          -0.03 + 5e-4 * tick);
        const ScpState& state = toucher.step(pose * tip);
        ASSERT_TRUE(state.touching) << deep << " " << i << " " << tick;
        ASSERT_NEAR((pose.inverse() * state.scp).y(), 0.0, deep + 1e-9);
      }
    }
  }
}

TEST(ScpEdge, NearestRimAgreesWithTheEdgesOfATriangle) {
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const Vector3 a = random.direction(), b = random.direction(), c = random.direction();
    TriangleMesh mesh;
    mesh.positions = {a, b, c};
    mesh.triangles = {{0, 1, 2}};
    const auto scene = HapticScene::compile({object(1, shape_of(shared(mesh), false))});
    ContactRegion region;
    region.start(*scene, {Vector3::Zero(), 0.0, 0.0}, Vector3::Zero(), Vector3::Zero(), 4.0);
    scene->gather(region);
    std::vector<Element> elements(4);
    ASSERT_EQ(region.around(Vector3::Zero(), 3.0, elements), 1u);
    const double u = random.uniform(0.05, 0.9), v = random.uniform(0.0, 1.0 - u);
    const Vector3 inside = a + u * (b - a) + v * (c - a);
    const Rim rim = nearest_rim(elements[0], inside);
    const auto to_edge = [&](const Vector3& from, const Vector3& to) {
      return (inside - from).cross(to - from).norm() / (to - from).norm();
    };
    EXPECT_NEAR(rim.inside, std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)}), 1e-9);
    EXPECT_NEAR(rim.outward.norm(), 1.0, 1e-9);
    EXPECT_NEAR(nearest_rim(elements[0], inside + 0.5 * rim.inside * rim.outward).inside, 0.5 * rim.inside,
                1e-9);
  }
}

// Around a shelf of small triangles regions are small: a fall many times as long still ends within its tick.
TEST(ScpEdge, AFallFromAShelfTakesFewSteps) {
  const auto level = [](double, double) { return 0.0; };
  const auto scene = HapticScene::compile(
      {object(1, shape_of(shared(height_field(0.02, 200, level)), false)),
       object(2, shape_of(shared(scaled(height_field(0.3, 10, level), 1.0, {0.0, 0.0, -0.1})), false))});
  Toucher toucher(scene);
  toucher.go({-0.009, 0.0003, 0.001}, {-0.009, 0.0003, -0.101}, 400);
  for (int i = 0; i < 19; ++i) {
    const Vector3 tip(-0.009 + 0.001 * i, 0.0003, -0.101);
    EXPECT_NEAR(toucher.step(tip).scp.z(), 0.0, 1e-6);
  }
  const Vector3 beyond(0.0103, 0.0003, -0.101);
  const ScpState& fallen = toucher.step(beyond);
  EXPECT_LT((fallen.scp - Vector3(0.0103, 0.0003, -0.1)).norm(), 1e-6);
  EXPECT_LT(fallen.iterations, 18);
}

/// A ball with ridges and pits, some of them undercut.
MeshPointer rugged_ball() {
  TriangleMesh mesh = geometry::bumpy_geodesic_sphere(32, 0.05, 0.0, 0);
  for (Vector3& p : mesh.positions) {
    const Vector3 n = p.normalized();
    p *= 1.0 + 0.3 * std::sin(9.0 * n.x()) * std::sin(8.0 * n.y() + 1.0) * std::cos(7.0 * n.z());
    p.z() += 0.012 * std::sin(150.0 * p.x());
  }
  return shared(mesh);
}

// A tip deep inside moves the nearest place far in a tick: the judge must find the way there.
TEST(ScpEdge, TheJudgeFollowsFarSlides) {
  const MeshPointer ball = rugged_ball();
  Toucher toucher(HapticScene::compile({object(1, shape_of(ball))}));
  ContactJudge judge({{ball}}, {});
  Random random(5);
  Vector3 at(0.0, 0.0, 0.1);
  for (int i = 0; i < repeats(100); ++i) {
    const Vector3 next = random.uniform(0.0, 0.08) * random.direction();
    for (int k = 1; k <= 12; ++k) {
      const Vector3 tip = at + (k / 12.0) * (next - at);
      const ScpState& state = toucher.step(tip);
      judge.judge({tip, state.scp, state.touching, 0.001 * double(judge.ticks())});
    }
    at = next;
  }
  EXPECT_EQ(judge.pops(), 0u);
  EXPECT_EQ(judge.sticks(), 0u);
}

}  // namespace
}  // namespace icome::haptics
