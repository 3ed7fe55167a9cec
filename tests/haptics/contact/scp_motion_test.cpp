// Objects that move, come and go while the tip touches them; friction; and the promises of the servo's path.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <thread>

#include "geometry/mesh/geodesic_sphere.h"
#include "haptics/contact_world.h"
#include "haptics/servo/scene_feed.h"

namespace icome::haptics {
namespace {

constexpr double kTick = 1e-3;  // s

HapticObject slab(const Pose& pose, const Motion& motion, bool mesh) {
  HapticObject result = object(
      1, mesh ? shape_of(shared(box_mesh({0.1, 0.1, 0.01}))) : shape_of(primitive("box:0.1x0.1x0.01")));
  result.world_from_object = pose;
  result.motion = motion;
  return result;
}

bool inside_slab(const Pose& pose, const Vector3& scp) {
  return geometry::signed_distance(primitive("box:0.1x0.1x0.01"), pose.inverse() * scp) < -1e-9;
}

class MovingSlab : public testing::TestWithParam<bool> {};  // as a mesh?

INSTANTIATE_TEST_SUITE_P(Kinds, MovingSlab, testing::Bool());

TEST_P(MovingSlab, PushesAStillTipByItsMotion) {
  Random random(1);
  int pops = 0;
  for (int i = 0; i < repeats(1000); ++i) {
    Pose pose = random_pose(random, 0.0);
    const Vector3 tip(0.02, 0.01, 0.0);
    const Vector3 face =
        pose.linear() * Vector3(random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03), 0.005);
    const Vector3 out = pose.linear().col(2);
    pose.translation() = tip - face - 0.01 * out;  // 1 cm before the tip
    Motion motion;
    motion.linear = random.uniform(0.1, 2.0) * (out + 0.3 * random.direction()).normalized();
    const ScenePointer scene = HapticScene::compile({slab(pose, motion, GetParam())});
    ScpSolver solver;
    solver.adopt(*scene, {});
    for (int tick = 0; tick < 99; ++tick) {
      const ScpState& state = solver.step(tip, kTick * tick);
      if (inside_slab(scene->pose(0, kTick * tick), state.scp)) ++pops;
      const bool over = !inside_slab(scene->pose(0, kTick * tick), tip);
      if (tick < 30 && !over) {
        EXPECT_TRUE(state.touching) << i << " " << tick;
      }
    }
  }
  EXPECT_EQ(pops, 0);
}

TEST_P(MovingSlab, PushesAStillTipByNewScenes) {
  Random random(2);
  int pops = 0;
  for (int i = 0; i < repeats(1000); ++i) {
    Pose pose = random_pose(random, 0.0);
    const Vector3 tip(0.02, 0.01, 0.0);
    const Vector3 out = pose.linear().col(2);
    pose.translation() = tip - pose.linear() * Vector3(random.uniform(-0.03, 0.03), 0.0, 0.005) - 0.01 * out;
    const Vector3 step = random.uniform(0.1e-3, 8e-3) * (out + 0.3 * random.direction()).normalized();
    ScenePointer scene = HapticScene::compile({slab(pose, {}, GetParam())});
    SceneFeed feed({});
    ScpSolver solver;
    for (int tick = 0; tick < 20; ++tick) {
      feed.publish(scene);
      if (tick % 3 == 0) {  // the servo misses two of three
        const PublishedScene* taken = feed.take();
        ASSERT_NE(taken, nullptr);
        solver.adopt(*taken->scene, taken->changes);
        feed.done_before(*taken);
        if (inside_slab(pose, solver.step(tip, 0.0).scp)) ++pops;
      }
      pose.translation() += step;
      const std::array<HapticScene::Move, 1> move{{{{1, 1}, pose, {}}}};
      scene = scene->moved(move);
    }
  }
  EXPECT_EQ(pops, 0);
}

TEST_P(MovingSlab, SweepsATipAsideWhenItTurns) {
  Random random(3);
  int pops = 0;
  for (int i = 0; i < repeats(500); ++i) {
    Motion motion;
    motion.angular = random.uniform(1.0, 30.0) * Vector3(0.0, random.uniform() < 0.5 ? 1.0 : -1.0, 0.2);
    const ScenePointer scene = HapticScene::compile({slab(Pose::Identity(), motion, GetParam())});
    const Vector3 tip(random.uniform(-0.045, 0.045), random.uniform(-0.03, 0.03),
                      random.uniform(0.0055, 0.03));
    ScpSolver solver;
    solver.adopt(*scene, {});
    for (int tick = 0; tick < 99; ++tick) {
      if (inside_slab(scene->pose(0, kTick * tick), solver.step(tip, kTick * tick).scp)) ++pops;
    }
  }
  EXPECT_EQ(pops, 0);
}

TEST_P(MovingSlab, MeetsAMovingTip) {
  Random random(4);
  int pops = 0;
  for (int i = 0; i < repeats(1000); ++i) {
    Motion motion;
    motion.linear = random.uniform(0.0, 2.0) * random.direction();
    motion.angular = random.uniform(0.0, 5.0) * random.direction();
    const ScenePointer scene =
        HapticScene::compile({slab(random_pose(random, 0.0), motion, GetParam()),
                              object(2, shape_of(primitive("sphere:0.001")), translation(1, 0, 0))});
    Vector3 tip = 0.12 * random.direction();
    const Vector3 step = random.uniform(0.1e-3, 4e-3) * (0.03 * random.direction() - tip).normalized();
    ScpSolver solver;
    solver.adopt(*scene, {});
    for (int tick = 0; tick < 99; ++tick, tip += step) {
      if (inside_slab(scene->pose(0, kTick * tick), solver.step(tip, kTick * tick).scp)) {
        ++pops;
        break;
      }
    }
  }
  EXPECT_EQ(pops, 0);
}

TEST_P(MovingSlab, CarriesTheScpThatRestsOnIt) {
  Motion motion;
  motion.linear = {0.05, 0.0, 0.0};
  HapticObject carrier = slab(Pose::Identity(), motion, GetParam());
  carrier.surface.static_friction = carrier.surface.dynamic_friction = 0.9;
  const ScenePointer scene = HapticScene::compile({carrier});
  ScpSolver solver;
  solver.adopt(*scene, {});
  solver.step({0.0, 0.0, 0.006}, 0.0);
  for (int tick = 0; tick <= 20; ++tick) {
    const ScpState& state = solver.step({0.0, 0.0, 0.0}, kTick * tick);
    EXPECT_LE((state.scp - Vector3(5e-5 * tick, 0.0, 0.005)).norm(), 1e-9) << tick;
    EXPECT_EQ(state.surface_velocity, motion.linear);
  }
}

// A floor that slides along and a wall that comes nearer, each with a motion of its own.
TEST_P(MovingSlab, HoldsTheScpInACornerOfTwoMovingObjects) {
  Random random(5);
  int pops = 0;
  for (int i = 0; i < repeats(300); ++i) {
    Motion along, nearer;
    along.linear = Vector3(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.1, 0.3));
    nearer.linear = Vector3(random.uniform(-0.1, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.1, 0.1));
    HapticObject floor = slab(translation(0, 0, -0.005), along, GetParam());
    HapticObject wall =
        slab(Pose(translation(-0.005, 0, 0) * Eigen::AngleAxisd(1.5707963267948966, Vector3::UnitY())),
             nearer, GetParam());
    wall.id = {2, 1};
    std::vector<HapticObject> objects{floor, wall};
    if (i % 2 == 1) std::swap(objects[0], objects[1]);
    const ScenePointer scene = HapticScene::compile(objects);
    ScpSolver solver;
    solver.adopt(*scene, {});
    solver.step({0.003, 0.0, 0.003}, 0.0);
    for (int tick = 0; tick < 60; ++tick) {
      const ScpState& state = solver.step({-0.002, 0.0, -0.002}, kTick * tick);
      pops += inside_slab(scene->pose(0, kTick * tick), state.scp) ||
              inside_slab(scene->pose(1, kTick * tick), state.scp);
    }
  }
  EXPECT_EQ(pops, 0);
}

