#include "render/pictures/studio_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geometry/primitive/primitive.h"
#include "render/pictures/touch_view.h"

namespace icome::render {
namespace {

using base::Vector3;
using geometry::TriangleMesh;

constexpr double kCreaseAngle = 0.9;
constexpr double kPictureHeight = 760.0;  // pixels
constexpr double kBallRadius = 0.01;      // m, radius

TriangleMesh fine_ball() { return geometry::tessellate(geometry::Sphere{kBallRadius}, 1e-5); }

/// Copies of one mesh in a plane.
std::vector<StudioBody> carpet(const TriangleMesh& mesh, int side, double step) {
  std::vector<StudioBody> bodies;
  for (int i = 0; i < side * side; ++i) {
    StudioBody body{mesh};
    body.world_from_mesh.translation() = Vector3(step * (i % side), 0.0, step * (i / side));
    body.world_from_mesh.linear() = Eigen::AngleAxisd(0.1 * i, Vector3(1, 2, 3).normalized()).matrix();
    bodies.push_back(body);
  }
  return bodies;
}

Camera camera_on(const std::vector<StudioBody>& bodies) {
  FitOptions fit;
  fit.toward_eye = Vector3(0.3, 0.8, 1.0);
  return fit_camera(model_points(bodies), fit);
}

Vector3 place_of(const StudioMeshes& made, const StudioItem& item, const ShadingMesh::Vertex& vertex) {
  const ShadingMesh& mesh = made.meshes[item.mesh].seen;
  return item.world_from_mesh * (mesh.centre + mesh.radius * vertex.position.cast<double>());
}

TEST(StudioMeshes, ThousandsOfSmallBodiesAreOneMeshOfFewTrianglesWithinAPixel) {
  constexpr double kStep = 0.05;  // m
  const TriangleMesh ball = fine_ball();
  const auto bodies = carpet(ball, 70, kStep);
  const Camera camera = camera_on(bodies);
  const StudioMeshes made = make_studio_meshes(bodies, camera, kPictureHeight, kCreaseAngle);
  ASSERT_EQ(made.items.size(), 1U);
  EXPECT_LT(made.triangles, 2'000'000U);
  EXPECT_LT(made.triangles, bodies.size() * ball.triangles.size() / 5);
  EXPECT_EQ(made.meshes[0].seen.triangle_count(), made.triangles);
  EXPECT_FALSE(made.meshes[0].caster) << "a coarser crowd would be none";
  const double pixels = pixels_a_metre(camera, Vector3(1.75, 0, 1.75), 0.0, kPictureHeight);
  const auto body_of = [&](const Vector3& at) {
    return std::size_t(70 * std::lround(at.z() / kStep) + std::lround(at.x() / kStep));
  };
  const ShadingMesh& crowd = made.meshes[0].seen;
  std::vector<std::size_t> body_of_vertex;
  for (const ShadingMesh::Vertex& vertex : crowd.vertices) {
    const Vector3 at = place_of(made, made.items[0], vertex);
    body_of_vertex.push_back(body_of(at));
    ASSERT_LT(body_of_vertex.back(), bodies.size());
    const Vector3 outwards = at - bodies[body_of_vertex.back()].world_from_mesh.translation();
    EXPECT_NEAR(outwards.norm() * pixels, kBallRadius * pixels, 1.0);
    EXPECT_GT(outwards.normalized().dot(vertex.normal.cast<double>()), 0.8);
  }
  std::vector<int> triangles(bodies.size());
  for (std::size_t i = 0; i < crowd.indices.size(); i += 3) {
    const std::size_t body = body_of_vertex[crowd.indices[i]];
    for (const std::size_t k : {i + 1, i + 2}) ASSERT_EQ(body_of_vertex[crowd.indices[k]], body);
    ++triangles[body];
  }
  for (const int count : triangles) EXPECT_GE(count, 8);
}

TEST(StudioMeshes, WhatIsSeenLargeKeepsItsTriangles) {
  const TriangleMesh ball = fine_ball();
  const auto bodies = carpet(ball, 2, 0.03);
  const StudioMeshes made = make_studio_meshes(bodies, camera_on(bodies), kPictureHeight, kCreaseAngle);
  EXPECT_EQ(made.items.size(), 4U);
  EXPECT_EQ(made.meshes.size(), 1U) << "bodies share their mesh";
  EXPECT_EQ(made.triangles, 4 * ball.triangles.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    EXPECT_TRUE(made.items[i].world_from_mesh.isApprox(bodies[i].world_from_mesh));
}

TEST(StudioMeshes, BodiesKeepTheirColours) {
  const TriangleMesh box =
      geometry::tessellate(geometry::Box{Vector3(kBallRadius, kBallRadius, kBallRadius)}, 1.0);
  auto bodies = carpet(box, 3, 0.05);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    bodies[i].colour = charts::Colour{0.1 * double(i % 2), 0.5, 0.5};
  const StudioMeshes made = make_studio_meshes(bodies, camera_on(bodies), kPictureHeight, kCreaseAngle);
  ASSERT_EQ(made.items.size(), 2U);
  for (const StudioItem& item : made.items) {
    for (const ShadingMesh::Vertex& vertex : made.meshes[item.mesh].seen.vertices) {
      const Vector3 at = place_of(made, item, vertex);
      const auto body = std::size_t(std::lround(at.x() / 0.05) + 3 * std::lround(at.z() / 0.05));
      EXPECT_EQ(bodies.at(body).colour.red, item.colour.red);
    }
  }
}

TEST(StudioMeshes, WhatHasNoTrianglesIsLeftOut) {
  const TriangleMesh nothing;
  EXPECT_TRUE(make_studio_meshes({{nothing}}, Camera{}, kPictureHeight, kCreaseAngle).items.empty());
}

TEST(ModelPoints, OfMeshesThatManyBodiesShareAreFewAndFrameAlike) {
  const TriangleMesh ball = fine_ball();
  const auto bodies = carpet(ball, 20, 0.05);
  const auto points = model_points(bodies);
  EXPECT_LE(points.size(), 64 * bodies.size());
  std::vector<Vector3> all;
  for (const StudioBody& body : bodies)
    for (const Vector3& position : ball.positions) all.push_back(body.world_from_mesh * position);
  const Camera few = fit_camera(points, {}), exact = fit_camera(all, {});
  EXPECT_NEAR((few.eye() - exact.eye()).norm(), 0.0, 0.1 * kBallRadius);
}

}  // namespace
}  // namespace icome::render
