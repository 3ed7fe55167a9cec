// Pictures for both eyes, and through the screen as a window, judged by the geometry of the eyes.
#include <cmath>
#include <functional>

#include "base/random.h"
#include "interaction/screen_view.h"
#include "render/live_renderer.h"
#include "render/pictures/stereo_picture.h"
#include "repeats.h"
#include "session/display/display_feed.h"

namespace icome::session {
namespace {

using base::Vector2;
using base::Vector3;
using interaction::StereoKind;
using interaction::View;
using render::LiveRenderer;

#define REQUIRE_OPENGL() \
  if (!render::Offscreen::create()) GTEST_SKIP() << "there is no OpenGL without a window here"

constexpr int kWide = 240, kHigh = 160;  // pixels
constexpr double kDistance = 2.0;        // m, from the eye at rest to the plane without parallax
constexpr double kEyes = 0.2;            // m, apart

View at_rest() {
  View view;
  view.world_from_eye = base::Pose(Eigen::Translation3d(0.0, 0.0, kDistance));
  view.distance = kDistance;
  view.field = 0.8;
  return view;
}

View eye_aside(double aside) { return interaction::seen_from(at_rest(), {aside * kEyes, 0.0, 0.0}); }

DisplayWish wish_of(StereoKind kind, bool squeezed = false) {
  DisplayWish wish;
  wish.view = at_rest();
  wish.left = eye_aside(-0.5);
  wish.right = eye_aside(0.5);
  wish.stereo = {kind, kEyes, squeezed};
  wish.look = render::plain_look();
  wish.look.passes = 3;
  return wish;
}

render::RenderScenePointer scene_with_cube(const Vector3& centre, double size) {
  render::DrawnWorld it;
  world::Material white = render::coloured({1.0F, 1.0F, 1.0F});
  white.emission = {1.0F, 1.0F, 1.0F};
  it.add(world::box(size), world::at(centre.x(), centre.y(), centre.z()), white);
  return render::ScenePublisher().publish(it.world);
}

/// The picture that a feed draws in the end, rows from the top.
charts::Image eyes_picture(const render::RenderScenePointer& scene, const DisplayWish& wish,
                           const std::optional<Vector3>& tip = std::nullopt, int width = kWide,
                           int height = kHigh) {
  LiveRenderer live(width, height);
  DisplayFeed feed(1);
  feed.publish(scene);
  feed.wish(wish);
  if (tip) {
    PointerView pointer;
    pointer.time = 1;
    pointer.status = devices::DeviceStatus::Ok;
    pointer.tip = pointer.scp = *tip;
    feed.publish(0, pointer);
  }
  for (int i = 0; i < 100 && feed.is_due(); ++i) {
    const auto drawn = feed.draw(live.renderer(), live.target());
    EXPECT_TRUE(drawn) << (drawn ? "" : drawn.error().message);
  }
  charts::Image image{width, height, std::vector<std::uint8_t>(4 * std::size_t(width) * std::size_t(height))};
  std::vector<std::uint8_t> rows(image.rgba.size());
  glBindFramebuffer(GL_FRAMEBUFFER, live.target().frame);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
  const std::size_t row = 4 * std::size_t(width);
  for (std::size_t y = 0; y < std::size_t(height); ++y)
    std::copy_n(&rows[(std::size_t(height) - 1 - y) * row], row, &image.rgba[y * row]);
  return image;
}

charts::Image part_of(const charts::Image& image, int left, int top, int width, int height) {
  charts::Image part{width, height, {}};
  for (int y = 0; y < height; ++y) {
    const auto* row = image.pixel(left, top + y);
    part.rgba.insert(part.rgba.end(), row, row + 4 * std::size_t(width));
  }
  return part;
}

/// The middle of what is seen in a channel, as shares of the picture's half sides to the right and up.
Vector2 middle_of(const charts::Image& image, const std::function<double(const std::uint8_t*)>& weight) {
  double sum = 0.0;
  Vector2 middle = Vector2::Zero();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double here = weight(image.pixel(x, y));
      sum += here;
      middle += here * Vector2(2.0 * (x + 0.5) / image.width - 1.0, 1.0 - 2.0 * (y + 0.5) / image.height);
    }
  EXPECT_GT(sum, 0.0) << "nothing is seen";
  return middle / sum;
}

/// Place of a point in the picture of an eye that lies `aside` to the right of the middle, by similar
/// triangles: on the plane without parallax, then in shares of its half sides.
Vector2 expected_place(const Vector3& point, double aside, double aspect) {
  const double half = std::tan(0.4) * kDistance;  // of the shorter side, m
  const double nearer = kDistance / (kDistance - point.z());
  const Vector2 on_plane(aside + (point.x() - aside) * nearer, point.y() * nearer);
  return on_plane.cwiseQuotient(half * Vector2(std::max(1.0, aspect), std::max(1.0, 1.0 / aspect)));
}

TEST(StereoDisplay, CornersOfTheScreenAreThoseOfThePictureForEveryEye) {
  base::Random random(1);
  for (int i = 0; i < repeats(100'000); ++i) {
    View view = at_rest();
    view.world_from_eye = Eigen::Translation3d(random.uniform(0.0, 3.0) * random.direction()) *
                          Eigen::AngleAxisd(random.uniform(-3.0, 3.0), random.direction());
    const Vector2 half(random.uniform(0.1, 1.0), random.uniform(0.1, 1.0));  // of the screen, m
    view.field = 2.0 * std::atan(half.minCoeff() / kDistance);
    const View seen = interaction::seen_from(
        view, {random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-1.0, 2.0)});
    const render::Matrix4 clip_from_eye =
        render::lens_for(seen.world_from_eye.inverse(), {}, seen.field, half.x() / half.y(), seen.shift);
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0}) {
        const Vector3 corner = view.world_from_eye * Vector3(x * half.x(), y * half.y(), -kDistance);
        const Eigen::Vector4d clip = clip_from_eye * (seen.world_from_eye.inverse() * corner).homogeneous();
        ASSERT_GT(clip.w(), 0.0);
        ASSERT_NEAR(clip.x() / clip.w(), x, 1e-9);
        ASSERT_NEAR(clip.y() / clip.w(), y, 1e-9);
      }
  }
}

