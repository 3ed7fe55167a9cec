#include "render/scene/scene_renderer.h"

#include <limits>

#include "render/drawn_world.h"

namespace icome::render {
namespace {

using world::at;
using world::box;

TEST(SceneRenderer, ShowsColoursWhereObjectsAre) {
  DrawnWorld it;
  it.add(box(1.0), at(-1.0, 0.0, 0.0), coloured(kRed));
  it.add(box(1.0), at(1.0, 0.0, 0.0), coloured(kGreen));
  const charts::Image image = drawn(it, camera_at({0.0, 0.0, 4.0}));
  EXPECT_TRUE(is_red(at_share(image, 0.27, 0.5)));
  EXPECT_TRUE(is_green(at_share(image, 0.73, 0.5)));
  EXPECT_TRUE(is_black(at_share(image, 0.5, 0.5)));
  EXPECT_TRUE(is_black(at_share(image, 0.27, 0.1)));
}

TEST(SceneRenderer, NearerHidesFartherWhateverTheOrder) {
  for (const bool near_first : {true, false}) {
    DrawnWorld it;
    if (near_first) it.add(square(), at(0.0, 0.0, 1.0), coloured(kRed));
    it.add(square(), at(0.0, 0.0, -1.0), coloured(kGreen));
    if (!near_first) it.add(square(), at(0.0, 0.0, 1.0), coloured(kRed));
    EXPECT_TRUE(is_red(middle(drawn(it, camera_at({0.0, 0.0, 5.0})))));
    EXPECT_TRUE(is_red(middle(drawn(it, camera_at({0.0, 0.0, 2.0})))));
  }
}

TEST(SceneRenderer, TransparencyShowsWhatIsBehindInOrder) {
  DrawnWorld it;
  it.add(square(), at(0.0, 0.0, 1.0), coloured(kRed, 0.5F));
  it.add(square(), at(0.0, 0.0, 0.0), coloured(kGreen, 0.5F));
  it.add(square(), at(0.0, 0.0, -1.0), coloured(kBlue));
  const Rgb seen = middle(drawn(it, camera_at({0.0, 0.0, 5.0})));
  EXPECT_GT(seen.red, seen.green);
  EXPECT_GT(seen.green, 30);
  EXPECT_GT(seen.blue, 30);
  // From behind the opaque one hides the others.
  Camera behind = camera_at({0.0, 0.0, 5.0});
  behind.camera_from_world.linear() = Eigen::AngleAxisd(3.14159265, Vector3::UnitY()).toRotationMatrix();
  EXPECT_TRUE(is_blue(middle(drawn(it, behind))));
}

TEST(SceneRenderer, WhollyTransparentIsNotSeen) {
  DrawnWorld it;
  it.add(square(), at(0.0, 0.0, 1.0), coloured(kRed, 1.0F));
  it.add(square(), at(0.0, 0.0, 0.0), coloured(kGreen));
  EXPECT_TRUE(is_green(middle(drawn(it, camera_at({0.0, 0.0, 5.0})))));
}

TEST(SceneRenderer, TexturesStandUpright) {
  DrawnWorld it;
  world::Material look = coloured({1.0F, 1.0F, 1.0F});
  look.texture = it.texture(png_of(2, 2,
                                   {255, 0, 0, 255, 0, 255, 0, 255,  //
                                    0, 0, 255, 255, 0, 0, 0, 255}));
  it.add(square(), at(0.0, 0.0, 0.0), look);
  const charts::Image image = drawn(it, camera_at({0.0, 0.0, 2.0}));
  EXPECT_TRUE(is_red(at_share(image, 0.32, 0.32)));
  EXPECT_TRUE(is_green(at_share(image, 0.68, 0.32)));
  EXPECT_TRUE(is_blue(at_share(image, 0.32, 0.68)));
  EXPECT_LT(at_share(image, 0.68, 0.68).light(), 40);
}

TEST(SceneRenderer, ClearPartsOfTexturesAreCutOut) {
  DrawnWorld it;
  world::Material look = coloured({1.0F, 1.0F, 1.0F});
  look.texture = it.texture(png_of(2, 1, {255, 0, 0, 255, 255, 0, 0, 0}));
  it.add(square(), at(0.0, 0.0, 0.0), look);
  it.add(square(), at(0.0, 0.0, -0.5), coloured(kGreen));
  const charts::Image image = drawn(it, camera_at({0.0, 0.0, 2.0}));
  EXPECT_TRUE(is_red(at_share(image, 0.25, 0.5)));
  EXPECT_TRUE(is_green(at_share(image, 0.75, 0.5)));
}

TEST(SceneRenderer, TexturesCanBeSeenThrough) {
  DrawnWorld it;
  world::Material look = coloured({1.0F, 1.0F, 1.0F});
  look.texture = it.texture(png_of(1, 1, {255, 0, 0, 128}));
  it.add(square(), at(0.0, 0.0, 0.0), look);
  it.add(square(), at(0.0, 0.0, -0.5), coloured(kGreen));
  const Rgb seen = middle(drawn(it, camera_at({0.0, 0.0, 2.0})));
  EXPECT_GT(seen.red, 50);
  EXPECT_GT(seen.green, 50);
}

TEST(SceneRenderer, ColoursShowAsTheyWereMeant) {
  DrawnWorld it;
  world::Material look = coloured({0.0F, 0.0F, 0.0F});
  look.emission = {0.2F, 0.5F, 0.8F};  // of 255: 51, 127.5, 204
  it.add(square(), at(0.0, 0.0, 0.0), look);
  const Rgb seen = middle(drawn(it, camera_at({0.0, 0.0, 2.0})));
  EXPECT_NEAR(seen.red, 51, 2);
  EXPECT_NEAR(seen.green, 127, 2);
  EXPECT_NEAR(seen.blue, 204, 2);
}

TEST(SceneRenderer, CornerColoursReplaceTheMaterials) {
  DrawnWorld it;
  auto shape = square();
  shape->colours = {{kGreen, kGreen, kGreen}, {kBlue, kBlue, kBlue}};
  it.add(shape, at(0.0, 0.0, 0.0), coloured(kRed));
  const charts::Image image = drawn(it, camera_at({0.0, 0.0, 2.0}));
  EXPECT_TRUE(is_green(at_share(image, 0.7, 0.7)));
  EXPECT_TRUE(is_blue(at_share(image, 0.3, 0.3)));
}

TEST(SceneRenderer, ClonesShareAShapeAndAreAllDrawn) {
  DrawnWorld it;
  const auto first = it.add(box(1.0), at(-1.0, 0.0, 0.0), coloured(kRed));
  const auto second = world::duplicated(it.world, it.ids, first, world::Duplicate::CloneObject);
  world::applied(it.world, world::PlaceObject{second, at(1.0, 0.0, 0.0)});
  const charts::Image image = drawn(it, camera_at({0.0, 0.0, 4.0}));
  EXPECT_TRUE(is_red(at_share(image, 0.27, 0.5)));
  EXPECT_TRUE(is_red(at_share(image, 0.73, 0.5)));
}

/// Lit by one lamp from the side, far right.
void add_lamp_at_right(DrawnWorld& it) {
  base::Affine3 place = base::Affine3::Identity();
  place.linear() = Eigen::AngleAxisd(1.5707963, Vector3::UnitY()).toRotationMatrix();  // its -z becomes -x
  it.add_fixture(world::Light{}, place);
}

TEST(SceneRenderer, MirroredObjectsAreLitFromWhereTheLightIs) {
  for (const double mirror : {1.0, -1.0}) {
    DrawnWorld it;
    add_lamp_at_right(it);
    base::Affine3 place = base::Affine3::Identity();
    place.linear().diagonal() << mirror, 1.0, 1.0;
    it.add(std::make_shared<world::PrimitiveGeometry>(geometry::Sphere{1.0}), place,
           coloured({0.8F, 0.8F, 0.8F}));
    const charts::Image image = drawn(it, camera_at({0.0, 0.0, 3.0}));
    EXPECT_GT(at_share(image, 0.72, 0.5).light(), at_share(image, 0.28, 0.5).light() + 100) << mirror;
  }
}

TEST(SceneRenderer, BacksOfOpenMeshesAreLit) {
  DrawnWorld it;
  base::Affine3 turned = base::Affine3::Identity();
  turned.linear() = Eigen::AngleAxisd(3.14159265, Vector3::UnitY()).toRotationMatrix();
  it.add(square(), turned, coloured({0.8F, 0.8F, 0.8F}));
  const int back = middle(drawn(it, camera_at({0.0, 0.0, 3.0}))).light();
  DrawnWorld front;
  front.add(square(), at(0.0, 0.0, 0.0), coloured({0.8F, 0.8F, 0.8F}));
  EXPECT_NEAR(back, middle(drawn(front, camera_at({0.0, 0.0, 3.0}))).light(), 12);
}

TEST(SceneRenderer, ASpotLightsOnlyItsCone) {
  DrawnWorld it;
  world::Light spot;
  spot.kind = world::Light::Kind::Spot;
  spot.cut_off_angle = 0.2;
  spot.beam_width = 0.15;
  it.add_fixture(spot, at(0.0, 0.0, 2.0));
  it.add(square(), at(0.0, 0.0, 0.0), coloured({0.8F, 0.8F, 0.8F}));
  const charts::Image image = drawn(it, camera_at({0.0, 0.0, 2.0}));
  EXPECT_GT(middle(image).light(), at_share(image, 0.15, 0.5).light() + 100);
}

TEST(SceneRenderer, ShadowsDarken) {
  // A small plate over a large one, the light straight from above.
  DrawnWorld it;
  base::Affine3 down = base::Affine3::Identity();
  down.linear() = Eigen::AngleAxisd(-1.5707963, Vector3::UnitX()).toRotationMatrix();  // -z becomes -y
  it.add_fixture(world::Light{}, down);
  base::Affine3 floor = down;
  floor.linear() *= 4.0;
  it.add(square(), floor, coloured({0.8F, 0.8F, 0.8F}));
  base::Affine3 plate = down;
  plate.translation() = Vector3(0.0, 1.5, 0.0);
  it.add(square(), plate, coloured({0.8F, 0.8F, 0.8F}));
  Camera camera;
  camera.camera_from_world.linear() = Eigen::AngleAxisd(0.5, Vector3::UnitX()).toRotationMatrix();
  camera.camera_from_world.translation() = -(camera.camera_from_world.linear() * Vector3(0.0, 5.0, 9.0));
  camera.clip_from_camera = camera_at({0.0, 0.0, 0.0}).clip_from_camera;
  const auto in_shadow = project(camera, {0.0, 0.0, 0.5});
  const auto beside = project(camera, {2.5, 0.0, 0.5});
  for (const int passes : {1, 6}) {
    SceneLook look = plain_look();
    look.passes = passes;
    const charts::Image open = drawn(it, camera, look);
    look.shadows = true;
    const charts::Image image = drawn(it, camera, look);
    const int dark = at_share(image, in_shadow->x, in_shadow->y).light();
    EXPECT_LT(dark + 100, at_share(image, beside->x, beside->y).light()) << passes;
    EXPECT_LT(dark + 100, at_share(open, in_shadow->x, in_shadow->y).light()) << passes;
  }
}

TEST(SceneRenderer, TheGroundCatchesShadows) {
  DrawnWorld it;
  it.add(box(1.0), at(0.0, 0.0, 0.0), coloured(kRed));
  SceneLook look = plain_look();
  look.above = look.below = {1.0, 1.0, 1.0};
  look.shadows = true;
  look.ground = true;
  const auto scene = ScenePublisher().publish(it.world);
  const Camera camera = fit_scene(*scene, *view_direction("iso"), 1.0);
  int dark = 0;
  const charts::Image image = drawn(*scene, camera, look);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const auto* p = image.pixel(x, y);
      if (p[0] < 220 && std::abs(p[0] - p[1]) < 20) ++dark;
    }
  }
  EXPECT_GT(dark, 100);
}

