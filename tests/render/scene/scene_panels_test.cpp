#include "render/scene/scene_panels.h"

#include <limits>

#include "render/live_renderer.h"

namespace icome::render {
namespace {

using world::at;
using world::box;

std::shared_ptr<const charts::Image> picture(int width, int height, const std::array<std::uint8_t, 4>& top,
                                             const std::array<std::uint8_t, 4>& bottom) {
  charts::Image image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    const auto& pixel = 2 * y < height ? top : bottom;
    for (int x = 0; x < width; ++x) image.rgba.insert(image.rgba.end(), pixel.begin(), pixel.end());
  }
  return std::make_shared<const charts::Image>(std::move(image));
}

const std::array<std::uint8_t, 4> kRedPixel = {255, 0, 0, 255}, kGreenPixel = {0, 255, 0, 255};

TEST(ScenePanels, StandInTheWindowPixelByPixel) {
  const auto scene = ScenePublisher().publish({});
  SceneLook look = plain_look();
  look.overlay.panels.push_back({.picture = picture(20, 10, kRedPixel, kGreenPixel),
                                 .in_window = {0.0, 1.0},
                                 .anchor = {0.0, 1.0},
                                 .shift = {3.0, -4.0}});
  const charts::Image image = LiveRenderer().draw(*scene, camera_at({0.0, 0.0, 1.0}), look);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 30; ++x) {
      const auto* p = image.pixel(x, y);
      const bool inside = x >= 3 && x < 23 && y >= 4 && y < 14;
      EXPECT_EQ(p[0], inside && y < 9 ? 255 : 0) << x << " " << y;
      EXPECT_EQ(p[1], inside && y >= 9 ? 255 : 0) << x << " " << y;
    }
  }
}

TEST(ScenePanels, StandWhereTheirPlaceIsSeenAndOverAll) {
  DrawnWorld it;
  it.add(box(1.0), at(0.0, 0.0, 0.0), coloured(kBlue));
  const auto scene = ScenePublisher().publish(it.world);
  const Camera camera = camera_at({0.0, 0.0, 3.0});
  SceneLook look = plain_look();
  const Vector3 behind_the_box(0.4, 0.3, -2.0);
  look.overlay.panels.push_back({.picture = picture(9, 9, kRedPixel, kRedPixel), .at = behind_the_box});
  look.overlay.panels.push_back(
      {.picture = picture(9, 9, kGreenPixel, kGreenPixel), .at = Vector3(0.0, 0.0, 9.0)});  // behind the eye
  const charts::Image image = LiveRenderer().draw(*scene, camera, look);
  const auto seen = project(camera, behind_the_box);
  EXPECT_TRUE(is_red(at_share(image, seen->x, seen->y)));
  EXPECT_TRUE(is_blue(middle(image)));
}

// Turned and seen from aside, each of its quarters is where the camera sees that place of the scene.
TEST(ScenePanels, LieInTheSceneWhereTheyAreToldToAndOverAll) {
  DrawnWorld it;
  it.add(box(1.0), at(0.0, 0.0, 0.0), coloured(kBlue));
  const auto scene = ScenePublisher().publish(it.world);
  const Camera camera = camera_at({0.4, 0.7, 3.0});
  const Vector3 middle_of_it(0.1, 0.0, 0.2);  // within the box
  const Vector3 right = 0.5 * Vector3(std::cos(0.6), 0.0, std::sin(0.6)), up = 0.4 * Vector3::UnitY();
  SceneLook look = plain_look();
  look.overlay.panels.push_back(
      {.picture = picture(64, 64, kRedPixel, kGreenPixel), .at = middle_of_it, .lying = {{right, up}}});
  const charts::Image image = LiveRenderer().draw(*scene, camera, look);
  const auto seen_at = [&](double x, double y) {
    const auto seen = project(camera, middle_of_it + x * right + y * up);
    return at_share(image, seen->x, seen->y);
  };
  for (const double x : {-0.9, 0.0, 0.9}) {
    EXPECT_TRUE(is_red(seen_at(x, 0.9)));
    EXPECT_TRUE(is_red(seen_at(x, 0.1)));
    EXPECT_TRUE(is_green(seen_at(x, -0.1)));
    EXPECT_TRUE(is_green(seen_at(x, -0.9)));
    EXPECT_FALSE(is_red(seen_at(x, 1.1)));
    EXPECT_FALSE(is_green(seen_at(x, -1.1)));
  }
  EXPECT_FALSE(is_red(seen_at(1.1, 0.5)));
  EXPECT_FALSE(is_red(seen_at(-1.1, 0.5)));
}

// The pointer at a menu is seen, wherever the menu lies in depth; a name beside it is over both.
TEST(ScenePanels, OfTheSceneAreBehindMarkersAndOthersBefore) {
  const auto scene = ScenePublisher().publish({});
  const Camera camera = camera_at({0.0, 0.0, 3.0});
  SceneLook look = plain_look();
  look.overlay.panels.push_back({.picture = picture(64, 64, kRedPixel, kRedPixel),
                                 .at = Vector3(0.0, 0.0, 0.0),
                                 .lying = {{0.6 * Vector3::UnitX(), 0.6 * Vector3::UnitY()}}});
  look.overlay.balls.push_back({Vector3(0.0, 0.0, 0.3), 0.2, charts::Colour{0.0, 0.0, 0.9}});
  charts::Image image = LiveRenderer().draw(*scene, camera, look);
  EXPECT_TRUE(is_blue(middle(image)));
  const auto beside = project(camera, Vector3(0.4, 0.4, 0.0));
  EXPECT_TRUE(is_red(at_share(image, beside->x, beside->y)));
  look.overlay.panels.push_back(
      {.picture = picture(9, 9, kGreenPixel, kGreenPixel), .at = Vector3(0.0, 0.0, 0.0)});
  image = LiveRenderer().draw(*scene, camera, look);
  EXPECT_TRUE(is_green(middle(image)));
}

