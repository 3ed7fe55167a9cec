#include <numbers>

#include "geometry/mesh/mesh_topology.h"
#include "world/every_edit.h"
#include "world/shape/usual_tolerance.h"

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

// Closed form: a cap of height h of a sphere of radius r has the volume pi h^2 (3 r - h) / 3.
TEST(Triangles, OfALensOfTwoLargeSpheresAreThere) {
  using geometry::CsgOperator;
  geometry::CsgTree tree;
  const auto one = tree.add_leaf(geometry::Primitive(geometry::Sphere{0.1}), at(0.0, 0.0995, 0.0));
  const auto two = tree.add_leaf(geometry::Primitive(geometry::Sphere{0.1}), at(0.0, -0.0995, 0.0));
  tree.set_root(tree.add(CsgOperator::Intersection, one, two));
  const CsgGeometry lens(tree);
  const auto mesh = lens.triangles(usual_tolerance(lens));
  ASSERT_TRUE(mesh) << mesh.error().message;
  const double cap = std::numbers::pi * 0.0005 * 0.0005 * (0.3 - 0.0005) / 3.0;
  EXPECT_NEAR(geometry::signed_volume((*mesh)->mesh), 2.0 * cap, 0.2 * cap);
}

TEST(Triangles, OfAThinPlateByAFormulaAreThere) {
  const Bounds box(Vector3(-0.3, -0.1, -0.3), Vector3(0.3, 0.1, 0.3));
  const auto plate = *ImplicitGeometry::create("max(abs(y)-0.002, 0.02-sqrt(x^2+z^2))", box);
  const auto mesh = plate->triangles(usual_tolerance(*plate));
  ASSERT_TRUE(mesh) << mesh.error().message;
  const double hole = std::numbers::pi * 0.02 * 0.02;
  EXPECT_NEAR(geometry::signed_volume((*mesh)->mesh), 0.004 * (0.36 - hole), 0.05 * 0.004 * 0.36);
}

TEST(Triangles, AreRefusedForASheetTooThinToBeMet) {
  const Bounds box(Vector3(-0.5, -0.1, -0.5), Vector3(0.5, 0.1, 0.5));
  const auto sheet = *ImplicitGeometry::create("abs(y)-0.0002", box);
  const auto made = sheet->triangles(usual_tolerance(*sheet));
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("too thin"), std::string::npos) << made.error().message;
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
