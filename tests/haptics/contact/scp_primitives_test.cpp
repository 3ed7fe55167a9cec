// The surface contact point on primitives against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "haptics/contact_world.h"

namespace icome::haptics {
namespace {

using geometry::Primitive;

constexpr double kExact = 1e-9;  // m for objects of about 0.1 m

class EveryPrimitive : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Primitives, EveryPrimitive,
                         testing::Values("box:0.1x0.08x0.06", "sphere:0.05", "cylinder:0.04x0.1",
                                         "cone:0.05x0.1", "cone:0.03x0.05x0.1", "torus:0.05x0.02",
                                         "capsule:0.03x0.1", "plane", "box:0.1x0.1x0.001",
                                         "torus:0.05x0.0005", "capsule:0.0005x0.1"),
                         [](const auto& it) {
                           std::string name = it.param;
                           for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

/// A point of a face or curved side (of an edge the nearest face is taken) and its normal.
geometry::SurfacePoint random_surface_point(const Primitive& solid, Random& random) {
  const bool plane = std::holds_alternative<geometry::Plane>(solid);
  const Vector3 far =
      plane ? Vector3(0.1 * random.direction().cwiseAbs()) : Vector3(0.2 * random.direction());
  const Vector3 on = geometry::scp_from_outside(solid, far).point;
  Vector3 within = on;
  while (geometry::signed_distance(solid, within) > -1e-6) within = on + 1e-3 * random.direction();
  return geometry::scp_from_inside(solid, within);
}

// The tip goes straight down on the surface: its SCP is the nearest surface point.
TEST_P(EveryPrimitive, AnswersTheNearestPointToAPress) {
  const Primitive solid = primitive(GetParam());
  Random random(11);
  for (const double radius : {0.0, 0.001}) {
    for (int i = 0; i < repeats(300); ++i) {
      const Pose pose = random_pose(random, 0.3);
      Toucher toucher(HapticScene::compile({object(1, shape_of(solid), pose)}), radius);
      const geometry::SurfacePoint target = random_surface_point(solid, random);
      const double depth = 1e-4;  // less than any radius and thickness here
      const Vector3 from = target.point + (radius + 0.01) * target.normal;
      const Vector3 tip = target.point + (radius - depth) * target.normal;
      const ScpState& state = toucher.go(pose * from, pose * tip, 20);
      ASSERT_TRUE(state.touching);
      ASSERT_LE((pose.inverse() * state.scp - (target.point + radius * target.normal)).norm(), kExact) << i;
    }
  }
}

// However the tip wanders, at whatever slope it meets the surface, the SCP stays outside.
TEST_P(EveryPrimitive, NeverLetsTheScpIn) {
  const Primitive solid = primitive(GetParam());
  const double size = 0.05;
  Random random(7);
  for (const double radius : {0.0, 0.001, 0.01}) {
    for (const TouchableSides sides : {TouchableSides::Front, TouchableSides::Both}) {
      for (int walk = 0; walk < repeats(40); ++walk) {
        Toucher toucher(HapticScene::compile({object(1, shape_of(solid), Pose::Identity(), sides)}), radius);
        Vector3 tip = 3.0 * size * Vector3(0.3, 0.4, 0.86);
        const double speed = std::pow(10.0, random.uniform(-4.0, -2.0));
        Vector3 goal = size * random.direction();
        for (int i = 0; i < 300; ++i) {
          const double clear = geometry::signed_distance(solid, toucher.step(tip).scp) - radius;
          ASSERT_GE(clear, -kExact) << "radius " << radius << " walk " << walk << " tick " << i;
          if ((goal - tip).norm() < speed) goal = size * random.uniform(0.0, 2.5) * random.direction();
          tip += speed * (goal - tip).normalized();
        }
      }
    }
  }
}

TEST_P(EveryPrimitive, HoldsAShallowApproach) {
  const Primitive solid = primitive(GetParam());
  Random random(1);
  for (const double radius : {0.0, 0.001}) {
    for (int i = 0; i < repeats(300); ++i) {
      Toucher toucher(HapticScene::compile({object(1, shape_of(solid))}), radius);
      const geometry::SurfacePoint start = random_surface_point(solid, random);
      const Vector3 along = start.normal.cross(random.direction()).normalized();
      const Vector3 step = 5e-4 * (along - std::pow(10.0, random.uniform(-4.0, 0.0)) * start.normal);
      Vector3 tip = start.point + (radius + std::pow(10.0, random.uniform(-7.0, -3.0))) * start.normal;
      for (int tick = 0; tick < 60; ++tick, tip += step) {
        ASSERT_GE(geometry::signed_distance(solid, toucher.step(tip).scp) - radius, -kExact)
            << i << " " << tick;
      }
    }
  }
}

// Dragged slowly round a smooth convex solid, 2 mm deep, the SCP is the nearest surface point.
TEST(ScpOnPrimitives, FollowsTheNearestPointOfASmoothSolid) {
  Random random(5);
  for (const char* name : {"sphere:0.05", "capsule:0.03x0.1"}) {
    const Primitive solid = primitive(name);
    for (const double scale : {0.02, 1.0, 100.0}) {  // 1 mm to 5 m
      Primitive scaled = solid;
      if (auto* sphere = std::get_if<geometry::Sphere>(&scaled)) sphere->radius *= scale;
      if (auto* capsule = std::get_if<geometry::Capsule>(&scaled)) *capsule = {0.03 * scale, 0.1 * scale};
      Toucher toucher(HapticScene::compile({object(1, shape_of(scaled))}));
      for (int i = 0; i < 1000; ++i) {
        const double angle = 0.01 * i;
        const Vector3 out =
            scale * 0.2 * Vector3(std::cos(angle), std::sin(angle), 0.8 * std::sin(3.1 * angle));
        const geometry::SurfacePoint surface = geometry::scp_from_outside(scaled, out);
        const Vector3 tip = surface.point + scale * (i == 0 ? 0.01 : -0.002) * surface.normal;
        const ScpState& state = toucher.step(tip);
        if (i > 0) {
          ASSERT_LE((state.scp - surface.point).norm(), kExact * scale) << name << " " << i;
        }
      }
    }
  }
}

// On a box the SCP keeps to the face where it came in, as deep as the tip goes, and slides only on it.
TEST(ScpOnPrimitives, KeepsToTheFaceOfABox) {
  Toucher toucher(HapticScene::compile({object(1, shape_of(primitive("box:0.1x0.1x0.1")))}));
  toucher.step({0.01, 0.0, 0.06});
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Vector3 tip(random.uniform(-0.049, 0.049), random.uniform(-0.049, 0.049),
                      random.uniform(-0.2, 0.049));
    ASSERT_LE((toucher.step(tip).scp - Vector3(tip.x(), tip.y(), 0.05)).norm(), kExact) << i;
  }
}

TEST(ScpOnPrimitives, HoldsTheTipWithinTheHoleOfARing) {
  Toucher toucher(HapticScene::compile({object(1, shape_of(primitive("torus:0.05x0.02")))}));
  toucher.step({0.0, 0.0, 0.0});
  for (int i = 0; i < 100; ++i) {
    const double angle = 0.063 * i;
    const Vector3 out(std::cos(angle), std::sin(angle), 0.0);
    ASSERT_LE((toucher.go(0.0 * out, 0.04 * out, 20).scp - 0.03 * out).norm(), kExact) << i;
    toucher.go(0.04 * out, 0.0 * out, 20);
  }
}

TEST(ScpOnPrimitives, HoldsTheTipWithinAShell) {
  Random random(6);
  for (const char* name :
       {"box:0.1x0.1x0.1", "sphere:0.05", "cylinder:0.05x0.1", "capsule:0.05x0.1", "cone:0.06x0.05x0.1"}) {
    const Primitive shell = primitive(name);
    for (const double radius : {0.0, 0.001}) {
      Toucher toucher(
          HapticScene::compile({object(1, shape_of(shell), Pose::Identity(), TouchableSides::Both)}), radius);
      toucher.step(Vector3::Zero());
      for (int i = 0; i < repeats(200); ++i) {
        const Vector3 tip = 0.1 * random.direction();
        ASSERT_LE(geometry::signed_distance(shell, toucher.go(Vector3::Zero(), tip, 30).scp),
                  -radius + kExact)
            << name;
        ASSERT_TRUE(toucher.solver.state().touching);
        toucher.go(tip, Vector3::Zero(), 30);
      }
    }
  }
}

TEST(ScpOnPrimitives, MeetsTheApexOfACone) {
  const Primitive cone = primitive("cone:0.02x0.2");
  for (const double aside : {0.0, 1e-11, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4}) {
    for (const double radius : {0.0, 0.001}) {
      Toucher toucher(HapticScene::compile({object(1, shape_of(cone))}), radius);
      for (int i = 0; i < 100; ++i) {
        const Vector3 tip(aside, 0.0, 0.12 - 0.0005 * i);
        ASSERT_GE(geometry::signed_distance(cone, toucher.step(tip).scp) - radius, -kExact)
            << aside << " " << i;
      }
    }
  }
}

// A 1 mm wall pressed 5 mm deep at 100 to 2,000 mm/s: the SCP stays on the face where the tip came in.
TEST(ScpOnPrimitives, HoldsAThinWall) {
  const MeshPointer mesh = shared(box_mesh({0.1, 0.1, 0.001}));
  Random random(9);
  for (const std::shared_ptr<const Shape>& wall :
       {shape_of(primitive("box:0.1x0.1x0.001")), shape_of(mesh)}) {
    const ScenePointer scene = HapticScene::compile({object(1, wall)});
    int pops = 0;
    for (int i = 0; i < repeats(1000); ++i) {
      Toucher toucher(scene);
      const double speed = random.uniform(0.1e-3, 2e-3);  // m a tick
      const double x = random.uniform(-0.045, 0.045);
      const double y = random.uniform(-0.045, 0.045);
      for (double z = 0.003; z > -0.0045; z -= speed) {
        const ScpState& state = toucher.step({x, y, z});
        pops += (state.scp - Vector3(x, y, std::max(z, 0.0005))).norm() > kExact;
      }
    }
    EXPECT_EQ(pops, 0);
  }
}

TEST(ScpSolver, StartsAtTheSurfaceWhenTheTipIsInside) {
  Toucher toucher(HapticScene::compile({object(1, shape_of(primitive("box:0.1x0.1x0.1")))}));
  const ScpState& state = toucher.step({0.01, 0.02, 0.045});
  EXPECT_TRUE(state.touching);
  EXPECT_TRUE(state.started_inside);
  EXPECT_LE((state.scp - Vector3(0.01, 0.02, 0.05)).norm(), kExact);
  EXPECT_FALSE(toucher.step({0.01, 0.02, 0.045}).started_inside);
}

TEST(ScpSolver, FollowsATipThatTouchesNothingExactly) {
  Toucher toucher(HapticScene::compile({object(1, shape_of(primitive("box:0.1x0.1x0.1")))}));
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const Vector3 tip(random.uniform(0.06, 0.2), random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2));
    EXPECT_EQ(toucher.step(tip).scp, tip);
    EXPECT_FALSE(toucher.solver.state().touching);
  }
}

