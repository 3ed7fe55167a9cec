#include "haptics/effects/haptic_texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "base/random.h"

namespace icome::haptics {
namespace {

constexpr double kReliefDepth = 0.0004;  // m

std::vector<std::unique_ptr<HapticTexture>> all_textures() {
  std::vector<std::unique_ptr<HapticTexture>> textures;
  textures.push_back(std::make_unique<GrooveTexture>(Vector3(1, 2, -1), 0.003, kReliefDepth));
  textures.push_back(std::make_unique<BumpTexture>(0.004, kReliefDepth));
  textures.push_back(std::make_unique<GrainTexture>(0.002, kReliefDepth, 7));
  return textures;
}

Vector3 random_place(base::Random& random) {
  return {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
}

TEST(HapticTexture, GradientIsTheFiniteDifferenceOfTheHeight) {
  base::Random random(3);
  for (const auto& texture : all_textures()) {
    for (int i = 0; i < 2000; ++i) {
      const Vector3 point = random_place(random);
      const Vector3 gradient = texture->sample(point, Vector3::UnitZ()).gradient;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3 step = 1e-7 * Vector3::Unit(axis);
        const double rise = texture->sample(point + step, Vector3::UnitZ()).height -
                            texture->sample(point - step, Vector3::UnitZ()).height;
        ASSERT_NEAR(gradient[axis], rise / 2e-7, 2e-6);
      }
    }
  }
}

TEST(HapticTexture, OnlyCarvesAndUsesItsDepth) {
  base::Random random(4);
  for (const auto& texture : all_textures()) {
    double lowest = 0.0, highest = -1.0;
    for (int i = 0; i < 50000; ++i) {
      const double height = texture->sample(random_place(random), Vector3::UnitZ()).height;
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
    EXPECT_LE(highest, 1e-18);
    EXPECT_GE(lowest, -kReliefDepth - 1e-18);
    EXPECT_GT(highest - lowest, 0.9 * kReliefDepth);
  }
}

TEST(GrooveTexture, RidgeAndBottomAreHalfAWaveApart) {
  const GrooveTexture grooves(Vector3(5, 0, 0), 0.002, kReliefDepth);
  EXPECT_NEAR(grooves.sample(Vector3(0, 3, 4), Vector3::UnitZ()).height, 0.0, 1e-12);
  EXPECT_NEAR(grooves.sample(Vector3(0.001, 3, 4), Vector3::UnitZ()).height, -kReliefDepth, 1e-12);
}

TEST(BumpTexture, IsFeltOnTheLatticePlanesToo) {
  const BumpTexture bumps(0.004, kReliefDepth);
  const double on = bumps.sample(Vector3(0, 0, 0), Vector3::UnitZ()).height;
  const double between = bumps.sample(Vector3(0.002, 0.002, 0), Vector3::UnitZ()).height;
  EXPECT_NEAR(on - between, kReliefDepth * 2.0 / 3.0, 1e-12);  // two of the three cosines
}

TEST(GrainTexture, SeedMakesTheGrain) {
  const GrainTexture a(0.002, kReliefDepth, 1), same(0.002, kReliefDepth, 1), other(0.002, kReliefDepth, 2);
  const Vector3 point(0.0123, -0.0456, 0.0789);
  EXPECT_EQ(a.sample(point, Vector3::UnitZ()).height, same.sample(point, Vector3::UnitZ()).height);
  EXPECT_NE(a.sample(point, Vector3::UnitZ()).height, other.sample(point, Vector3::UnitZ()).height);
}

// Level at the points of its lattice, and between them not.
TEST(GrainTexture, IsAsFineAsItSays) {
  constexpr double kGrain = 0.002;  // m
  const GrainTexture grain(kGrain, kReliefDepth, 7);
  double between = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Vector3 lattice = kGrain * Vector3(i % 9 - 4, i % 7 - 3, i % 11 - 5);
    EXPECT_NEAR(grain.sample(lattice, Vector3::UnitZ()).gradient.norm(), 0.0, 1e-9);
    const Vector3 middle = lattice + 0.5 * kGrain * Vector3::Ones();
    between += grain.sample(middle, Vector3::UnitZ()).gradient.norm() / 200.0;
  }
  EXPECT_GT(between, 0.1 * kReliefDepth / kGrain);
}

TEST(TexturedForce, FlatTextureChangesNothing) {
  const Vector3 force(0.3, -0.2, 1.5);
  EXPECT_NEAR((textured_force(force, Vector3::UnitZ(), 800.0, {}) - force).norm(), 0.0, 1e-15);
}

TEST(TexturedForce, IsTheGradientOfTheSpringsEnergy) {
  // A tip under the plane z = 0: energy K/2 (depth + height)^2, its SCP straight above it.
  base::Random random(8);
  const double stiffness = 900.0;
  for (const auto& texture : all_textures()) {
    const auto energy = [&](const Vector3& tip) {
      const double height = texture->sample(Vector3(tip.x(), tip.y(), 0.0), Vector3::UnitZ()).height;
      const double depth = std::max(0.0, -tip.z() + height);
      return 0.5 * stiffness * depth * depth;
    };
    for (int i = 0; i < 500; ++i) {
      Vector3 tip = random_place(random);
      tip.z() = -random.uniform(0.0, 0.002);
      const TextureSample sample = texture->sample(Vector3(tip.x(), tip.y(), 0.0), Vector3::UnitZ());
      const Vector3 force =
          textured_force(Vector3(0, 0, -stiffness * tip.z()), Vector3::UnitZ(), stiffness, sample);
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3 step = 1e-7 * Vector3::Unit(axis);
        EXPECT_NEAR(force[axis], (energy(tip - step) - energy(tip + step)) / 2e-7, 2e-4);
      }
    }
  }
}

TEST(TexturedForce, BeginsAtZeroWhenTheTipTouchesAndNeverPulls) {
  base::Random random(9);
  for (const auto& texture : all_textures()) {
    for (int i = 0; i < 1000; ++i) {
      const Vector3 normal = random.direction();
      const TextureSample sample = texture->sample(random_place(random), normal);
      EXPECT_NEAR(textured_force(Vector3::Zero(), normal, 900.0, sample).norm(), 0.0, 1e-12);
      const double push = random.uniform(0.0, 3.0);
      const double out = textured_force(push * normal, normal, 900.0, sample).dot(normal);
      EXPECT_GE(out, -1e-12);
      EXPECT_LE(out, push + 1e-12);
    }
  }
}

TEST(TexturedForce, KeepsFrictionAndTiltsDownhill) {
  const TextureSample uphill_in_x{.height = -0.0001, .gradient = Vector3(0.2, 0, 5.0)};
  const Vector3 force = textured_force(Vector3(0, 0.4, 1.0), Vector3::UnitZ(), 1000.0, uphill_in_x);
  // 1 N is 1 mm deep, the relief takes 0.1 mm: 0.9 N; slope 0.2 pushes back; the gradient along the normal
  // is not a slope; 0.4 N of friction stays.
  EXPECT_NEAR((force - Vector3(-0.18, 0.4, 0.9)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace icome::haptics
