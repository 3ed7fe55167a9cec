#include "geometry/csg/csg_leaf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/random.h"
#include "geometry/closed_mesh.h"
#include "geometry/csg_trees.h"

namespace icome::geometry {
namespace csg_leaf_test {
namespace {

constexpr double kLeafInfinity = std::numeric_limits<double>::infinity();

bool is_plane(const CsgShape& shape) {
  const auto* primitive = std::get_if<Primitive>(&shape);
  return primitive != nullptr && std::holds_alternative<Plane>(*primitive);
}

std::vector<CsgShape> finite_shapes() {
  std::vector<CsgShape> shapes = all_shapes();
  std::erase_if(shapes, is_plane);
  return shapes;
}

Affine3 rigid(base::Random& random) {
  Affine3 result = Affine3::Identity();
  result.linear() = Eigen::AngleAxisd(random.uniform(0.0, 6.0), random.direction()).toRotationMatrix();
  result.translation() = 3.0 * random.direction();
  return result;
}

/// A sphere as somebody's own primitive, which answers as the built-in one does.
class OwnSphere final : public CsgPrimitive {
 public:
  bool inside(const Vector3& point) const override { return geometry::inside(sphere_, point); }
  SurfacePoint scp_from_inside(const Vector3& point) const override {
    return geometry::scp_from_inside(sphere_, point);
  }
  SurfacePoint scp_from_outside(const Vector3& point) const override {
    return geometry::scp_from_outside(sphere_, point);
  }
  Bounds bounds() const override { return geometry::bounds(sphere_); }
  TriangleMesh tessellate(double tolerance) const override {
    return geometry::tessellate(sphere_, tolerance);
  }
  std::string name() const override { return "my sphere"; }

