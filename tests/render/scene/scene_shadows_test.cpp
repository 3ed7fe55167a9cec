#include "render/scene/scene_shadows.h"

#include "base/random.h"
#include "render/live_renderer.h"

namespace icome::render {
namespace {

using base::Bounds;
using world::at;
using world::box;

TEST(SteadyRegion, HoldsTheRegionAndNoMoreThanTheWhole) {
  base::Random random(7);
  const Bounds whole(Vector3(-3.0, 0.0, -2.0), Vector3(5.0, 1.0, 2.0));
  const double most = 0.5 * whole.sizes().norm();
  for (int i = 0; i < 1000; ++i) {
    const ShadowRegion region{
        Vector3(random.uniform(-3.0, 5.0), random.uniform(0.0, 1.0), random.uniform(-2.0, 2.0)),
        most * std::pow(10.0, random.uniform(-4.0, 0.0))};
    const ShadowRegion steady = steady_region(region, whole);
    EXPECT_LE(steady.radius, most);
    if (steady.radius < most) {
      EXPECT_GE(steady.radius, (steady.centre - region.centre).norm() + region.radius);
      EXPECT_LT(steady.radius, 3.0 * region.radius);
    }
  }
}

TEST(SteadyRegion, StaysWhileTheViewMovesALittle) {
  const Bounds whole(Vector3::Constant(-1.0), Vector3::Constant(1.0));
  const ShadowRegion one = steady_region({{0.11, 0.21, 0.02}, 0.100}, whole);
  const ShadowRegion other = steady_region({{0.115, 0.205, 0.021}, 0.103}, whole);
  EXPECT_EQ(one.centre, other.centre);
  EXPECT_EQ(one.radius, other.radius);
}

DrawnWorld shaded_plate(double away) {
  DrawnWorld it;
  it.add(std::make_shared<world::PrimitiveGeometry>(geometry::Box{Vector3(2.0, 0.05, 2.0)}),
         at(0.0, 0.0, 0.0), coloured({0.8F, 0.8F, 0.8F}));
  it.add(box(0.6), at(away, 0.5, 0.0), coloured(kRed));
  return it;
}

TEST(SceneShadowMaps, FollowWhatMoves) {
  const Camera camera =
      fit_scene(*ScenePublisher().publish(shaded_plate(-1.0).world), *view_direction("iso"), 1.0);
  const auto here = ScenePublisher().publish(shaded_plate(-0.5).world);
  const auto there = ScenePublisher().publish(shaded_plate(0.7).world);
  const SceneLook look;
  const charts::Image alone = LiveRenderer().draw(*there, camera, look);
  LiveRenderer live;
  live.draw(*here, camera, look);
  EXPECT_EQ(live.draw(*there, camera, look).rgba, alone.rgba);
}

TEST(SceneShadowMaps, AreTheSameFromWhereverOneComes) {
  const auto scene = ScenePublisher().publish(shaded_plate(0.2).world);
  const Camera camera = fit_scene(*scene, *view_direction("iso"), 1.0);
  const SceneLook look;
  const charts::Image alone = LiveRenderer().draw(*scene, camera, look);
  LiveRenderer live;
  live.draw(*scene, fit_scene(*scene, *view_direction("front"), 1.0), look);
  EXPECT_EQ(live.draw(*scene, camera, look).rgba, alone.rgba);
}

}  // namespace
}  // namespace icome::render