TEST(StereoDisplay, ThePairHasTheParallaxOfItsDepth) {
  REQUIRE_OPENGL();
  for (const double z : {-3.0, 0.0, 0.7}) {
    const Vector3 point(0.1, 0.15, z);
    // A small cube is in the picture where its middle is, as far as its faces' sizes do not differ.
    const charts::Image both =
        eyes_picture(scene_with_cube(point, 0.02 * (kDistance - z)), wish_of(StereoKind::SideBySide));
    const double aspect = 0.5 * kWide / kHigh;
    for (const int side : {0, 1}) {
      const charts::Image one = part_of(both, side * kWide / 2, 0, kWide / 2, kHigh);
      const Vector2 found = middle_of(one, [](const auto* pixel) { return double(pixel[1]); });
      const Vector2 place = expected_place(point, (side - 0.5) * kEyes, aspect);
      EXPECT_NEAR(found.x(), place.x(), 1.5 / one.width) << z << " " << side;
      EXPECT_NEAR(found.y(), place.y(), 1.5 / one.height) << z << " " << side;
    }
  }
}

TEST(StereoDisplay, AnaglyphHasTheChannelsOfEachEye) {
  REQUIRE_OPENGL();
  const auto scene = scene_with_cube({0.1, 0.0, 0.4}, 0.5);
  const charts::Image both = eyes_picture(scene, wish_of(StereoKind::Anaglyph));
  DisplayWish alone = wish_of(StereoKind::Off);
  alone.view = eye_aside(-0.5);
  const charts::Image left = eyes_picture(scene, alone);
  alone.view = eye_aside(0.5);
  const charts::Image right = eyes_picture(scene, alone);
  EXPECT_NE(left.rgba, right.rgba);
  for (std::size_t i = 0; i < both.rgba.size(); i += 4) {
    ASSERT_EQ(both.rgba[i], left.rgba[i]);
    ASSERT_EQ(both.rgba[i + 1], right.rgba[i + 1]);
    ASSERT_EQ(both.rgba[i + 2], right.rgba[i + 2]);
  }
  // The way of files gives the same.
  EXPECT_EQ(render::stereo_picture(left, right, render::StereoLayout::Anaglyph).rgba, both.rgba);
}

