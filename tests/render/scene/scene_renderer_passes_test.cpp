// Pictures that are bettered pass by pass, as windows show them.
#include "render/live_renderer.h"

namespace icome::render {
namespace {

using world::at;
using world::box;

constexpr int kPasses = 12;

DrawnWorld still_life() {
  DrawnWorld it;
  it.add(box(1.0), at(0.0, 0.0, 0.0), coloured(kRed));
  it.add(std::make_shared<world::PrimitiveGeometry>(geometry::Sphere{0.4}), at(0.9, -0.1, 0.3),
         coloured(kGreen, 0.4F));
  return it;
}

SceneLook refined_look() {
  SceneLook look;
  look.passes = kPasses;
  return look;
}

TEST(SceneRendererPasses, AllTogetherAreThePicture) {
  const auto scene = ScenePublisher().publish(still_life().world);
  const Camera camera = fit_scene(*scene, *view_direction("iso"), 1.0);
  const charts::Image whole = LiveRenderer().draw(*scene, camera, refined_look());
  LiveRenderer live;
  charts::Image image;
  double before = 255.0;
  for (int number = 0; number < kPasses; ++number) {
    image = live.draw_pass(*scene, camera, refined_look(), number);
    const double now = mean_difference(image, whole);
    EXPECT_LT(now, before + 0.5) << number;
    before = now;
  }
  EXPECT_EQ(image.rgba, whole.rgba);
  EXPECT_EQ(live.draw_pass(*scene, camera, refined_look(), kPasses + 5).rgba, whole.rgba);
}

TEST(SceneRendererPasses, TheFirstIsWhatAMovingViewShows) {
  const auto scene = ScenePublisher().publish(still_life().world);
  const Camera camera = fit_scene(*scene, *view_direction("iso"), 1.0);
  SceneLook moving = refined_look();
  moving.passes = 1;
  const charts::Image at_once = LiveRenderer().draw(*scene, camera, moving);
  LiveRenderer live;
  EXPECT_EQ(live.draw_pass(*scene, camera, refined_look(), 0).rgba, at_once.rgba);
  // Whatever was before.
  live.draw_pass(*scene, camera, refined_look(), 3);
  EXPECT_EQ(live.draw_pass(*scene, camera, refined_look(), 0).rgba, at_once.rgba);
  EXPECT_EQ(live.draw_pass(*scene, camera, moving, 7).rgba, at_once.rgba);
}

TEST(SceneRendererPasses, EvenTheFirstIsMuchLikeTheLast) {
  const auto scene = ScenePublisher().publish(still_life().world);
  const Camera camera = fit_scene(*scene, *view_direction("iso"), 1.0);
  LiveRenderer live;
  const charts::Image first = live.draw_pass(*scene, camera, refined_look(), 0);
  EXPECT_LT(mean_difference(first, live.draw_pass(*scene, camera, refined_look(), kPasses)), 8.0);
}

TEST(SceneRendererPasses, PassesMayBeLeftOut) {
  const auto scene = ScenePublisher().publish(still_life().world);
  const Camera camera = fit_scene(*scene, *view_direction("iso"), 1.0);
  const charts::Image whole = LiveRenderer().draw(*scene, camera, refined_look());
  LiveRenderer live;
  // Without a first one, and with some that were not called for.
  live.draw_pass(*scene, camera, refined_look(), 4);
  EXPECT_EQ(live.draw_pass(*scene, camera, refined_look(), kPasses - 1).rgba, whole.rgba);
}

TEST(SceneRendererPasses, TheHandMovesOverARefinedPicture) {
  const auto scene = ScenePublisher().publish(still_life().world);
  const Camera camera = fit_scene(*scene, *view_direction("iso"), 1.0);
  SceneLook touched = refined_look();
  const Vector3 tip(-0.3, 0.6, 0.5);
  touched.overlay.balls.push_back({tip, 0.08, {0.0, 0.0, 1.0}});
  const charts::Image anew = LiveRenderer().draw(*scene, camera, touched);
  LiveRenderer live;
  const charts::Image whole = live.draw(*scene, camera, refined_look());
  const charts::Image with_tip = live.draw_pass(*scene, camera, touched, kPasses);
  const auto seen = project(camera, tip);
  EXPECT_TRUE(is_blue(at_share(with_tip, seen->x, seen->y)));
  // Nothing stays of it.
  EXPECT_EQ(live.draw_pass(*scene, camera, refined_look(), kPasses).rgba, whole.rgba);
  EXPECT_EQ(with_tip.rgba, anew.rgba);
}

TEST(SceneRendererPasses, AnotherSizeBeginsAnew) {
  const auto scene = ScenePublisher().publish(still_life().world);
  const Camera camera = fit_scene(*scene, *view_direction("iso"), 1.0);
  const charts::Image small = LiveRenderer(64, 64).draw(*scene, camera, refined_look());
  LiveRenderer live;
  live.draw_pass(*scene, camera, refined_look(), 0);
  live.draw_pass(*scene, camera, refined_look(), 5);
  live.resize(64, 64);
  EXPECT_EQ(live.draw_pass(*scene, camera, refined_look(), kPasses - 1).rgba, small.rgba);
}

TEST(SceneRendererPasses, SizesHaveLimits) {
  const auto scene = ScenePublisher().publish({});
  LiveRenderer live;
  SceneTarget target = live.target();
  target.width = 0;
  EXPECT_FALSE(live.renderer().draw_pass(*scene, camera_at({0.0, 0.0, 1.0}), {}, target, 0).has_value());
}

}  // namespace
}  // namespace icome::render
