// How materials show that are more than a colour: metal, pictures that are clear in places, single sides.
#include "render/drawn_world.h"
#include "render/scene/scene_renderer.h"

namespace icome::render {
namespace {

using world::at;

/// White beneath a picture of one colour that tints it, in light from the eye.
world::Material under_picture(DrawnWorld& it, const std::vector<std::uint8_t>& rgba) {
  world::Material look = coloured({1.0F, 1.0F, 1.0F});
  look.texture = it.texture(png_of(1, 1, rgba));
  look.tints = true;
  look.shininess = 0.0F;
  world::Light sun;
  sun.kind = world::Light::Kind::Directional;
  it.add_fixture(sun, at(0.0, 0.0, 1.0));
  return look;
}

TEST(SceneRendererLooks, MetalShinesInTheColourOfItsPicture) {
  DrawnWorld it;
  world::Material look = under_picture(it, {200, 0, 0, 255});
  look.metallic = 1.0F;
  look.specular = {1.0F, 1.0F, 1.0F};
  it.add(square(), at(0.0, 0.0, 0.0), look);
  EXPECT_TRUE(is_red(middle(drawn(it, camera_at({0.0, 0.0, 2.0})))));
}

TEST(SceneRendererLooks, WhatIsNoMetalShinesInItsSpecularColour) {
  for (const std::optional<float> metallic : {std::optional<float>(), std::optional<float>(1.0F)}) {
    DrawnWorld it;
    world::Material look = under_picture(it, {200, 0, 0, 255});
    look.metallic = metallic;
    look.specular = {0.0F, 0.9F, 0.0F};  // follows from no metal
    it.add(square(), at(0.0, 0.0, 0.0), look);
    EXPECT_GT(middle(drawn(it, camera_at({0.0, 0.0, 2.0}))).green, 150);
  }
}

TEST(SceneRendererLooks, MetalShinesInColoursOfCorners) {
  DrawnWorld it;
  auto shape = square();
  shape->texture_coordinates.clear();
  shape->colours = {{kBlue, kBlue, kBlue}, {kBlue, kBlue, kBlue}};
  world::Material look = under_picture(it, {255, 255, 255, 255});
  look.texture = {};
  look.metallic = 1.0F;
  look.specular = {1.0F, 1.0F, 1.0F};
  it.add(shape, at(0.0, 0.0, 0.0), look);
  EXPECT_TRUE(is_blue(middle(drawn(it, camera_at({0.0, 0.0, 2.0})))));
}

TEST(SceneRendererLooks, WhereAPictureIsClearNothingShines) {
  DrawnWorld it;
  world::Material look = under_picture(it, {255, 255, 255, 0});
  look.alpha_mode = world::AlphaMode::Blend;
  look.specular = {1.0F, 1.0F, 1.0F};
  it.add(square(), at(0.0, 0.0, 0.0), look);
  it.add(square(), at(0.0, 0.0, -0.5), coloured(kGreen));
  EXPECT_TRUE(is_green(middle(drawn(it, camera_at({0.0, 0.0, 2.0})))));
}

TEST(SceneRendererLooks, BacksOfOneSidedSurfacesAreNotSeen) {
  for (const float transparency : {0.0F, 0.1F}) {
    for (const bool both : {false, true}) {
      for (const bool mirrored : {false, true}) {
        DrawnWorld it;
        world::Material look = coloured(kRed, transparency);
        look.double_sided = both;
        base::Affine3 place = base::Affine3::Identity();
        if (mirrored) place.linear().diagonal() = Vector3(-1.0, 1.0, 1.0);
        it.add(square(), place, look);
        it.add(square(), at(0.0, 0.0, 0.5), coloured(kGreen));
        it.add(square(), at(0.0, 0.0, -0.5), coloured(kGreen));
        EXPECT_TRUE(is_red(middle(drawn(it, camera_at({0.0, 0.0, 0.4})))));
        Camera behind = camera_at({0.0, 0.0, 0.4});
        behind.camera_from_world.linear() =
            Eigen::AngleAxisd(3.14159265, Vector3::UnitY()).toRotationMatrix();
        const Rgb seen = middle(drawn(it, behind));
        EXPECT_TRUE(both ? is_red(seen) : is_green(seen)) << transparency << both << mirrored;
      }
    }
  }
}

}  // namespace
}  // namespace icome::render
