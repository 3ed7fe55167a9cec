#include "render/scene/scene_grid.h"

#include "render/live_renderer.h"

namespace icome::render {
namespace {

using world::at;
using world::box;

/// From above and in front, at that distance from the origin.
Camera over_the_ground(double distance, double height_share) {
  ViewDirection direction{"", Vector3(0.0, height_share, 1.0), Vector3::UnitY()};
  FitOptions options;
  options.toward_eye = direction.toward_eye;
  options.aspect = 1.0;
  const std::array<Vector3, 2> ends = {Vector3(-0.2 * distance, 0.0, 0.0), Vector3(0.2 * distance, 0.0, 0.0)};
  return fit_camera(ends, options);
}

SceneLook grid_look() {
  SceneLook look = plain_look();
  look.grid = true;
  look.grid_colour = {0.0, 1.0, 0.0, 1.0};
  look.x_axis = {1.0, 0.0, 0.0, 1.0};
  look.z_axis = {0.0, 0.0, 1.0, 1.0};
  return look;
}

std::size_t count(const charts::Image& image, bool (*is)(const Rgb&)) {
  std::size_t found = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto* p = image.pixel(x, y);
      found += is({p[0], p[1], p[2], p[3]}) ? 1 : 0;
    }
  }
  return found;
}

TEST(GridPlan, CellsSuitTheView) {
  for (const double distance : {1e-3, 0.02, 0.5, 7.0, 300.0, 4e4}) {
    const Camera camera = over_the_ground(distance, 0.7);
    const auto plan = plan_grid(camera);
    ASSERT_TRUE(plan.has_value());
    const double decade = std::log10(plan->cell);
    EXPECT_NEAR(decade, std::round(decade), 1e-9);
    EXPECT_GT(plan->cell, 2e-4 * distance);
    EXPECT_LT(plan->cell, 0.3 * distance);
    EXPECT_GE(plan->fineness, 0.0);
    EXPECT_LT(plan->fineness, 1.0);
  }
}

TEST(GridPlan, NothingFromWithinThePlane) {
  Camera camera = camera_at({0.0, 0.0, 2.0});
  EXPECT_FALSE(plan_grid(camera).has_value());
  camera.camera_from_world.translation().x() = std::nan("");
  EXPECT_FALSE(plan_grid(camera).has_value());
}

TEST(SceneGrid, IsSeenFromAboveAndBelowWithItsAxes) {
  const auto scene = ScenePublisher().publish({});
  for (const double side : {0.7, -0.7}) {
    for (const double distance : {0.05, 50.0}) {
      LiveRenderer live(192, 192);
      const charts::Image image = live.draw(*scene, over_the_ground(distance, side), grid_look());
      EXPECT_GT(count(image, is_green), 300U) << side << " " << distance;
      EXPECT_GT(count(image, is_red), 60U) << side << " " << distance;
      EXPECT_GT(count(image, is_blue), 60U) << side << " " << distance;
      EXPECT_GT(count(image, is_black), 6000U) << side << " " << distance;
    }
  }
}

TEST(SceneGrid, LinesGoThroughWholeCells) {
  const auto scene = ScenePublisher().publish({});
  const Camera camera = over_the_ground(1.0, 0.7);
  const double cell = 10.0 * plan_grid(camera)->cell;
  LiveRenderer live(384, 384);
  const charts::Image image = live.draw(*scene, camera, grid_look());
  for (const int i : {-1, 1}) {
    const auto on = project(camera, {i * cell, 0.0, 0.0316 * cell});
    ASSERT_TRUE(on.has_value());
    EXPECT_TRUE(is_green(at_share(image, on->x, on->y))) << i;
  }
}

TEST(SceneGrid, LiesBehindWhatStandsOnItAndIsOffByDefault) {
  DrawnWorld it;
  it.add(box(0.2), at(0.0, 0.1, 0.0), coloured({0.8F, 0.8F, 0.0F}));
  const auto scene = ScenePublisher().publish(it.world);
  const Camera camera = over_the_ground(1.0, 0.7);
  const auto front = project(camera, {0.0, 0.1, 0.1});
  const charts::Image image = LiveRenderer().draw(*scene, camera, grid_look());
  const Rgb seen = at_share(image, front->x, front->y);
  EXPECT_GT(seen.red, 60);
  EXPECT_LT(seen.blue, 20);
  EXPECT_EQ(count(LiveRenderer().draw(*scene, camera, plain_look()), is_green), 0U);
}

}  // namespace
}  // namespace icome::render