TEST(ScpSolverScenes, LetsGoOfAnObjectThatGoes) {
  const ScenePointer full = HapticScene::compile({object(1, shape_of(primitive("box:0.1x0.1x0.1")))});
  const ScenePointer empty = HapticScene::compile({});
  Toucher toucher(full);
  toucher.go({0, 0, 0.06}, {0, 0, 0.045}, 10);
  ASSERT_TRUE(toucher.solver.state().touching);
  toucher.solver.adopt(*empty, changes_between(*full, *empty));
  EXPECT_FALSE(toucher.step({0, 0, 0.045}).touching);
  EXPECT_EQ(toucher.solver.state().scp, Vector3(0, 0, 0.045));
}

TEST(ScpSolverScenes, LeavesAnObjectThatAppearsAroundTheTip) {
  const ScenePointer empty = HapticScene::compile({});
  const ScenePointer full = HapticScene::compile({object(1, shape_of(primitive("box:0.1x0.1x0.1")))});
  Toucher toucher(empty);
  toucher.step({0, 0, 0.045});
  toucher.solver.adopt(*full, changes_between(*empty, *full));
  const ScpState& state = toucher.step({0, 0, 0.045});
  EXPECT_TRUE(state.touching);
  EXPECT_TRUE(state.started_inside);
  EXPECT_LE((state.scp - Vector3(0, 0, 0.05)).norm(), 1e-9);
}

