#include "world/metal.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace icome::world {
namespace {

/// The curve of sRGB (IEC 61966-2-1), number by number.
float srgb_of(double linear) {
  return float(linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
}

Colour srgb_of(const std::array<double, 3>& linear) {
  return {srgb_of(linear[0]), srgb_of(linear[1]), srgb_of(linear[2])};
}

constexpr std::array<double, 3> kCopper{0.955, 0.638, 0.538};

/// glTF 2.0, B.2.1: what shines at a right angle is 0.04 of what is no metal, and the base colour of metal.
std::array<double, 3> f0_of_gltf(const std::array<double, 3>& base, double metallic) {
  std::array<double, 3> f0{};
  for (std::size_t i = 0; i < 3; ++i) f0[i] = 0.04 * (1.0 - metallic) + base[i] * metallic;
  return f0;
}

Material copper(float metallic) {
  Material material;
  material.diffuse = srgb_of(kCopper);
  material.metallic = metallic;
  material.specular = srgb_of(f0_of_gltf(kCopper, double(metallic)));
  return material;
}

TEST(Metal, ShinesAsGltfSays) {
  for (const double metallic : {0.0, 0.25, 0.5, 1.0}) {
    const auto shines = metal_specular(kCopper, metallic), expected = f0_of_gltf(kCopper, metallic);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(shines[i], expected[i], 1e-15) << metallic;
  }
}

TEST(Metal, IsNeverLessThanNoneNorMoreThanAll) {
  EXPECT_EQ(metal_specular(kCopper, -1.0), metal_specular(kCopper, 0.0));
  EXPECT_EQ(metal_specular(kCopper, 3.0), metal_specular(kCopper, 1.0));
}

TEST(Metal, IsKnownByTheSpecularColourThatFollowsFromIt) {
  for (const float metallic : {0.0F, 0.3F, 1.0F}) EXPECT_EQ(metal_of(copper(metallic)), metallic);
}

TEST(Metal, IsNoneWhereTheSpecularColourIsAnother) {
  Material material = copper(0.7F);
  material.specular[1] += 0.001F;
  EXPECT_EQ(metal_of(material), 0.0F);
  material = copper(0.7F);
  material.diffuse[2] += 0.01F;  // of which the same would not follow
  EXPECT_EQ(metal_of(material), 0.0F);
  material = copper(0.7F);
  material.metallic.reset();
  EXPECT_EQ(metal_of(material), 0.0F);
}

}  // namespace
}  // namespace icome::world