TEST(SceneRenderer, TheSelectionHasALineAround) {
  DrawnWorld it;
  const auto chosen = it.add(box(1.0), at(0.0, 0.0, 0.0), coloured(kBlue));
  SceneLook look = plain_look();
  look.outlines = {{{chosen}, {0.0, 1.0, 0.0}}};
  const charts::Image image = drawn(it, camera_at({0.0, 0.0, 3.0}), look);
  EXPECT_TRUE(is_blue(middle(image)));
  bool found = false;
  for (int x = 0; x < kSide; ++x) found |= is_green(at_share(image, (x + 0.5) / kSide, 0.5));
  EXPECT_TRUE(found);
}

TEST(SceneRenderer, MarkersAreSeenAndFaintBehindThings) {
  DrawnWorld it;
  it.add(square(), at(1.0, 0.0, 1.0), coloured(kBlue));
  SceneLook look = plain_look();
  look.overlay.balls.push_back({{-0.7, 0.0, 0.0}, 0.3, {0.0, 1.0, 0.0}});
  look.overlay.balls.push_back({{0.7, 0.0, 0.0}, 0.3, {0.0, 1.0, 0.0}});
  look.overlay.lines.push_back({{{-1.0, -1.5, 0.0}, {1.0, -1.5, 0.0}}, {1.0, 0.0, 0.0}, 4.0});
  look.overlay.arrows.push_back({{-1.5, 0.0, 0.0}, {-1.5, 1.0, 0.0}, 0.08, {1.0, 0.0, 0.0}});
  const Camera camera = camera_at({0.0, 0.0, 4.0});
  const charts::Image image = drawn(it, camera, look);
  const auto colour_at = [&](const Vector3& p) {
    const auto seen = project(camera, p);
    return at_share(image, seen->x, seen->y);
  };
  EXPECT_TRUE(is_green(colour_at({-0.7, 0.0, 0.0})));
  const Rgb hidden = colour_at({0.7, 0.0, 0.0});
  EXPECT_GT(hidden.blue, 60);
  EXPECT_GT(hidden.green, 25);
  EXPECT_TRUE(is_red(colour_at({-0.5, -1.5, 0.0})));
  EXPECT_TRUE(is_red(colour_at({-1.5, 0.7, 0.0})));
}

