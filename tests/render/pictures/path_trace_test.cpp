#include "render/pictures/path_trace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace icome::render {
namespace {

using base::Vector3;

/// A view of a wall in z = 0 that fills the picture's left half, from (0, 0, 5).
struct Wall {
  Camera camera;
  StudioPicture picture;

  Wall() {
    camera.camera_from_world.translation() = Vector3(0, 0, -5);
    camera.clip_from_camera = perspective({-0.5, 0.5, -0.5, 0.5, 0.1, 100.0});
    picture.image = {100, 100, {}};
    for (int i = 0; i < 100 * 100; ++i) {
      picture.distance.push_back(i % 100 < 50 ? 5.0F : std::numeric_limits<float>::infinity());
    }
  }
  PlacedPicture placed() const { return {camera, picture, {0, 0, 200, 200}, 0.01}; }
};

TEST(IsVisible, ComparesWithTheSurfaceOfThePixel) {
  const Wall wall;
  EXPECT_TRUE(is_visible(wall.placed(), Vector3(-1, 0, 0.5)));
  EXPECT_TRUE(is_visible(wall.placed(), Vector3(-1, 0, -0.005)));  // within the tolerance
  EXPECT_FALSE(is_visible(wall.placed(), Vector3(-1, 0, -0.5)));
  EXPECT_TRUE(is_visible(wall.placed(), Vector3(1, 0, -0.5)));
}

TEST(TracePath, SplitsAtWhatHidesAndSharesThePointBetween) {
  const Wall wall;
  const auto stretches = trace_path(wall.placed(), 201, [](std::size_t i) {
    return PathPoint{Vector3(-1.0 + 0.01 * static_cast<double>(i), 0, -0.5), 0.0, true};
  });
  ASSERT_EQ(stretches.size(), 1U);
  const auto runs = visibility_runs(stretches[0]);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_FALSE(runs[0].front().visible);
  EXPECT_TRUE(runs[1].front().visible);
  EXPECT_EQ(runs[0].back().at, runs[1].front().at);
  // The wall ends at the middle of the page.
  EXPECT_NEAR(runs[1].front().at.x(), 100.0, 4.0);
}

TEST(TracePath, InterruptsWhereTheSampleSaysSoOrIsNotFinite) {
  const Wall wall;
  const auto stretches = trace_path(wall.placed(), 90, [](std::size_t i) {
    PathPoint point{Vector3(0.01 * static_cast<double>(i), 0, 1), 0.0, i != 30};
    if (i == 60) point.position.y() = std::numeric_limits<double>::quiet_NaN();
    return point;
  });
  EXPECT_EQ(stretches.size(), 3U);
}

TEST(TracePath, KeepsEndsAndFewPointsOfAMillion) {
  const Wall wall;
  const auto stretches = trace_path(wall.placed(), 1'000'000, [](std::size_t i) {
    const double a = 1e-3 * static_cast<double>(i);
    return PathPoint{Vector3(std::sin(1.3 * a), std::cos(a), 1.0), static_cast<double>(i), true};
  });
  ASSERT_EQ(stretches.size(), 1U);
  EXPECT_LE(stretches[0].size(), 20'002U);
  EXPECT_GE(stretches[0].size(), 2'000U);
  EXPECT_EQ(stretches[0].front().value, 0.0);
  EXPECT_EQ(stretches[0].back().value, 999'999.0);
}

TEST(PlaceOnPage, GivesNothingBehindTheEye) {
  const Wall wall;
  EXPECT_FALSE(place_on_page(wall.placed(), Vector3(0, 0, 6)).has_value());
}

}  // namespace
}  // namespace icome::render