TEST(StereoDisplay, HalvesAreThePicturesOfTheEyes) {
  REQUIRE_OPENGL();
  const auto scene = scene_with_cube({0.1, 0.2, 0.4}, 0.5);
  DisplayWish left = wish_of(StereoKind::Off), right = left;
  left.view = eye_aside(-0.5);
  right.view = eye_aside(0.5);
  for (const auto kind : {StereoKind::SideBySide, StereoKind::TopBottom}) {
    const bool aside = kind == StereoKind::SideBySide;
    const int width = aside ? kWide / 2 : kWide, height = aside ? kHigh : kHigh / 2;
    const charts::Image both = eyes_picture(scene, wish_of(kind));
    EXPECT_EQ(part_of(both, 0, 0, width, height).rgba, eyes_picture(scene, left, {}, width, height).rgba);
    EXPECT_EQ(part_of(both, kWide - width, kHigh - height, width, height).rgba,
              eyes_picture(scene, right, {}, width, height).rgba);
  }
}

TEST(StereoDisplay, SqueezedHalvesHoldTheWholePicture) {
  REQUIRE_OPENGL();
  const Vector3 point(0.6, -0.3, 0.0);
  const charts::Image both =
      eyes_picture(scene_with_cube(point, 0.05), wish_of(StereoKind::SideBySide, true));
  const Vector2 found =
      middle_of(part_of(both, 0, 0, kWide / 2, kHigh), [](const auto* p) { return double(p[1]); });
  const Vector2 place = expected_place(point, -0.5 * kEyes, double(kWide) / kHigh);
  EXPECT_NEAR(found.x(), place.x(), 3.0 / kWide);
  EXPECT_NEAR(found.y(), place.y(), 2.0 / kHigh);
}

TEST(StereoDisplay, ThePointerIsAtItsPlaceInBothEyes) {
  REQUIRE_OPENGL();
  const Vector3 tip(-0.2, 0.1, 0.8);
  DisplayWish wish = wish_of(StereoKind::TopBottom);
  wish.marker_size = 0.02;
  const charts::Image both = eyes_picture(std::make_shared<const render::RenderScene>(), wish, tip);
  for (const int side : {0, 1}) {
    const charts::Image one = part_of(both, 0, side * kHigh / 2, kWide, kHigh / 2);
    const Vector2 found = middle_of(one, [](const auto* p) { return p[2] > 40 ? 1.0 : 0.0; });
    const Vector2 place = expected_place(tip, (side - 0.5) * kEyes, 2.0 * kWide / kHigh);
    EXPECT_NEAR(found.x(), place.x(), 2.0 / one.width) << side;
    EXPECT_NEAR(found.y(), place.y(), 2.0 / one.height) << side;
  }
}

TEST(StereoDisplay, PanelsThatLieInTheSceneAreDrawnForBothEyes) {
  REQUIRE_OPENGL();
  auto panel = std::make_shared<charts::Image>();
  *panel = {8, 8, std::vector<std::uint8_t>(8 * 8 * 4, 255)};
  DisplayWish wish = wish_of(StereoKind::SideBySide);
  const Vector3 centre(0.1, 0.0, 0.5);
  wish.look.overlay.panels.push_back(
      {.picture = panel, .at = centre, .lying = std::array{Vector3(0.1, 0.0, 0.0), Vector3(0.0, 0.1, 0.0)}});
  const charts::Image both = eyes_picture(std::make_shared<const render::RenderScene>(), wish);
  for (const int side : {0, 1}) {
    const charts::Image one = part_of(both, side * kWide / 2, 0, kWide / 2, kHigh);
    const Vector2 found = middle_of(one, [](const auto* p) { return double(p[1]); });
    EXPECT_NEAR(found.x(), expected_place(centre, (side - 0.5) * kEyes, 0.5 * kWide / kHigh).x(),
                1.5 / one.width);
  }
}

}  // namespace
}  // namespace icome::session