TEST(SceneRenderer, DotsAreRoundOfOneSizeAndFaintBehindThings) {
  DrawnWorld it;
  it.add(square(), at(1.0, 0.0, 0.0), coloured(kBlue));
  SceneLook look = plain_look();
  const double bad = std::numeric_limits<double>::quiet_NaN();
  // On the square, before it, behind it; beside it far away.
  const Vector3 on(0.8, 0.0, 0.0), before(0.5, 0.4, 1.0), behind(0.9, -0.4, -1.0), far(-2.0, 0.0, -4.0);
  look.overlay.dots.push_back({{on, before, Vector3(bad, 0, 0), behind, far}, {0.0, 1.0, 0.0}, 9.0});
  look.overlay.dots.push_back({{}, {1.0, 0.0, 0.0}, 9.0});
  const Camera camera = camera_at({0.0, 0.0, 4.0});
  const charts::Image image = drawn(it, camera, look);
  const auto colour_at = [&](const Vector3& p, double right = 0.0, double up = 0.0) {
    const auto seen = project(camera, p);
    return at_share(image, seen->x + right / kSide, seen->y + up / kSide);
  };
  for (const Vector3& dot : {on, before, far}) {
    EXPECT_TRUE(is_green(colour_at(dot)));
    EXPECT_TRUE(is_green(colour_at(dot, 3.0, 0.0)));
    EXPECT_FALSE(is_green(colour_at(dot, 4.0, 4.0))) << "a square has corners";
    EXPECT_FALSE(is_green(colour_at(dot, 6.0, 0.0)));
  }
  const Rgb hidden = colour_at(behind);
  EXPECT_GT(hidden.blue, 60);
  EXPECT_GT(hidden.green, 25);
}

