#include "every_edit.h"
#include "geometry/mesh_topology.h"

namespace icome::world {
namespace {

constexpr double kTolerance = 0.001;

std::shared_ptr<const MeshGeometry> triangles_of(const Geometry& shape) {
  auto made = shape.triangles(kTolerance);
  if (!made) throw std::runtime_error(made.error().message);
  return *made;
}

TEST(Triangles, OfAMeshAreItself) {
  const auto mesh = std::make_shared<const MeshGeometry>(tetrahedron());
  EXPECT_EQ(triangles_of(*mesh), mesh);
  EXPECT_EQ(triangles_of(MeshGeometry(tetrahedron()))->hash(), mesh->hash());  // of one that nobody shares
}

TEST(Triangles, OfAPrimitiveStandAlongItsAxis) {
  const auto mesh = triangles_of(PrimitiveGeometry(geometry::Cone{0.2, 0.0, 1.0}, Axis::Y));
  double top = -1.0;
  for (const Vector3& position : mesh->mesh.positions) {
    EXPECT_LE(std::abs(position.y()), 0.5);
    if (position.y() == 0.5) top = std::max(top, std::hypot(position.x(), position.z()));
  }
  EXPECT_EQ(top, 0.0);  // the tip
}

TEST(Triangles, OfSolidsLieWithinTheToleranceOfThem) {
  const Bounds box(Vector3::Constant(-0.1), Vector3::Constant(0.1));
  const auto ball = *ImplicitGeometry::create("x*x + y*y + z*z - 0.0025", box);
  geometry::CsgTree tree;
  tree.add_leaf(geometry::Primitive(geometry::Sphere{0.05}));
  const PrimitiveGeometry sphere(geometry::Sphere{0.05});
  for (const Geometry* shape :
       {static_cast<const Geometry*>(&*ball), static_cast<const Geometry*>(&sphere)}) {
    const auto mesh = triangles_of(*shape);
    ASSERT_FALSE(mesh->mesh.triangles.empty());
    for (const Vector3& position : mesh->mesh.positions) EXPECT_NEAR(position.norm(), 0.05, kTolerance);
  }
}

TEST(Triangles, OfALoopSurfaceLieOnItsLimit) {
  const auto mesh = triangles_of(LoopGeometry({tetrahedron(), {}, {}}));
  EXPECT_GT(mesh->mesh.triangles.size(), 4u * 16u);
  EXPECT_TRUE(geometry::bounds(tetrahedron()).contains(geometry::bounds(mesh->mesh)));
}

TEST(Triangles, AreRefusedForWhatHasNoEnd) {
  const auto made = PrimitiveGeometry(geometry::Plane{}).triangles(kTolerance);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("no end"), std::string::npos);
  EXPECT_TRUE(triangles_of(CsgGeometry(geometry::CsgTree{}))->mesh.triangles.empty());
}

}  // namespace
}  // namespace icome::world
