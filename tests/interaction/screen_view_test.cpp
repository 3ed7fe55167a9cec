#include "interaction/screen_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "repeats.h"

namespace icome::interaction {
namespace {

View random_view(base::Random& random) {
  View view;
  view.world_from_eye = Eigen::Translation3d(random.uniform(-1.0, 1.0) * random.direction()) *
                        Eigen::AngleAxisd(random.uniform(-3.0, 3.0), random.direction());
  view.field = random.uniform(0.2, 1.2);
  view.distance = random.uniform(0.1, 5.0);
  return usable(view);
}

/// The corner of the window of a view, by its definition; signs of its place.
Vector3 corner(const View& view, double x, double y, double aspect) {
  const Eigen::Vector2d half = half_picture(view, aspect);
  return view.world_from_eye * Vector3(view.distance * Vector3(x * half.x(), y * half.y(), -1.0));
}

TEST(ScreenView, RaysOfEveryEyeMeetTheWindowInTheSamePlaces) {
  base::Random random(1);
  for (int i = 0; i < repeats(100'000); ++i) {
    const View view = random_view(random);
    const double aspect = random.uniform(0.5, 2.0), x = random.uniform(-1.0, 1.0),
                 y = random.uniform(-1.0, 1.0);
    const double reach = view.distance;
    const Vector3 eye(random.uniform(-2.0, 2.0) * reach, random.uniform(-2.0, 2.0) * reach,
                      random.uniform(-0.3, 2.0) * reach);
    const View other = seen_from(view, eye);
    const Ray ray = ray_through(other, x, y, aspect);
    const Vector3 place = corner(view, x, y, aspect);
    ASSERT_LT((place - ray.origin).cross(ray.direction).norm(), 1e-9 * (place - ray.origin).norm());
    ASSERT_GT((place - ray.origin).dot(ray.direction), 0.0);
    ASSERT_LT((ray.origin - view.world_from_eye * eye).norm(), 1e-9 * reach);
    ASSERT_LT((looked_at(other) - looked_at(view)).norm(), 1e-9 * reach) << "the point looked at stays";
  }
}

TEST(ScreenView, AnEyeBehindTheScreenIsKeptBeforeIt) {
  base::Random random(2);
  const View view = random_view(random);
  for (const double z : {-1.0, -2.0, -100.0}) {
    const View other = seen_from(view, {0.0, 0.0, z * view.distance});
    EXPECT_GT(other.distance, 0.0);
    EXPECT_LT(other.field, 2.51);
    EXPECT_LT((looked_at(other) - looked_at(view)).norm(), 1e-9);
  }
  EXPECT_TRUE(is_same_view(seen_from(view, {NAN, 0.0, 0.0}), view));
}

TEST(ScreenView, AnotherFieldShowsAsMuchOfThePlaneLookedAt) {
  base::Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const View view = random_view(random);
    const View other = with_field(view, random.uniform(0.1, 2.0));
    EXPECT_LT((corner(view, 1.0, 1.0, 1.5) - corner(other, 1.0, 1.0, 1.5)).norm(), 1e-9);
    EXPECT_LT((with_field(other, view.field).world_from_eye.translation() - view.world_from_eye.translation())
                  .norm(),
              1e-9);
  }
}

TEST(ScreenView, AScreenHasTheFieldThatItsShorterSideSpans) {
  EXPECT_NEAR(field_of({{0.52, 0.32}, 0.6}), 2.0 * std::atan(0.16 / 0.6), 1e-15);
  EXPECT_NEAR(field_of({{0.2, 0.4}, 0.5}), 2.0 * std::atan(0.1 / 0.5), 1e-15);
}

TEST(ScreenView, WaysOfStereoAreKnownByTheirNames) {
  for (const auto kind :
       {StereoKind::Off, StereoKind::Anaglyph, StereoKind::SideBySide, StereoKind::TopBottom})
    EXPECT_EQ(stereo_of(name_of(kind)), kind);
  EXPECT_FALSE(stereo_of("shutter"));
}

}  // namespace
}  // namespace icome::interaction