TEST(SceneRenderer, AnEmptySceneIsBackground) {
  SceneLook look;
  look.above = {0.0, 0.0, 1.0};
  look.below = {1.0, 0.0, 0.0};
  look.passes = 3;
  const charts::Image image = drawn(DrawnWorld(), camera_at({0.0, 0.0, 1.0}), look);
  EXPECT_TRUE(is_blue(at_share(image, 0.5, 0.02)));
  EXPECT_TRUE(is_red(at_share(image, 0.5, 0.98)));
}

TEST(SceneRenderer, ClearBackgroundsStayClear) {
  DrawnWorld it;
  it.add(box(1.0), at(0.0, 0.0, 0.0), coloured(kRed));
  SceneLook look = plain_look();
  look.above.alpha = look.below.alpha = 0.0;
  const charts::Image image = drawn(it, camera_at({0.0, 0.0, 3.0}), look);
  EXPECT_EQ(at_share(image, 0.02, 0.02).alpha, 0);
  EXPECT_EQ(middle(image).alpha, 255);
  EXPECT_TRUE(is_red(middle(image)));
}

TEST(SceneRenderer, TilesFitTogether) {
  DrawnWorld it;
  it.add(std::make_shared<world::PrimitiveGeometry>(geometry::Sphere{1.0}), at(0.0, 0.0, 0.0),
         coloured(kRed));
  const auto scene = ScenePublisher().publish(it.world);
  SceneLook look = plain_look();
  look.shadows = true;
  const Camera camera = camera_at({0.0, 0.0, 2.0});
  const charts::Image wide = drawn(*scene, camera, look, 2100, 40);  // two tiles
  for (int x = 1; x < wide.width; ++x) {
    const auto* a = wide.pixel(x - 1, 20);
    const auto* b = wide.pixel(x, 20);
    ASSERT_LT(std::abs(a[0] - b[0]), 40 + 255 * (a[0] < 5 || b[0] < 5)) << x;
  }
  EXPECT_TRUE(is_red(at_share(wide, 0.4999, 0.5)));
  EXPECT_TRUE(is_red(at_share(wide, 0.5001, 0.5)));
}