 private:
  Primitive sphere_ = Sphere{0.5};
};

TEST(CsgLeaf, BoundsOfStretchedSphereAreTheEllipsoids) {
  Affine3 stretch = moved(1, 2, 3);
  stretch.linear() = Vector3(2, 3, -4).asDiagonal();
  const Bounds box = CsgLeaf(Primitive(Sphere{0.5}), stretch).bounds();
  EXPECT_EQ(box.min(), Vector3(0, 0.5, 1));
  EXPECT_EQ(box.max(), Vector3(2, 3.5, 5));
}

TEST(CsgLeaf, BoundsOfTurnedConeReachToItsTipAndItsRim) {
  Affine3 turned = Affine3::Identity();  // z becomes x
  turned.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  const Bounds box = CsgLeaf(Primitive(Cone{0.5, 0.0, 2.0}), turned).bounds();
  EXPECT_EQ(box.min(), Vector3(-1, -0.5, -0.5));
  EXPECT_EQ(box.max(), Vector3(1, 0.5, 0.5));
}

TEST(CsgLeaf, BoundsHoldEveryFineMeshTightly) {
  base::Random random(1);
  for (const CsgShape& shape : finite_shapes()) {
    for (int i = 0; i < 20; ++i) {
      const CsgLeaf leaf(shape, random_affine(random, 2.0));
      const double tolerance = 1e-3;
      const Bounds of_mesh = bounds(leaf.tessellate(tolerance));
      EXPECT_LE((leaf.bounds().min() - of_mesh.min()).maxCoeff(), 1e-14) << leaf.name();
      EXPECT_LE((of_mesh.max() - leaf.bounds().max()).maxCoeff(), 1e-14) << leaf.name();
      EXPECT_LE((of_mesh.min() - leaf.bounds().min()).maxCoeff(), tolerance) << leaf.name();
      EXPECT_LE((leaf.bounds().max() - of_mesh.max()).maxCoeff(), tolerance) << leaf.name();
    }
  }
}

TEST(CsgLeaf, BoundsOfAPlaneEndWhereItIsAlignedWithAnAxis) {
  Affine3 turned = moved(0.25, 0, 0);  // its free side along +x
  turned.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  const Bounds box = CsgLeaf(Primitive(Plane{}), turned).bounds();
  EXPECT_EQ(box.max(), Vector3(0.25, kLeafInfinity, kLeafInfinity));
  EXPECT_EQ(box.min(), Vector3::Constant(-kLeafInfinity));

  Affine3 tilted = Affine3::Identity();
  tilted.linear() = Eigen::AngleAxisd(0.5, Vector3(1, 1, 1).normalized()).toRotationMatrix();
  EXPECT_EQ(CsgLeaf(Primitive(Plane{}), tilted).bounds().max(), Vector3::Constant(kLeafInfinity));
}

TEST(CsgLeaf, BoundsOfOwnPrimitiveAreThoseOfItsBox) {
  const auto own = std::make_shared<const OwnSphere>();
  base::Random random(2);
  const Affine3 placing = random_affine(random, 1.0);
  const Bounds of_box = CsgLeaf(Primitive(Box{Vector3::Constant(0.5)}), placing).bounds();
  EXPECT_TRUE(CsgLeaf(own, placing).bounds().isApprox(of_box, 1e-15));
}

TEST(CsgLeaf, InsideIsThatOfThePointBroughtToTheShape) {
  base::Random random(3);
  for (const CsgShape& shape : all_shapes()) {
    const Affine3 placing = random_affine(random, 1.0);
    const CsgLeaf leaf(shape, placing);
    int inside_count = 0;
    for (int i = 0; i < 500; ++i) {
      const Vector3 local = random.uniform(0.0, 0.8) * random.direction();
      EXPECT_EQ(leaf.inside(placing * local), shape_encloses(shape, local)) << leaf.name();
      inside_count += shape_encloses(shape, local);
    }
    EXPECT_GT(inside_count, 20) << leaf.name();
    EXPECT_LT(inside_count, 480) << leaf.name();
  }
}

TEST(CsgLeaf, SurfacePointsOfAMeshCountAsInside) {
  const CsgLeaf leaf(mesh_solid(box_mesh({0, 0, 0}, {0.1, 0.2, 0.3})), Affine3::Identity());
  base::Random random(4);
  for (int i = 0; i < 200; ++i) {
    Vector3 point(random.uniform(0, 0.1), random.uniform(0, 0.2), random.uniform(0, 0.3));
    const auto axis = static_cast<Eigen::Index>(random.index(3));
    point[axis] = random.index(2) == 0 ? 0.0 : 0.1 * static_cast<double>(axis + 1);
    EXPECT_TRUE(leaf.inside(point)) << point.transpose();
    point[axis] += point[axis] > 0 ? 1e-12 : -1e-12;
    EXPECT_FALSE(leaf.inside(point)) << point.transpose();
  }
}

TEST(CsgLeaf, AnswersAreExactUnderSimilarities) {
  base::Random random(5);
  for (const CsgShape& shape : finite_shapes()) {
    const CsgLeaf at_home(shape, Affine3::Identity());
    for (int i = 0; i < 50; ++i) {
      Affine3 placing = rigid(random);
      placing.linear() *= 1e-3;
      if (random.index(2) == 0) placing.linear().col(0) *= -1.0;
      const CsgLeaf leaf(shape, placing);
      const Vector3 local = random.uniform(0.1, 1.5) * random.direction();
      const bool is_inside = at_home.inside(local);
      const SurfacePoint expected =
          is_inside ? at_home.scp_from_inside(local) : at_home.scp_from_outside(local);
      const Vector3 point = placing * local;
      const SurfacePoint got = is_inside ? leaf.scp_from_inside(point) : leaf.scp_from_outside(point);
      EXPECT_LE((got.point - placing * expected.point).norm(), 1e-14) << leaf.name();
      EXPECT_LE((got.normal - (placing.linear() * expected.normal).normalized()).norm(), 1e-9) << leaf.name();
    }
  }
}

TEST(CsgLeaf, NormalsPointOutUnderEveryTransform) {
  base::Random random(6);
  for (const CsgShape& shape : all_shapes()) {
    for (int i = 0; i < 100; ++i) {
      const CsgLeaf leaf(shape, random_affine(random, 1.0));
      const Vector3 point = leaf.tree_from_shape() * Vector3(random.uniform(0.0, 1.0) * random.direction());
      const SurfacePoint surface =
          leaf.inside(point) ? leaf.scp_from_inside(point) : leaf.scp_from_outside(point);
      EXPECT_NEAR(surface.normal.norm(), 1.0, 1e-14);
      const double step = 1e-7;
      // Inwards only from faces: where an edge is sharp, the way back along its normal is outside too.
      EXPECT_TRUE(!leaf.inside(point) || leaf.inside(surface.point - step * surface.normal)) << leaf.name();
      EXPECT_FALSE(leaf.inside(surface.point + step * surface.normal)) << leaf.name();
    }
  }
}

TEST(CsgLeaf, NormalOfAStretchedSphereIsTheEllipsoids) {
  const Vector3 axes(1.0, 2.0, 0.5);
  Affine3 stretch = Affine3::Identity();
  stretch.linear() = axes.asDiagonal();
  const CsgLeaf leaf(Primitive(Sphere{1.0}), stretch);
  base::Random random(7);
  for (int i = 0; i < 50; ++i) {
    const SurfacePoint got = leaf.scp_from_outside(3.0 * random.direction());
    const Vector3 gradient = got.point.cwiseQuotient(axes.cwiseAbs2());
    EXPECT_NEAR(got.point.cwiseQuotient(axes).norm(), 1.0, 1e-14);
    EXPECT_LE((got.normal - gradient.normalized()).norm(), 1e-14);
  }
}

TEST(CsgLeaf, MeshBoxAnswersAsTheBoxDoes) {
  const Vector3 half(0.1, 0.2, 0.3);
  const CsgLeaf mesh(mesh_solid(box_mesh(-half, half)), moved(1, 2, 3));
  const CsgLeaf box(Primitive(Box{half}), moved(1, 2, 3));
  base::Random random(8);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 point = Vector3(1, 2, 3) + random.uniform(0.0, 0.8) * random.direction();
    ASSERT_EQ(mesh.inside(point), box.inside(point));
    const bool is_inside = box.inside(point);
    const SurfacePoint expected = is_inside ? box.scp_from_inside(point) : box.scp_from_outside(point);
    const SurfacePoint got = is_inside ? mesh.scp_from_inside(point) : mesh.scp_from_outside(point);
    EXPECT_LE((got.point - expected.point).norm(), 1e-14);
    EXPECT_LE((got.normal - expected.normal).norm(), 1e-12);
  }
}

TEST(CsgLeaf, TessellationFacesOutAndKeepsTheTolerance) {
  base::Random random(9);
  for (const CsgShape& shape : finite_shapes()) {
    for (int i = 0; i < 4; ++i) {
      const CsgLeaf leaf(shape, random_affine(random, 0.5));
      const double tolerance = 2e-3;
      const TriangleMesh mesh = leaf.tessellate(tolerance);
      EXPECT_TRUE(is_closed(mesh));
      EXPECT_GT(volume(mesh), 0.0);
      for (std::size_t t = 0; t < mesh.triangles.size(); t += 7) {
        const Vector3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3;
        const SurfacePoint near =
            leaf.inside(middle) ? leaf.scp_from_inside(middle) : leaf.scp_from_outside(middle);
        EXPECT_LE((near.point - middle).norm(), tolerance) << leaf.name();
      }
    }
  }
}

TEST(CsgLeaf, TessellationOfATinyMirroredShapeFacesOut) {
  Affine3 tiny = Affine3::Identity();
  tiny.linear() = 1e-120 * Vector3(-1, 1, 1).asDiagonal().toDenseMatrix();
  const TriangleMesh plain = tessellate(Primitive(Sphere{1.0}), 0.1);
  const TriangleMesh mesh = CsgLeaf(Primitive(Sphere{1.0}), tiny).tessellate(1e-121);
  ASSERT_EQ(mesh.triangles.size(), plain.triangles.size());
  EXPECT_EQ(mesh.triangles[0][1], plain.triangles[0][2]);
}

TEST(CsgLeaf, NamesForPeople) {
  const Affine3 home = Affine3::Identity();
  EXPECT_EQ(CsgLeaf(Primitive(Box{{0.05, 0.1, 0.15}}), home).name(), "box:0.1x0.2x0.3");
  EXPECT_EQ(CsgLeaf(mesh_solid(unit_box()), home).name(), "mesh of 12 triangles");
  EXPECT_EQ(CsgLeaf(std::make_shared<const OwnSphere>(), home).name(), "my sphere");
}

}  // namespace
}  // namespace csg_leaf_test
}  // namespace icome::geometry
