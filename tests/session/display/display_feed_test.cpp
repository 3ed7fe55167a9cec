// What the display thread is given to draw, without a session.
#include "session/display/display_feed.h"

#include <limits>

#include "render/live_renderer.h"

namespace icome::session {
namespace {

using base::Vector3;
using render::LiveRenderer;
using world::at;
using world::box;

#define REQUIRE_OPENGL() \
  if (!render::Offscreen::create()) GTEST_SKIP() << "there is no OpenGL without a window here"

render::RenderScenePointer scene_with_box(const base::Affine3& place) {
  render::DrawnWorld it;
  it.add(box(1.0), place, render::coloured(render::kRed));
  return render::ScenePublisher().publish(it.world);
}

/// From 5 m away, before black, refined so often.
DisplayWish plain_wish(int passes = 1) {
  DisplayWish wish;
  wish.view.world_from_eye.translation() = Vector3(0.0, 0.0, 5.0);
  wish.look = render::plain_look();
  wish.look.passes = passes;
  return wish;
}

PointerView pointer_at(const Vector3& place) {
  PointerView pointer;
  pointer.time = 1;
  pointer.status = devices::DeviceStatus::Ok;
  pointer.tip = pointer.scp = place;
  return pointer;
}

void draw(DisplayFeed& feed, LiveRenderer& live) {
  const auto drawn = feed.draw(live.renderer(), live.target());
  EXPECT_TRUE(drawn) << (drawn ? "" : drawn.error().message);
}

/// Draws for as long as there is something to draw.
int draw_all(DisplayFeed& feed, LiveRenderer& live) {
  int frames = 0;
  while (feed.is_due() && frames < 1000) {
    draw(feed, live);
    ++frames;
  }
  return frames;
}

charts::Image picture(DisplayFeed& feed, LiveRenderer& live) {
  draw(feed, live);
  charts::Image image{live.target().width, live.target().height, {}};
  image.rgba.resize(4 * std::size_t(image.width) * std::size_t(image.height));
  glBindFramebuffer(GL_FRAMEBUFFER, live.target().frame);
  glReadPixels(0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  return image;
}

/// Pixels that are clearly of the tip's colour.
int blue_pixels(const charts::Image& image) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    count += image.rgba[i + 2] > 80 && image.rgba[i + 2] > 2 * image.rgba[i] ? 1 : 0;
  return count;
}

TEST(DisplayFeed, DrawsWhereThereIsNewsAndRefinesWhereThereIsNone) {
  REQUIRE_OPENGL();
  LiveRenderer live;
  DisplayFeed feed(1);
  EXPECT_TRUE(feed.is_due());  // an empty picture
  feed.publish(scene_with_box(at(0.0, 0.0, 0.0)));
  feed.wish(plain_wish(6));
  EXPECT_EQ(draw_all(feed, live), 6);
  EXPECT_FALSE(feed.is_due());
  feed.wish(plain_wish(6));  // the same: only what is drawn over it may be another
  EXPECT_EQ(draw_all(feed, live), 1);
  feed.publish(scene_with_box(at(1.0, 0.0, 0.0)));
  EXPECT_EQ(draw_all(feed, live), 6);
  DisplayWish turned = plain_wish(6);
  turned.view.world_from_eye.translation().x() = 0.1;
  feed.wish(turned);
  EXPECT_EQ(draw_all(feed, live), 6);
  EXPECT_EQ(feed.frames(), 19U);
  EXPECT_EQ(feed.recorder().summary().ticks, 19U);
}

TEST(DisplayFeed, DrawsTheHandAnewOnlyWhenItMovesToBeSeen) {
  REQUIRE_OPENGL();
  LiveRenderer live;
  DisplayFeed feed(1);
  feed.publish(scene_with_box(at(0.0, 0.0, 0.0)));
  feed.wish(plain_wish(4));
  feed.publish(0, pointer_at({1.2, 0.0, 1.0}));
  EXPECT_EQ(draw_all(feed, live), 4);
  feed.publish(0, pointer_at({1.2 + 1e-4, 0.0, 1.0}));  // 1/300 of a pixel
  EXPECT_EQ(draw_all(feed, live), 0);
  feed.publish(0, pointer_at({1.0, 0.0, 1.0}));
  EXPECT_EQ(draw_all(feed, live), 1);  // over the picture that is refined
  PointerView lost = pointer_at({1.0, 0.0, 1.0});
  lost.status = devices::DeviceStatus::Lost;
  feed.publish(0, lost);
  EXPECT_EQ(draw_all(feed, live), 4);  // the lens need not reach so near any more
}

TEST(DisplayFeed, BeginsAnewWithAnotherGround) {
  REQUIRE_OPENGL();
  LiveRenderer live;
  DisplayFeed feed(0);
  DisplayWish wish = plain_wish(4);
  feed.publish(scene_with_box(at(0.0, 0.0, 0.0)));
  feed.wish(wish);
  EXPECT_EQ(draw_all(feed, live), 4);
  wish.look.grid = true;
  feed.wish(wish);
  EXPECT_EQ(draw_all(feed, live), 4);
  wish.look.x_axis.red += 0.1;
  feed.wish(wish);
  EXPECT_EQ(draw_all(feed, live), 4);
}

TEST(DisplayFeed, ShowsATipThatComesNearBeforeWhatIsBehindIt) {
  REQUIRE_OPENGL();
  LiveRenderer live;
  DisplayFeed feed(1);
  feed.publish(scene_with_box(at(0.0, 0.0, 0.0)));
  DisplayWish wish = plain_wish(2);
  wish.marker_size = 0.05;
  feed.wish(wish);
  feed.publish(0, pointer_at({0.0, 0.0, 1.0}));
  draw_all(feed, live);
  for (const double z : {3.1, 4.3, 2.0, 0.6}) {
    feed.publish(0, pointer_at({0.0, 0.0, z}));
    EXPECT_TRUE(feed.is_due());
    EXPECT_GT(blue_pixels(picture(feed, live)), 0) << z;
  }
}

TEST(DisplayFeed, ShowsTipsAlsoBeforeAndBehindTheScene) {
  REQUIRE_OPENGL();
  LiveRenderer live;
  for (const double z : {4.9, 3.0, 0.0, -20.0, -500.0}) {
    DisplayFeed feed(2);  // the other has not been heard of
    feed.publish(scene_with_box(at(0.0, 0.0, 0.0)));
    DisplayWish wish = plain_wish();
    wish.marker_size = 0.05;
    const double aside = 0.2 * (5.0 - z);
    feed.publish(0, pointer_at({aside, 0.0, z}));
    feed.wish(wish);
    const int shown = blue_pixels(picture(feed, live));
    EXPECT_GT(shown, 20) << z;
    EXPECT_LT(shown, 400) << z;  // of the same size, however far
    wish.pointers = false;
    feed.wish(wish);
    EXPECT_EQ(blue_pixels(picture(feed, live)), 0) << z;
  }
}

TEST(DisplayFeed, ShowsDotsAlsoBeforeAndBehindTheScene) {
  REQUIRE_OPENGL();
  LiveRenderer live;
  for (const double z : {4.9, 3.0, 0.0, -20.0, -500.0}) {
    DisplayFeed feed(0);
    feed.publish(scene_with_box(at(0.0, 0.0, 0.0)));
    DisplayWish wish = plain_wish();
    const double nowhere = std::numeric_limits<double>::quiet_NaN();
    wish.look.overlay.dots.push_back(
        {{Vector3(0.2 * (5.0 - z), 0.0, z), Vector3::Constant(nowhere)}, {0.16, 0.47, 0.90}, 9.0});
    feed.wish(wish);
    const int shown = blue_pixels(picture(feed, live));
    EXPECT_GT(shown, 20) << z;
    EXPECT_LT(shown, 120) << z;
  }
}

TEST(DisplayFeed, PassesOverPointersThatAreNowhere) {
  REQUIRE_OPENGL();
  LiveRenderer live;
  DisplayFeed feed(1);
  feed.publish(scene_with_box(at(0.0, 0.0, 0.0)));
  feed.wish(plain_wish());
  draw_all(feed, live);
  feed.publish(0, pointer_at(Vector3::Constant(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_EQ(draw_all(feed, live), 0);
  feed.publish(0, pointer_at({0.0, 0.0, 5.0}));  // in the eye
  draw_all(feed, live);
  feed.publish(0, pointer_at({0.0, 0.0, 50.0}));  // behind it
  draw_all(feed, live);
  EXPECT_EQ(blue_pixels(picture(feed, live)), 0);
}

TEST(DisplayFeed, BeginsAnewInAWindowOfAnotherSize) {
  REQUIRE_OPENGL();
  LiveRenderer live;
  DisplayFeed feed(0);
  feed.publish(scene_with_box(at(0.0, 0.0, 0.0)));
  feed.wish(plain_wish(3));
  EXPECT_EQ(draw_all(feed, live), 3);
  live.resize(50, 70);
  draw(feed, live);  // as for an expose event
  EXPECT_EQ(draw_all(feed, live), 2);
}

TEST(DisplayFeed, WritesBesideAHandWhoseForceIsHeldDown) {
  REQUIRE_OPENGL();
  LiveRenderer live;
  DisplayFeed feed(1);
  feed.publish(scene_with_box(at(0.0, 0.0, 0.0)));
  DisplayWish wish = plain_wish();
  auto sign = std::make_shared<charts::Image>(charts::Image{24, 12, {}});
  for (int i = 0; i < 24 * 12; ++i) sign->rgba.insert(sign->rgba.end(), {0, 0, 255, 255});
  wish.spared_sign = sign;
  feed.wish(wish);
  PointerView pointer = pointer_at({0.0, 0.0, 1.0});
  feed.publish(0, pointer);
  const int ball = blue_pixels(picture(feed, live));
  pointer.spared = true;
  feed.publish(0, pointer);
  EXPECT_TRUE(feed.is_due()) << "though the hand rests";
  EXPECT_NEAR(blue_pixels(picture(feed, live)) - ball, 24 * 12, 24);
  pointer.spared = false;
  feed.publish(0, pointer);
  EXPECT_TRUE(feed.is_due());
  EXPECT_EQ(blue_pixels(picture(feed, live)), ball);
}

}  // namespace
}  // namespace icome::session