TEST(SceneRenderer, SizesHaveLimits) {
  const auto scene = ScenePublisher().publish({});
  for (const int side : {0, -1, 16385}) {
    EXPECT_FALSE(draw_picture(*scene, camera_at({0.0, 0.0, 1.0}), plain_look(), side, 10).has_value());
    EXPECT_FALSE(draw_picture(*scene, camera_at({0.0, 0.0, 1.0}), plain_look(), 10, side).has_value());
  }
}

TEST(SceneRenderer, MillimetresLookLikeMetres) {
  int middles[2];
  for (const int milli : {0, 1}) {
    const double unit = milli ? 1e-3 : 1.0;
    DrawnWorld it;
    it.add(box(unit), at(3e3 * unit, 0.0, 0.0), coloured(kRed));
    it.add(box(unit), at(3001.5 * unit, 0.0, 0.0), coloured(kGreen));
    const auto scene = ScenePublisher().publish(it.world);
    SceneLook look = plain_look();
    look.shadows = true;
    const charts::Image image = drawn(*scene, fit_scene(*scene, *view_direction("front"), 1.0), look);
    middles[milli] = at_share(image, 0.25, 0.5).red;
    EXPECT_TRUE(is_red(at_share(image, 0.25, 0.5)));
    EXPECT_TRUE(is_green(at_share(image, 0.75, 0.5)));
  }
  EXPECT_NEAR(middles[0], middles[1], 3);
}

TEST(SceneRenderer, WhatHasNoPlaceOrNoAreaHarmsNothing) {
  DrawnWorld it;
  base::Affine3 thin = base::Affine3::Identity();
  thin.linear().diagonal() << 1e-9, 1.0, 1.0;
  it.add(box(1.0), thin, coloured(kGreen));
  auto bad = square();
  bad->mesh.positions[0].x() = std::nan("");
  bad->normals.assign(2, {Vector3::Zero(), Vector3::Constant(std::nan("")), Vector3::UnitZ()});
  it.add(bad, at(0.0, 0.0, -3.0), coloured(kBlue));
  it.add(box(1.0), at(0.0, 0.0, 0.0), coloured(kRed));
  SceneLook look = plain_look();
  look.shadows = true;
  EXPECT_TRUE(is_red(middle(drawn(it, camera_at({0.0, 0.0, 3.0}), look))));
}

}  // namespace
}  // namespace icome::render
