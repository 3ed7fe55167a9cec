#include "render/pictures/touch_picture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <functional>
#include <limits>

#include "base/random.h"
#include "render/csg_scenes.h"
#include "render/pictures/touch_view.h"

namespace icome::render {
namespace {

using base::Vector3;
using geometry::TriangleMesh;

TriangleMesh box(const Vector3& half) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.push_back(Vector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).cwiseProduct(half));
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A stroke across the +z face of a box with that half side, pressed in for the middle half of its way.
std::vector<TouchSample> stroke(double half, std::size_t count) {
  std::vector<TouchSample> samples;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = static_cast<double>(i) / static_cast<double>(count);
    const double depth = 0.1 * half * std::sin(4.0 * M_PI * u - 0.5 * M_PI);
    const bool touching = depth > 0.0;
    const Vector3 tip(half * (1.4 * u - 0.7), 0.5 * half * std::sin(9.0 * u), half - depth);
    const Vector3 scp = touching ? Vector3(tip.x(), tip.y(), half) : tip;
    samples.push_back(
        {u, tip, scp, touching ? Vector3(0, 0, 3.0 * depth / (0.1 * half)) : Vector3(0, 0, 0), touching});
  }
  return samples;
}

using Test = std::function<bool(int r, int g, int b)>;

/// Pixels for which the test holds between two heights (shares of the picture from the top).
int count(const charts::Image& image, double from, double to, const Test& test) {
  int found = 0;
  for (int y = static_cast<int>(from * image.height); y < static_cast<int>(to * image.height); ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      found += test(p[0], p[1], p[2]);
    }
  }
  return found;
}

// The parts of the page as layed out: header 0 ... 0.1, view 0.1 ... 0.73, plot below.
constexpr double kViewTop = 0.11;
constexpr double kViewEnd = 0.72;
constexpr double kPlotTop = 0.75;

bool is_clay(int r, int g, int b) { return std::max({r, g, b}) < 215 && std::abs(r - b) < 22 && r > 60; }
bool is_tip_blue(int r, int g, int b) { return r < 90 && b > 130 && b - r > 80 && g > 80 && g < 160; }
bool is_warm(int r, int g, int b) { return r > 180 && r - b > 70 && g < 210; }
bool is_ink(int r, int g, int b) { return std::max({r, g, b}) < 110; }

TouchPicture small_picture(const TriangleMesh& mesh, std::span<const TouchSample> samples) {
  TouchPicture picture;
  picture.title = "box";
  picture.bodies.push_back({mesh});
  picture.samples = samples;
  picture.rate_hz = 1000.0;
  picture.width = 800;
  picture.height = 600;
  return picture;
}

TEST(DrawTouchPicture, ShowsModelPathsAndForce) {
  unsetenv("DISPLAY");
  const TriangleMesh mesh = box({0.05, 0.05, 0.05});
  const auto samples = stroke(0.05, 2000);
  const auto image = draw_touch_picture(small_picture(mesh, samples));
  ASSERT_TRUE(image.has_value()) << image.error().message;
  ASSERT_EQ(image->width, 800);
  ASSERT_EQ(image->height, 600);
  // The model takes a good part of the view but leaves background around it.
  const int view = static_cast<int>(800 * 600 * (kViewEnd - kViewTop));
  const int clay = count(*image, kViewTop, kViewEnd, is_clay);
  EXPECT_GT(clay, view / 10);
  EXPECT_LT(clay, view * 6 / 10);
  EXPECT_GT(count(*image, kViewTop, kViewEnd, is_tip_blue), 60);
  EXPECT_GT(count(*image, kViewTop, kViewEnd, is_warm), 300);
  EXPECT_GT(count(*image, kPlotTop, 1.0, is_ink), 200);
  EXPECT_GT(count(*image, kPlotTop, 1.0, is_warm), 300);
  EXPECT_GT(count(*image, 0.0, 0.1, is_ink), 80);
}

TEST(DrawTouchPicture, ShowsTheSameAtAnySizeOfModel) {
  const TriangleMesh reference = box({0.05, 0.05, 0.05});
  const auto image = draw_touch_picture(small_picture(reference, {}));
  ASSERT_TRUE(image.has_value());
  const int clay = count(*image, kViewTop, kViewEnd, is_clay);
  for (const double half : {1e-9, 1e6}) {
    const TriangleMesh mesh = box({half, half, half});
    const auto other = draw_touch_picture(small_picture(mesh, {}));
    ASSERT_TRUE(other.has_value());
    EXPECT_NEAR(count(*other, kViewTop, kViewEnd, is_clay), clay, 0.03 * clay) << "half side " << half;
  }
}