TEST(ScpSolver, TouchesNothingInAnEmptyScene) {
  Toucher toucher(HapticScene::compile({}));
  EXPECT_EQ(toucher.step({0.1, 0.2, 0.3}).scp, Vector3(0.1, 0.2, 0.3));
  ScpSolver without_scene;
  EXPECT_EQ(without_scene.step({0.1, 0.2, 0.3}, 0.0).scp, Vector3(0.1, 0.2, 0.3));
}

// Friction shortens the way round a curved surface: the SCP still ends on it.
TEST(ScpOnPrimitives, StaysOnACurvedSurfaceWithFriction) {
  for (const char* name :
       {"sphere:0.05", "cylinder:0.03x0.1", "cone:0.05x0.1", "torus:0.05x0.02", "capsule:0.03x0.1"}) {
    const Primitive solid = primitive(name);
    for (const double radius : {0.0, 0.001}) {
      HapticObject touched = object(1, shape_of(solid));
      touched.surface.static_friction = 0.4;
      touched.surface.dynamic_friction = 0.3;
      Toucher toucher(HapticScene::compile({touched}), radius);
      for (int i = 0; i < 3000; ++i) {
        const double angle = 0.002 * i;
        const Vector3 out = 0.2 * Vector3(std::cos(angle), std::sin(angle), 0.3 * std::sin(3.0 * angle));
        const geometry::SurfacePoint surface = geometry::scp_from_outside(solid, out);
        const Vector3 tip = surface.point + (i == 0 ? 0.01 : -0.002) * surface.normal;
        const ScpState& state = toucher.step(tip);
        if (!geometry::inside(solid, tip)) continue;  // the start, and beside a sharp rim
        ASSERT_TRUE(state.touching) << name << " " << i;
        ASSERT_NEAR(geometry::signed_distance(solid, state.scp), radius, kExact) << name << " " << i;
      }
    }
  }
}

}  // namespace
}  // namespace icome::haptics
