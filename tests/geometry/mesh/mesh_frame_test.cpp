#include "geometry/mesh/mesh_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "geometry/primitive/primitive.h"

namespace icome::geometry {
namespace {

TEST(MeshFrame, BringsAFarMeshNearAndRoundsNothing) {
  base::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double size = std::pow(10.0, random.uniform(-4.0, 4.0));
    TriangleMesh mesh = tessellate(Sphere{0.5 * size}, 0.05 * size);
    const Vector3 far = size * std::pow(10.0, random.uniform(2.5, 9.0)) * random.direction();
    for (Vector3& position : mesh.positions) position += far;
    const TriangleMesh before = mesh;
    const Vector3 middle = bring_near(mesh);
    EXPECT_FALSE(middle.isZero(0.0));
    EXPECT_EQ(mesh.triangles, before.triangles);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      // The old coordinate is the sum of two doubles, and was rounded from no other.
      EXPECT_EQ(Vector3(mesh.positions[v] + middle), before.positions[v]);
      for (int axis = 0; axis < 3; ++axis) {
        const long double exact = (long double)(before.positions[v][axis]) - (long double)(middle[axis]);
        EXPECT_EQ((long double)(mesh.positions[v][axis]), exact);
      }
    }
    EXPECT_LT(bounds(mesh).center().cwiseAbs().maxCoeff(), 65.0 * size);
  }
}

TEST(MeshFrame, LeavesWhatIsNearAsItIs) {
  TriangleMesh mesh = tessellate(Box{{0.1, 0.2, 0.3}}, 0.1);
  for (Vector3& position : mesh.positions) position += Vector3(10.0, -3.0, 0.5);
  const TriangleMesh before = mesh;
  EXPECT_EQ(bring_near(mesh), Vector3(Vector3::Zero()));
  EXPECT_EQ(mesh.positions, before.positions);
  // An axis along which it lies near stays as it is.
  for (Vector3& position : mesh.positions) position.x() += 5e5;
  const Vector3 middle = bring_near(mesh);
  EXPECT_NEAR(middle.x(), 5e5 + 10.0, 0.5);
  EXPECT_EQ(middle.y(), 0.0);
  EXPECT_EQ(middle.z(), 0.0);
  TriangleMesh nothing;
  EXPECT_EQ(bring_near(nothing), Vector3(Vector3::Zero()));
}

}  // namespace
}  // namespace icome::geometry
