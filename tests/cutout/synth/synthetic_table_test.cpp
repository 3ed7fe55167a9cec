#include "cutout/synth/synthetic_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cutout/synth/hand_shape.h"
#include "cutout/synth/motion.h"
#include "cutout/synth/synthetic_camera.h"

namespace icome::cutout {
namespace {

SyntheticOptions plain_table() {
  SyntheticOptions options;
  options.known = usual_triangles(6);
  options.frames = 60;
  options.moving = false;
  options.noise = 0;
  options.jpeg_quality = 0;
  return options;
}

/// Share of the triangle's colour in a pixel of table and triangle, by the ratio of blue to red light.
double blue_share(const std::uint8_t* bgr) {
  const LinearColour seen = linear_colour(bgr[2], bgr[1], bgr[0]);
  const LinearColour table = linear_colour(186, 38, 44), plastic = linear_colour(28, 74, 172);
  const double ratio = seen[0] / std::max(1e-6F, seen[2]);
  const double of_table = ratio * table[2] - table[0], of_plastic = ratio * plastic[2] - plastic[0];
  return of_table / (of_table - of_plastic);
}

double cross_product(const base::Vector2& a, const base::Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

TEST(SyntheticCamera, SeesWhatItProjects) {
  const auto camera = SyntheticCamera::over_table(640, 480, 640, 480, 3, 0.15);
  for (const double x : {5.0, 200.0, 635.0})
    for (const double y : {5.0, 240.0, 470.0})
      for (const double z : {-15.0, 0.0, 3.0}) {
        const base::Vector2 pixel = camera.project({x, y, z});
        EXPECT_NEAR((camera.on_plane(pixel, z) - base::Vector2(x, y)).norm(), 0.0, 1e-8);
        EXPECT_GT(pixel.x(), 0);
        EXPECT_LT(pixel.x(), 639);
        EXPECT_GT(pixel.y(), 0);
        EXPECT_LT(pixel.y(), 479);
      }
}

// The view is computed elsewhere, from the lens and the homography alone.
TEST(SyntheticCamera, IsToldExactlyByTheView) {
  const SyntheticOptions options = plain_table();
  const SyntheticTable table(options);
  const TableView view = table.view();
  const auto camera = SyntheticCamera::over_table(640, 480, 640, 480, options.thickness, options.tilt);
  for (const double x : {10.0, 300.0, 630.0})
    for (const double y : {10.0, 200.0, 470.0}) {
      const base::Vector2 pixel = camera.project({x, y, 0});
      EXPECT_NEAR((view.to_pixel({x, y}) - pixel).norm(), 0.0, 1e-7);
      EXPECT_NEAR((view.to_table(pixel) - base::Vector2(x, y)).norm(), 0.0, 1e-5);
      // The foot of a wall, which lies lower, is seen where the view says.
      const base::Vector2 foot = camera.on_plane(camera.project({x, y, options.thickness}), 0);
      EXPECT_NEAR((base::Vector2(x, y) + view.wall_at({x, y}) - foot).norm(), 0.0, 1e-9);
    }
  EXPECT_NEAR(view.camera_height(), -camera.place().z(), 1e-9);
}

// Triangles without walls: light adds up to the projected triangle's area and centroid.
TEST(SyntheticTable, PutsOutlinesWhereTheTruthSays) {
  SyntheticOptions options = plain_table();
  options.thickness = 0;
  options.shadow = 0;
  options.known.triangles.resize(1);
  for (int number = 0; number < 6; ++number) {
    const SyntheticTable table(options);
    const auto camera = SyntheticCamera::over_table(640, 480, 640, 480, 0, options.tilt);
    const auto made = table.make(number);
    const auto corners = synthetic_corners(options.known.triangles[0], made.truth.poses[0]);
    // Sides are bent by the lens: the outline is followed in small steps.
    double area = 0, length = 0;
    base::Vector2 moment = base::Vector2::Zero(), least(1e9, 1e9), most(-1e9, -1e9);
    constexpr int kSteps = 200;
    for (std::size_t i = 0; i < 3; ++i)
      for (int k = 0; k < kSteps; ++k) {
        const auto at = [&](int step) {
          const base::Vector2 mm = corners[i] + (corners[(i + 1) % 3] - corners[i]) * (double(step) / kSteps);
          return camera.project({mm.x(), mm.y(), 0});
        };
        const base::Vector2 a = at(k), b = at(k + 1);
        area += 0.5 * cross_product(a, b);
        moment += (a + b) * cross_product(a, b) / 6.0;
        length += (b - a).norm();
        least = least.cwiseMin(a);
        most = most.cwiseMax(a);
      }
    double seen_area = 0;
    base::Vector2 seen_moment = base::Vector2::Zero();
    for (int y = int(least.y()) - 5; y < int(most.y()) + 6; ++y)
      for (int x = int(least.x()) - 5; x < int(most.x()) + 6; ++x) {
        // Far from the outline only rounding to 8 bits would be added up.
        double share = blue_share(made.frame.view().row(y) + 3 * x);
        share = share < 0.03 ? 0.0 : share > 0.97 ? 1.0 : share;
        seen_area += share;
        seen_moment += share * base::Vector2(x, y);
      }
    EXPECT_NEAR((moment / area - seen_moment / seen_area).norm(), 0.0, 0.02) << "frame " << number;
    // The rim that catches light counts a little more than the table beside it.
    EXPECT_NEAR((seen_area - std::abs(area)) / length, 0.0, 0.04) << "frame " << number;
  }
}

TEST(SyntheticTable, IsTheSameWhateverWasMadeBefore) {
  SyntheticOptions options = plain_table();
  options.moving = true;
  options.hands = true;
  options.occlude = 0.3;
  options.noise = 3;
  options.jpeg_quality = 90;
  const SyntheticTable one(options), other(options);
  one.make(3);
  const auto a = one.make(7), b = other.make(7);
  EXPECT_EQ(a.frame.bgr, b.frame.bgr);
  EXPECT_EQ(a.jpeg, b.jpeg);
  options.seed = 2;
  EXPECT_NE(SyntheticTable(options).make(7).frame.bgr, a.frame.bgr);
}

class SyntheticMotion : public testing::TestWithParam<bool> {};

TEST_P(SyntheticMotion, IsSmoothAndNeverOverlaps) {
  SyntheticOptions options = plain_table();
  options.known = usual_triangles(12);
  options.frames = 900;
  options.hands = GetParam();
  const auto scenes = moving_scenes(options);
  ASSERT_EQ(scenes.size(), 900U);
  double farthest = 0, nearest = 1e9;
  std::size_t exchanges = 0, still = 0;
  for (std::size_t frame = 0; frame < scenes.size(); ++frame) {
    const auto& poses = scenes[frame].poses;
    ASSERT_TRUE(all_on_table(options, poses)) << frame;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const auto corners = synthetic_corners(options.known.triangles[i], poses[i]);
      for (std::size_t k = 0; k < i; ++k)
        nearest = std::min(nearest, apart(corners, synthetic_corners(options.known.triangles[k], poses[k])));
      if (frame == 0) continue;
      const double way = (poses[i].centroid - scenes[frame - 1].poses[i].centroid).norm();
      farthest = std::max(farthest, way);
      if (way == 0.0) ++still;
      for (std::size_t k = 0; k < i; ++k) {
        const auto& before = scenes[frame - 1].poses;
        const bool near = (poses[i].centroid - poses[k].centroid).norm() < 110;
        if (near && (poses[i].centroid.x() < poses[k].centroid.x()) !=
                        (before[i].centroid.x() < before[k].centroid.x()))
          ++exchanges;
      }
    }
  }
  EXPECT_GT(nearest, 0.5);    // mm: plastic does not pass through plastic
  EXPECT_LT(farthest, 25.0);  // mm a frame
  EXPECT_GT(exchanges, 20U);  // pairs that pass one another
  EXPECT_GT(still, 200U);     // some rest
}
INSTANTIATE_TEST_SUITE_P(WithAndWithoutHands, SyntheticMotion, testing::Bool());

// Points just outside of an edge are red, except where it is covered.
TEST(SyntheticTable, CoversTheShareOfEachEdge) {
  SyntheticOptions options = plain_table();
  options.occlude = 0.5;
  const SyntheticTable table(options);
  double red = 0, all = 0;
  for (int number = 0; number < 8; ++number) {
    const auto made = table.make(number);
    for (std::size_t i = 0; i < made.truth.poses.size(); ++i) {
      const auto corners = synthetic_corners(options.known.triangles[i], made.truth.poses[i]);
      const base::Vector2 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
      for (std::size_t k = 0; k < 3; ++k)
        for (double share = 0.005; share < 1; share += 0.01) {
          const base::Vector2 along = corners[(k + 1) % 3] - corners[k];
          base::Vector2 outwards = base::Vector2(along.y(), -along.x()).normalized();
          if (outwards.dot(middle - corners[k]) > 0) outwards = -outwards;
          const base::Vector2 edge = corners[k] + share * (corners[(k + 1) % 3] - corners[k]);
          const base::Vector2 pixel = table.view().to_pixel(edge + outwards * 2.5);
          const std::uint8_t* const bgr =
              made.frame.view().row(int(std::lround(pixel.y()))) + 3 * std::lround(pixel.x());
          if (bgr[1] < 0.4 * bgr[2]) ++red;
          ++all;
        }
    }
  }
  EXPECT_NEAR(red / all, 0.5, 0.03);
}

TEST(SyntheticTable, ShowsHandsAndAnEmptyTable) {
  SyntheticOptions options = plain_table();
  options.hands = true;
  const SyntheticTable table(options);
  const auto made = table.make(0);
  const auto empty = table.make_empty(0);
  std::size_t skin = 0, blue = 0;
  for (std::size_t i = 0; i < made.frame.bgr.size(); i += 3) {
    const auto* const seen = made.frame.bgr.data() + i;
    if (seen[2] > 100 && seen[1] > 70 && seen[2] > seen[0] + 30) ++skin;
    if (empty.frame.bgr[i] > empty.frame.bgr[i + 2] + 40) ++blue;
  }
  EXPECT_GT(skin, 5000U);
  EXPECT_EQ(blue, 0U);
}

TEST(SyntheticTable, BlursWhatMovesWhileTheShutterIsOpen) {
  SyntheticOptions options = plain_table();
  options.moving = true;
  options.known.triangles.resize(2);
  options.frames = 40;
  const auto steepest = [&](double exposure) {
    options.exposure = exposure;
    const auto made = SyntheticTable(options).make(30);
    int most = 0;
    for (std::size_t i = 3; i < made.frame.bgr.size(); i += 3)
      if (i % (3 * 640) != 0) most += std::abs(made.frame.bgr[i] - made.frame.bgr[i - 3]) > 45 ? 1 : 0;
    return most;
  };
  const int sharp = steepest(0);
  EXPECT_GT(sharp, 50);
  EXPECT_LT(steepest(0.03), sharp);
}

TEST(SyntheticTable, RefusesWhatItCannotMake) {
  SyntheticOptions options = plain_table();
  EXPECT_TRUE(check(options));
  options.known = usual_triangles(1000);
  const auto crowded = check(options);
  ASSERT_FALSE(crowded);
  EXPECT_NE(crowded.error().message.find("1000 triangles find no place"), std::string::npos);
  options = plain_table();
  options.width = 0;
  EXPECT_FALSE(check(options));
  options = plain_table();
  options.occlude = std::nan("");
  EXPECT_FALSE(check(options));
}

TEST(SyntheticTable, UsualTrianglesRaiseNoWarning) {
  for (const int count : {1, 6, 12, 18}) {
    const auto warnings = warnings_of(usual_triangles(count));
    EXPECT_TRUE(warnings.empty()) << count << ": " << warnings.front();
  }
}

}  // namespace
}  // namespace icome::cutout