TEST(ScenePanels, HideMarkersThatAreFarBehindThemAndNoOthers) {
  DrawnWorld it;
  it.add(box(1.0), at(0.0, 0.0, 0.5), coloured(kGreen));  // its front is at z = 1
  const auto scene = ScenePublisher().publish(it.world);
  const Camera camera = camera_at({0.0, 0.0, 4.0});
  SceneLook look = plain_look();
  look.overlay.panels.push_back({.picture = picture(64, 64, kRedPixel, kRedPixel),
                                 .at = Vector3(0.0, 0.0, 0.0),
                                 .lying = {{0.4 * Vector3::UnitX(), 0.4 * Vector3::UnitY()}},
                                 .hides_beyond = 0.1});
  const auto seen = [&](double z) {
    look.overlay.balls = {{Vector3(0.0, 0.0, z), 0.05, charts::Colour{0.0, 0.0, 0.9}}};
    return middle(LiveRenderer().draw(*scene, camera, look));
  };
  // Though the box is before them all.
  EXPECT_TRUE(is_blue(seen(0.3)));
  EXPECT_TRUE(is_blue(seen(-0.05)));
  EXPECT_FALSE(is_blue(seen(-0.4)));
  look.overlay.panels.front().hides_beyond = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(is_blue(seen(0.3))) << "the box hides it";
  // A panel partly nearer than the nearest that the camera sees hides what is behind it, too.
  look.overlay.panels.front().hides_beyond = 0.0;
  look.overlay.panels.front().at = Vector3(0.0, 0.0, 3.9999);
  EXPECT_FALSE(is_blue(seen(2.0)));
}

TEST(ScenePanels, AreMixedByTheirAlphaAndScaled) {
  const auto scene = ScenePublisher().publish({});
  SceneLook look = plain_look();
  look.above = look.below = {1.0, 1.0, 1.0};
  look.overlay.panels.push_back(
      {.picture = picture(8, 8, {0, 0, 0, 128}, {0, 0, 0, 128}), .in_window = {0.5, 0.5}, .scale = 6.0});
  const charts::Image image = LiveRenderer().draw(*scene, camera_at({0.0, 0.0, 1.0}), look);
  EXPECT_NEAR(middle(image).red, 127, 2);
  EXPECT_NEAR(at_share(image, 0.5 + 20.0 / kSide, 0.5).red, 127, 2);
  EXPECT_NEAR(at_share(image, 0.5 + 28.0 / kSide, 0.5).red, 255, 2);
  // Much smaller than it is, a fine pattern becomes its mean.
  charts::Image stripes{64, 64, {}};
  for (int i = 0; i < 64 * 64; ++i) {
    const std::uint8_t v = i % 2 == 0 ? 255 : 0;
    stripes.rgba.insert(stripes.rgba.end(), {v, v, v, 255});
  }
  look.overlay.panels = {{.picture = std::make_shared<const charts::Image>(std::move(stripes)),
                          .in_window = {0.5, 0.5},
                          .scale = 0.25}};
  EXPECT_NEAR(middle(LiveRenderer().draw(*scene, camera_at({0.0, 0.0, 1.0}), look)).red, 128, 8);
}

TEST(ScenePanels, AnotherPictureIsShownAtOnce) {
  const auto scene = ScenePublisher().publish({});
  const Camera camera = camera_at({0.0, 0.0, 1.0});
  LiveRenderer live;
  for (int i = 0; i < 6; ++i) {
    SceneLook look = plain_look();
    const auto& colour = i % 2 == 0 ? kRedPixel : kGreenPixel;
    look.overlay.panels.push_back({.picture = picture(9, 9, colour, colour), .in_window = {0.5, 0.5}});
    const Rgb seen = middle(live.draw_pass(*scene, camera, look, i));
    EXPECT_TRUE(i % 2 == 0 ? is_red(seen) : is_green(seen)) << i;
  }
}

TEST(ScenePanels, WhatIsNoPictureIsNotDrawn) {
  const auto scene = ScenePublisher().publish({});
  SceneLook look = plain_look();
  const auto good = picture(9, 9, kRedPixel, kRedPixel);
  look.overlay.panels.push_back({});
  look.overlay.panels.push_back({.picture = std::make_shared<const charts::Image>(charts::Image{5, 5, {}})});
  look.overlay.panels.push_back({.picture = std::make_shared<const charts::Image>(charts::Image{0, 0, {}})});
  look.overlay.panels.push_back({.picture = good, .at = Vector3::Constant(std::nan(""))});
  look.overlay.panels.push_back({.picture = good, .scale = -1.0});
  const charts::Image image = LiveRenderer().draw(*scene, camera_at({0.0, 0.0, 1.0}), look);
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) ASSERT_EQ(image.rgba[i], 0);
}

}  // namespace
}  // namespace icome::render
