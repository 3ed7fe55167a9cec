// Winding numbers of closed meshes, against the sum of solid angles.
#include "geometry/tree/ray_winding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "geometry/meshes.h"
#include "geometry/primitive/primitive.h"

namespace icome::geometry {
namespace {

/// The solid angle under which the mesh is seen, in turns around the point: van Oosterom and Strackee 1983.
double winding_by_solid_angle(const TriangleMesh& mesh, const Vector3& point) {
  using Long = Eigen::Matrix<long double, 3, 1>;
  long double sum = 0.0L;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Long a = (mesh.corner(t, 0) - point).cast<long double>();
    const Long b = (mesh.corner(t, 1) - point).cast<long double>();
    const Long c = (mesh.corner(t, 2) - point).cast<long double>();
    const long double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2.0L * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return double(sum / (4.0L * std::numbers::pi_v<long double>));
}

TriangleMesh moved(TriangleMesh mesh, const Vector3& by) {
  for (Vector3& position : mesh.positions) position += by;
  return mesh;
}

/// Random places near the surface, on either side of it: from 1e-6 to 1e-2 of the size.
void expect_right_near_the_surface(const TriangleMesh& mesh, int count, std::uint64_t seed) {
  const TriangleTree tree(mesh);
  const double size = tree.bounds().sizes().maxCoeff();
  base::Random random(seed);
  int inside = 0;
  for (int i = 0; i < count; ++i) {
    const auto t =
        std::size_t(random.uniform(0.0, 1.0) * double(mesh.triangles.size())) % mesh.triangles.size();
    // On a face, an edge or a corner.
    Vector3 share(random.uniform(), random.uniform(), random.uniform());
    if (i % 3 > 0) share[0] = 0.0;
    if (i % 3 > 1) share[1] = 0.0;
    share /= share.sum();
    const Vector3 foot =
        share[0] * mesh.corner(t, 0) + share[1] * mesh.corner(t, 1) + share[2] * mesh.corner(t, 2);
    const double off = size * std::pow(10.0, random.uniform(-6.0, -2.0));
    const Vector3 place = foot + off * random.direction();
    const double expected = winding_by_solid_angle(mesh, place);
    // Nearer than this to the surface the reference itself cannot tell.
    if (tree.nearest(place)->parameter < 1e-9 * size) continue;
    ASSERT_NEAR(expected, std::round(expected), 1e-6) << "the mesh is not closed";
    ASSERT_EQ(tree.winding(place), int(std::lround(expected))) << i << " at " << place.transpose();
    inside += expected > 0.5 ? 1 : 0;
  }
  EXPECT_GT(inside, count / 10);
}

TEST(RayWinding, OfShapesMadeAtRandomPlaces) {
  // A shell in a shell, a ball in that, and a ring that lies across them.
  TriangleMesh nested = together(tessellate(Sphere{1.0}, 0.01), turned(tessellate(Sphere{0.9}, 0.01)));
  nested = together(nested, moved(tessellate(Sphere{0.4}, 0.01), {0.1, 0.0, 0.0}));
  nested = together(nested, moved(tessellate(Torus{0.9, 0.2}, 0.01), {0.7, 0.2, 0.1}));
  expect_right_near_the_surface(nested, 1500, 1);
}

TEST(RayWinding, OfBlocksThatTouch) {
  TriangleMesh blocks;
  for (int i = 0; i < 27; ++i) {
    const Vector3 middle(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const Vector3 half = Vector3::Constant(0.5);
    if (i != 13) blocks = together(blocks, box_mesh(middle - half, middle + half));
  }
  expect_right_near_the_surface(blocks, 1500, 2);
  // Rays that run along edges, through corners and in faces: places on a lattice of a quarter.
  const TriangleTree tree(blocks);
  int asked = 0;
  for (int i = 0; i < 13 * 13 * 13; ++i) {
    const Vector3 place = 0.25 * Vector3(i % 13 - 6, i / 13 % 13 - 6, i / 169 - 6);
    const Vector3 cell = (place.array() + 0.5).floor();
    const Vector3 within = place - cell;
    if ((within.array().abs() == 0.5).any()) continue;  // on a face
    const bool hole = cell.isZero(0.0), far = cell.cwiseAbs().maxCoeff() > 1.0;
    EXPECT_EQ(tree.winding(place), hole || far ? 0 : 1) << place.transpose();
    ++asked;
  }
  EXPECT_GT(asked, 500);
}

TEST(RayWinding, AlongRaysThroughVertices) {
  const TriangleMesh ball = tessellate(Sphere{1.0}, 0.05);
  const TriangleTree tree(ball);
  int inside = 0, outside = 0;
  for (const Vector3& vertex : ball.positions) {
    for (const double share : {0.9, 1.01}) {
      // Below or above the vertex, on the axis along which the box's side is nearest.
      int axis = 0;
      vertex.cwiseAbs().maxCoeff(&axis);
      Vector3 place = vertex;
      place[axis] *= share;
      if (!tree.bounds().contains(place)) continue;
      const int expected = int(std::lround(winding_by_solid_angle(ball, place)));
      EXPECT_EQ(tree.winding(place), expected) << place.transpose();
      ++(expected > 0 ? inside : outside);
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 50);
}

TEST(RayWinding, OfABallFarFromItsOrigin) {
  expect_right_near_the_surface(moved(tessellate(Sphere{0.05}, 1e-4), {5e5, 4e6, 100.0}), 300, 3);
}

}  // namespace
}  // namespace icome::geometry