TEST(ScpSolverScenes, KeepsTheContactWhenOthersComeAndGo) {
  const HapticObject box = object(7, shape_of(primitive("box:0.1x0.1x0.1")));
  const auto scene = [&](int others) {
    std::vector<HapticObject> objects;
    for (int i = 0; i < others; ++i) {
      objects.push_back(
          object(std::uint32_t(i), shape_of(primitive("sphere:0.01")), translation(1.0 + i, 0, 0)));
    }
    objects.push_back(box);
    return HapticScene::compile(objects);
  };
  const ScenePointer first = scene(0);
  const ScenePointer second = scene(5);
  Toucher toucher(first);
  const Vector3 before = toucher.go({0, 0, 0.06}, {0.01, 0, 0.045}, 10).scp;
  toucher.solver.adopt(*second, changes_between(*first, *second));
  const ScpState& state = toucher.step({0.01, 0, 0.045});
  EXPECT_TRUE(state.touching);
  EXPECT_EQ(second->objects()[state.object].id.index, 7u);
  EXPECT_LE((state.scp - before).norm(), 1e-9);
}

TEST(ScpFriction, HoldsWithinTheConeAndSlidesOnIt) {
  HapticObject table = object(1, shape_of(primitive("box:1x1x0.1")), translation(0, 0, -0.05));
  table.surface.static_friction = 0.6;
  table.surface.dynamic_friction = 0.4;
  Toucher toucher(HapticScene::compile({table}));
  toucher.go({0, 0, 0.01}, {0, 0, -0.002}, 10);
  bool slid = false;
  for (int i = 0; i < 400; ++i) {
    const Vector3 before = toucher.solver.state().scp;
    const ScpState& state = toucher.step({1e-5 * i, 0, -0.002});
    const Vector3 pull = state.scp - Vector3(1e-5 * i, 0, -0.002);
    const double ratio = std::hypot(pull.x(), pull.y()) / pull.z();
    const bool moved = (state.scp - before).norm() > 1e-9;
    slid = slid || moved;
    EXPECT_LE(ratio, 0.6 + 1e-6) << i;
    if (moved) {
      EXPECT_NEAR(ratio, 0.4, 1e-6) << i;
    }
  }
  EXPECT_TRUE(slid);
}

TEST(ScpFriction, DoesNotCreepBelowTheFrictionAngle) {
  HapticObject table = object(1, shape_of(primitive("box:1x1x0.1")), translation(0, 0, -0.05));
  table.surface.static_friction = table.surface.dynamic_friction = 0.5;
  Toucher toucher(HapticScene::compile({table}));
  toucher.go({0, 0, 0.01}, {0, 0, -0.002}, 10);
  const Vector3 rest = toucher.step({0.0009, 0, -0.002}).scp;  // a slope of 0.45
  for (int i = 0; i < 10000; ++i) toucher.step({0.0009, 1e-7 * (i % 2), -0.002});
  EXPECT_EQ(toucher.solver.state().scp, rest);
}

TEST(ScpSolver, GivesTheSameBitsTwice) {
  const MeshPointer mesh = shared(geometry::bumpy_geodesic_sphere(17, 0.05, 0.05, 8));
  const ScenePointer scene =
      HapticScene::compile({object(1, shape_of(mesh)), object(2, shape_of(primitive("torus:0.06x0.01")))});
  const auto run = [&] {
    std::vector<Vector3> path;
    Toucher toucher(scene, 0.001);
    Random random(8);
    Vector3 tip(0.1, 0, 0), goal = tip;
    for (int i = 0; i < repeats(5000); ++i) {
      if ((goal - tip).norm() < 1e-3) goal = 0.055 * random.direction();
      tip += 5e-4 * (goal - tip).normalized();
      path.push_back(toucher.step(tip).scp);
    }
    return path;
  };
  const std::vector<Vector3> one = run();
  const std::vector<Vector3> two = run();
  EXPECT_EQ(std::memcmp(one.data(), two.data(), one.size() * sizeof(Vector3)), 0);
}

