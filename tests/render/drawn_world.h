#pragma once
#include <gtest/gtest.h>

#include <string>

#include "charts/image.h"
#include "render/model/views.h"
#include "render/pictures/picture_of_scene.h"
#include "world/sample_world.h"

namespace icome::render {

using base::Vector3;

/// A world made by hand, and pictures of it to ask for colours.
struct DrawnWorld {
  world::World world;
  world::IdSource ids;

  world::ObjectId add(world::GeometryPointer shape, const base::Affine3& place = base::Affine3::Identity()) {
    return world::add_object(world, ids, "thing", std::move(shape), {}, place);
  }

  world::MaterialId material(const world::Material& look) {
    const auto id = ids.next<world::MaterialId>();
    world::applied(world, world::CreateMaterial{id, look});
    return id;
  }

  world::ObjectId add(world::GeometryPointer shape, const base::Affine3& place, const world::Material& look) {
    const world::ObjectId id = add(std::move(shape), place);
    world::applied(world, world::ChooseMaterial{id, material(look)});
    return id;
  }

  world::TextureId texture(std::string bytes) {
    const auto id = ids.next<world::TextureId>();
    world::applied(world, world::CreateTexture{id,
                                               {"picture",
                                                "image/png",
                                                std::make_shared<const std::string>(std::move(bytes)),
                                                {true, true},
                                                0}});
    return id;
  }

  void add_fixture(const world::Fixture& fixture, const base::Affine3& place, const std::string& name = {}) {
    const world::ObjectId id = world::add_object(world, ids, name, nullptr, {}, place);
    world::applied(world, world::ChangeFixture{id, std::make_shared<const world::Fixture>(fixture)});
  }
};

inline world::Material coloured(const world::Colour& diffuse, float transparency = 0.0F) {
  world::Material look;
  look.diffuse = diffuse;
  look.transparency = transparency;
  return look;
}

constexpr world::Colour kRed = {0.8F, 0.0F, 0.0F};
constexpr world::Colour kGreen = {0.0F, 0.8F, 0.0F};
constexpr world::Colour kBlue = {0.0F, 0.0F, 0.8F};

/// Looks along -z from there, through a window of 1.2 rad that is as high as wide.
inline Camera camera_at(const Vector3& eye) {
  Camera camera;
  camera.camera_from_world.translation() = -eye;
  camera.clip_from_camera = perspective({-0.684, 0.684, -0.684, 0.684, 0.1, 100.0});
  return camera;
}

/// A black background, nothing but what is drawn.
inline SceneLook plain_look() {
  SceneLook look;
  look.above = look.below = {0.0, 0.0, 0.0};
  look.ground = false;
  look.shadows = false;
  return look;
}

constexpr int kSide = 96;  // pixels

inline charts::Image drawn(const RenderScene& scene, const Camera& camera, const SceneLook& look,
                           int width = kSide, int height = kSide) {
  auto image = draw_picture(scene, camera, look, width, height);
  EXPECT_TRUE(image.has_value()) << (image ? "" : image.error().message);
  return image ? std::move(*image)
               : charts::Image{width, height, std::vector<std::uint8_t>(4 * std::size_t(width * height))};
}

inline charts::Image drawn(const DrawnWorld& it, const Camera& camera, const SceneLook& look = plain_look()) {
  return drawn(*ScenePublisher().publish(it.world), camera, look);
}

/// The colour at shares of the picture's width from the left and height from the top.
struct Rgb {
  int red, green, blue, alpha;
  int light() const { return red + green + blue; }
};
inline Rgb at_share(const charts::Image& image, double x, double y) {
  const auto* p = image.pixel(std::min(int(x * image.width), image.width - 1),
                              std::min(int(y * image.height), image.height - 1));
  return {p[0], p[1], p[2], p[3]};
}
inline Rgb middle(const charts::Image& image) { return at_share(image, 0.5, 0.5); }

inline bool is_red(const Rgb& c) { return c.red > 60 && c.red > 2 * c.green && c.red > 2 * c.blue; }
inline bool is_green(const Rgb& c) { return c.green > 60 && c.green > 2 * c.red && c.green > 2 * c.blue; }
inline bool is_blue(const Rgb& c) { return c.blue > 60 && c.blue > 2 * c.red && c.blue > 2 * c.green; }
inline bool is_black(const Rgb& c) { return c.light() < 9; }

/// A square in the plane z = 0 from -1 to 1, its front to +z, with texture coordinates from 0 to 1.
inline std::shared_ptr<world::MeshGeometry> square() {
  geometry::TriangleMesh mesh;
  mesh.positions = {{-1.0, -1.0, 0.0}, {1.0, -1.0, 0.0}, {1.0, 1.0, 0.0}, {-1.0, 1.0, 0.0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  auto shape = std::make_shared<world::MeshGeometry>(std::move(mesh));
  using base::Vector2;
  shape->texture_coordinates = {{Vector2(0.0, 0.0), Vector2(1.0, 0.0), Vector2(1.0, 1.0)},
                                {Vector2(0.0, 0.0), Vector2(1.0, 1.0), Vector2(0.0, 1.0)}};
  return shape;
}

/// A PNG file of these pixels, from the top left.
inline std::string png_of(int width, int height, std::vector<std::uint8_t> rgba) {
  const auto bytes = charts::encode_png({width, height, std::move(rgba)});
  return bytes ? std::string(bytes->begin(), bytes->end()) : std::string();
}

}  // namespace icome::render