TEST(DrawTouchPicture, CopesWithNoSamplesAndNoModel) {
  const TriangleMesh mesh = box({0.05, 0.05, 0.05});
  const auto without_samples = draw_touch_picture(small_picture(mesh, {}));
  ASSERT_TRUE(without_samples.has_value());
  EXPECT_EQ(count(*without_samples, kViewTop, kViewEnd, is_tip_blue), 0);
  EXPECT_EQ(count(*without_samples, kViewTop, kViewEnd, is_warm), 0);
  EXPECT_GT(count(*without_samples, kViewTop, kViewEnd, is_clay), 10'000);
  const TriangleMesh nothing;
  const auto without_model = draw_touch_picture(small_picture(nothing, {}));
  ASSERT_TRUE(without_model.has_value());
  EXPECT_EQ(count(*without_model, kViewTop, 0.6, is_clay), 0);
}

TEST(DrawTouchPicture, ShowsNoForceColoursWhenNothingIsTouched) {
  const TriangleMesh mesh = box({0.05, 0.05, 0.05});
  auto samples = stroke(0.05, 500);
  for (TouchSample& sample : samples) {
    sample.touching = false;
    sample.force.setZero();
    sample.tip.z() += 0.02;
  }
  const auto image = draw_touch_picture(small_picture(mesh, samples));
  ASSERT_TRUE(image.has_value());
  EXPECT_EQ(count(*image, kViewTop, kViewEnd, is_warm), 0);
  EXPECT_GT(count(*image, kViewTop, kViewEnd, is_tip_blue), 60);
}

TEST(DrawTouchPicture, ForcesInTheAirStayWithinTheirPlot) {
  const TriangleMesh mesh = box({0.05, 0.05, 0.05});
  auto samples = stroke(0.05, 500);
  for (TouchSample& sample : samples) {
    sample.touching = false;
    sample.force = Vector3(0, 0, 3);
    sample.tip.z() += 0.02;
  }
  const auto image = draw_touch_picture(small_picture(mesh, samples));
  ASSERT_TRUE(image.has_value());
  EXPECT_EQ(count(*image, kViewTop, kViewEnd, is_warm), 0);
  EXPECT_GT(count(*image, kPlotTop, 1.0, is_warm), 300);
}

TEST(DrawTouchPicture, LeavesOutSamplesThatAreNotFinite) {
  const TriangleMesh mesh = box({0.05, 0.05, 0.05});
  auto samples = stroke(0.05, 900);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  samples[100].tip.x() = nan;
  samples[200].force.y() = infinity;
  samples[300].scp.z() = -infinity;
  samples[400].t = nan;
  const auto image = draw_touch_picture(small_picture(mesh, samples));
  ASSERT_TRUE(image.has_value());
  EXPECT_GT(count(*image, kViewTop, kViewEnd, is_clay), 10'000);
  EXPECT_GT(count(*image, kViewTop, kViewEnd, is_warm), 300);
}

TEST(DrawTouchPicture, ThinsAMillionSamples) {
  const TriangleMesh mesh = box({0.05, 0.05, 0.05});
  base::Random random(3);
  std::vector<TouchSample> samples;
  Vector3 tip(0, 0, 0.05);
  for (int i = 0; i < 1'000'000; ++i) {
    tip += 0.0003 * random.direction();
    tip = tip.cwiseMax(-0.06).cwiseMin(0.06);
    const bool touching = tip.z() < 0.05;
    const Vector3 scp(tip.x(), tip.y(), touching ? 0.05 : tip.z());
    samples.push_back(
        {1e-3 * i, tip, scp, touching ? Vector3(0, 0, 0.05 - tip.z()) : Vector3(0, 0, 0), touching});
  }
  EXPECT_TRUE(draw_touch_picture(small_picture(mesh, samples)).has_value());
}

TEST(DrawTouchPicture, HidesWhatLiesBehindTheModel) {
  // The same touches on the far face: no sample tells where to look from, so the view stays in front.
  const TriangleMesh mesh = box({0.05, 0.05, 0.05});
  auto samples = stroke(0.05, 900);
  const auto front = draw_touch_picture(small_picture(mesh, samples));
  for (TouchSample& sample : samples) {
    sample.tip.z() = -sample.tip.z();
    sample.scp.z() = -sample.scp.z();
  }
  const auto behind = draw_touch_picture(small_picture(mesh, samples));
  ASSERT_TRUE(front.has_value() && behind.has_value());
  const int seen = count(*front, kViewTop, kViewEnd, is_warm);
  const int hidden = count(*behind, kViewTop, kViewEnd, is_warm);
  // The colour bar and the legend are in both.
  EXPECT_GT(seen, hidden + 400);
}

TouchPicture picture_of(const geometry::CsgTree& tree, std::vector<std::string>& told) {
  TouchPicture picture;
  picture.solids.push_back({tree, "solid"});
  picture.width = 480;
  picture.height = 400;
  picture.tell = [&told](const std::string& sentence) { told.push_back(sentence); };
  return picture;
}

TEST(DrawTouchPicture, ShowsACsgTreeWithoutAMesh) {
  std::vector<std::string> told;
  const geometry::CsgTree tree = figure_5_6();
  const auto image = draw_touch_picture(picture_of(tree, told));
  ASSERT_TRUE(image.has_value()) << image.error().message;
  EXPECT_GT(count(*image, kViewTop, kViewEnd, is_clay), 5'000);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("images of its 3 operands"), std::string::npos) << told[0];
}

TEST(DrawTouchPicture, TakesTheMeshOfATreeWithTooManyOperands) {
  std::vector<std::string> told;
  const geometry::CsgTree tree = dented_ball(1'200);
  TouchPicture picture = picture_of(tree, told);
  const auto without = draw_touch_picture(picture);
  ASSERT_FALSE(without.has_value());
  EXPECT_NE(without.error().message.find("solid cannot be drawn without a mesh"), std::string::npos);
  int asked = 0;
  picture.solids[0].mesh = [&]() -> base::Result<TriangleMesh> {
    ++asked;
    return box({0.05, 0.05, 0.05});
  };
  const auto image = draw_touch_picture(picture);
  ASSERT_TRUE(image.has_value()) << image.error().message;
  EXPECT_EQ(asked, 1);
  EXPECT_GT(count(*image, kViewTop, kViewEnd, is_clay), 5'000);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("mesh of 12 triangles"), std::string::npos) << told[0];
}

TEST(DrawTouchPicture, RefusesSizesOutOfRange) {
  TouchPicture picture = small_picture(box({1, 1, 1}), {});
  picture.bodies.clear();
  picture.width = 10;
  EXPECT_FALSE(draw_touch_picture(picture).has_value());
  picture.width = 20'000;
  const auto refused = draw_touch_picture(picture);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("20000"), std::string::npos);
}

TEST(WriteTouchPicture, NamesThePathThatCannotBeWritten) {
  TouchPicture picture;
  picture.width = 400;
  picture.height = 400;
  const auto written = write_touch_picture(picture, "/no/such/a.png");
  ASSERT_FALSE(written.has_value());
  EXPECT_NE(written.error().message.find("/no/such/a.png"), std::string::npos);
}

TEST(ContactDirection, FacesTheContact) {
  for (const Vector3& push : {Vector3(-1, 0, 0), Vector3(0, 0, -1), Vector3(1, 0, 0), Vector3(0, 0, 1)}) {
    const std::vector<TouchSample> samples(50, TouchSample{0, push, push, push, true});
    EXPECT_GT(contact_direction(samples, Vector3::UnitY()).dot(push), 0.6);
  }
}

TEST(ContactDirection, LooksFromAboveForAnyUpWithoutContact) {
  for (const Vector3& up : {Vector3(0, 1, 0), Vector3(0, 0, 1), Vector3(1, 0, 0), Vector3(0, 0, -5)}) {
    const Vector3 direction = contact_direction({}, up);
    EXPECT_NEAR(direction.norm(), 1.0, 1e-9);
    EXPECT_GT(direction.dot(up.normalized()), 0.2);
  }
}

TEST(ModelBall, HoldsAllBodiesWhereTheyStand) {
  const TriangleMesh mesh = box({1, 1, 1});
  base::Pose moved = base::Pose::Identity();
  moved.translation() = Vector3(10, 0, 0);
  const auto points = model_points({{mesh}, {mesh, moved}});
  const ModelBall ball = model_ball(points, Vector3::UnitY());
  EXPECT_TRUE(ball.centre.isApprox(Vector3(5, 0, 0)));
  EXPECT_NEAR(ball.radius, std::sqrt(6.0 * 6.0 + 2.0), 1e-12);
  EXPECT_NEAR(ball.lowest, -1.0, 1e-12);
}

}  // namespace
}  // namespace icome::render