// 10,000 spheres in a box: touching feels the same as with only those that are near.
TEST(ScpBroadPhase, AgreesWithTheNearestOfAllObjects) {
  Random random(10);
  std::vector<HapticObject> objects;
  std::vector<Vector3> centres;
  const std::shared_ptr<const Shape> ball = shape_of(primitive("sphere:0.01"));
  for (std::uint32_t i = 0; i < 10000; ++i) {
    centres.emplace_back(random.uniform(), random.uniform(), random.uniform());
    objects.push_back(object(i, ball, Pose(Eigen::Translation3d(centres.back()))));
  }
  const ScenePointer scene = HapticScene::compile(objects);
  for (int i = 0; i < repeats(300); ++i) {
    Toucher toucher(scene);
    Vector3 from;
    do {
      from = Vector3(random.uniform(), random.uniform(), random.uniform());
    } while (std::any_of(centres.begin(), centres.end(),
                         [&](const Vector3& c) { return (c - from).norm() < 0.0101; }));
    const Vector3 step = 0.05 * random.direction();
    double first = 1.0;  // where the straight way meets a ball, by brute force
    for (const Vector3& centre : centres) {
      const double b = (from - centre).dot(step) / step.squaredNorm();
      const double c = ((from - centre).squaredNorm() - 1e-4) / step.squaredNorm();
      if (b < 0.0 && b * b >= c) first = std::min(first, -b - std::sqrt(b * b - c));
    }
    const double before = 0.999 * first;
    toucher.step(from);
    EXPECT_FALSE(toucher.step(from + before * step).touching) << i;
    if (first < 0.98) {
      EXPECT_TRUE(toucher.step(from + (first + 0.001) * step).touching) << i;
    }
  }
}

TEST(SceneFeed, FreesScenesThatTheServoHasLeft) {
  SceneFeed feed({});
  std::weak_ptr<const HapticScene> first;
  for (int i = 0; i < 5; ++i) {
    ScenePointer scene =
        HapticScene::compile({object(1, shape_of(primitive("sphere:0.05")), translation(0.01 * i, 0, 0))});
    if (i == 0) first = scene;
    feed.publish(scene);
    feed.done_before(*feed.take());
  }
  EXPECT_TRUE(first.expired());
  EXPECT_EQ(feed.take(), nullptr);
}

TEST(SceneFeed, AddsUpTheChangesThatTheServoMissed) {
  SceneFeed feed({});
  const auto shape = shape_of(primitive("sphere:0.05"));
  feed.publish(HapticScene::compile({object(1, shape), object(2, shape, translation(0, 1, 0))}));
  feed.done_before(*feed.take());
  feed.publish(HapticScene::compile(
      {object(1, shape, translation(0.1, 0, 0)), object(2, shape, translation(0, 1, 0))}));
  feed.publish(HapticScene::compile(
      {object(1, shape, translation(0.1, 0, 0)), object(2, shape, translation(0.2, 1, 0))}));
  const PublishedScene* taken = feed.take();
  bool one = false, two = false;
  for (const SceneChange& change : taken->changes) {
    one = one || change.id.index == 1;
    two = two || change.id.index == 2;
  }
  EXPECT_TRUE(one && two);
}

TEST(SceneFeed, PassesScenesBetweenThreads) {
  SceneFeed feed({});
  const auto shape = shape_of(primitive("box:0.1x0.1x0.1"));
  feed.publish(HapticScene::compile({object(1, shape)}));
  std::atomic<bool> done = false;
  std::thread main([&] {
    for (int i = 0; i < repeats(4000); ++i) {
      feed.publish(HapticScene::compile({object(1, shape, translation(0.01 * std::sin(0.01 * i), 0, 0))}));
    }
    done = true;
  });
  ScpSolver solver;
  std::uint64_t last = 0;
  bool finite = true;
  while (!done) {
    if (const PublishedScene* taken = feed.take()) {
      EXPECT_GT(taken->version, last);
      last = taken->version;
      solver.adopt(*taken->scene, taken->changes);
      feed.done_before(*taken);
    }
    finite = finite && solver.step({0.0, 0.0, 0.045}, 0.0).scp.allFinite();
  }
  main.join();
  EXPECT_TRUE(finite);
}

}  // namespace
}  // namespace icome::haptics
