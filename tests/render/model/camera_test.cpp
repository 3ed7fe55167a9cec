#include "render/model/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.h"

namespace icome::render {
namespace {

using base::Vector3;

std::vector<Vector3> cloud(double scale, const Vector3& centre) {
  base::Random random(7);
  std::vector<Vector3> points;
  for (int i = 0; i < 300; ++i) points.push_back(centre + scale * random.direction());
  return points;
}

struct Reach {
  double left = 1.0, right = 0.0, top = 1.0, bottom = 0.0;
};

Reach reach_of(const Camera& camera, const std::vector<Vector3>& points) {
  Reach reach;
  for (const Vector3& point : points) {
    const auto seen = project(camera, point);
    if (!seen) return {-1.0, 2.0, -1.0, 2.0};
    reach.left = std::min(reach.left, seen->x);
    reach.right = std::max(reach.right, seen->x);
    reach.top = std::min(reach.top, seen->y);
    reach.bottom = std::max(reach.bottom, seen->y);
  }
  return reach;
}

TEST(FitCamera, TouchesTheMarginsOfTheTighterSideAtAnyScale) {
  for (const double scale : {1e-7, 1.0, 1e7}) {
    FitOptions options;
    options.toward_eye = Vector3(1.0, 0.5, 2.0);
    const auto points = cloud(scale, scale * Vector3(3.0, -2.0, 5.0));
    const Reach reach = reach_of(fit_camera(points, options), points);
    EXPECT_NEAR(reach.top, 0.05, 1e-9);
    EXPECT_NEAR(reach.bottom, 0.95, 1e-9);
    EXPECT_GT(reach.left, 0.05);
    EXPECT_LT(reach.right, 0.95);
  }
}

TEST(FitCamera, KeepsAllPointsBetweenNearAndFar) {
  const auto points = cloud(1.0, Vector3::Zero());
  const Camera camera = fit_camera(points, {});
  for (const Vector3& point : points) {
    const Eigen::Vector4d clip = camera.clip_from_world() * point.homogeneous();
    EXPECT_LT(std::abs(clip.z()), clip.w());
  }
}

TEST(FitCamera, StandsFiniteBeforeNothingAPointAndASheetSeenEdgeOn) {
  FitOptions along;
  along.toward_eye = Vector3::UnitX();
  const std::vector<std::vector<Vector3>> cases = {
      {}, {Vector3(1, 2, 3)}, {Vector3(-1, 0, 0), Vector3(1, 0, 0)}};
  for (const auto& points : cases) {
    const Camera camera = fit_camera(points, along);
    EXPECT_TRUE(camera.clip_from_world().allFinite());
    for (const Vector3& point : points) EXPECT_TRUE(project(camera, point).has_value());
  }
}

TEST(FitCamera, LooksStraightDownThoughUpGivesNoSide) {
  FitOptions options;
  options.toward_eye = options.up;
  EXPECT_TRUE(fit_camera(cloud(1.0, Vector3::Zero()), options).clip_from_world().allFinite());
}

TEST(Project, PutsUpAtTheTopAndRightAtTheRight) {
  const Camera camera = fit_camera(cloud(1.0, Vector3::Zero()), {});
  EXPECT_LT(project(camera, Vector3(0, 0.5, 0))->y, 0.5);
  EXPECT_GT(project(camera, Vector3(0.5, 0, 0))->x, 0.5);
}

TEST(Project, GivesNothingBehindTheEye) {
  const Camera camera = fit_camera(cloud(1.0, Vector3::Zero()), {});
  EXPECT_FALSE(project(camera, camera.eye() + Vector3(0, 0, 1)).has_value());
}

TEST(PixelsAMetre, AgreesWithWhereTwoPointsAppear) {
  const Camera camera = fit_camera(cloud(1.0, Vector3::Zero()), {});
  constexpr double kTall = 900.0, kRadius = 0.25;
  // At the place of a ball that is nearest to the eye, a short way across the view.
  const base::Matrix3 axes = camera.camera_from_world.linear();
  const Vector3 centre(0.1, -0.2, 0.3);
  const Vector3 nearest = centre + kRadius * axes.row(2).transpose();
  const Vector3 above = nearest + 1e-3 * axes.row(1).transpose();
  const double apart = kTall * (project(camera, nearest)->y - project(camera, above)->y);
  EXPECT_NEAR(pixels_a_metre(camera, centre, kRadius, kTall), apart / 1e-3, 1e-6 * apart / 1e-3);
  EXPECT_EQ(pixels_a_metre(camera, camera.eye(), kRadius, kTall), HUGE_VAL);
}

TEST(DistanceOfDepth, InvertsTheProjection) {
  const Camera camera = fit_camera(cloud(1.0, Vector3::Zero()), {});
  const Vector3 point(0.2, 0.1, -0.4);
  const Eigen::Vector4d clip = camera.clip_from_world() * point.homogeneous();
  const double depth = 0.5 + 0.5 * clip.z() / clip.w();
  EXPECT_NEAR(distance_of_depth(camera, depth), project(camera, point)->distance, 1e-9);
}

TEST(Perspective, MapsTheCornersOfAnOffAxisWindowToTheCornersOfClipSpace) {
  const Matrix4 m = perspective({-0.1, 0.5, -0.3, 0.2, 1.0, 10.0});
  const Eigen::Vector4d near = m * Eigen::Vector4d(-0.1, -0.3, -1.0, 1.0);
  EXPECT_TRUE((near / near.w()).isApprox(Eigen::Vector4d(-1, -1, -1, 1), 1e-12));
  const Eigen::Vector4d far = m * Eigen::Vector4d(5.0, 2.0, -10.0, 1.0);
  EXPECT_TRUE((far / far.w()).isApprox(Eigen::Vector4d(1, 1, 1, 1), 1e-12));
}

}  // namespace
}  // namespace icome::render
