#include "files/crease_normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"

namespace icome::files {
namespace {

using base::Vector3;

void append_polygon(PolygonMesh& mesh, std::initializer_list<std::uint32_t> corners) {
  mesh.corners.insert(mesh.corners.end(), corners);
  mesh.begins.push_back(std::uint32_t(mesh.corners.size()));
}

PolygonMesh polygon_box() {
  PolygonMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  append_polygon(mesh, {0, 2, 3, 1});
  append_polygon(mesh, {4, 5, 7, 6});
  append_polygon(mesh, {0, 1, 5, 4});
  append_polygon(mesh, {2, 6, 7, 3});
  append_polygon(mesh, {0, 4, 6, 2});
  append_polygon(mesh, {1, 3, 7, 5});
  return mesh;
}

/// A prism about z over a regular polygon of radius and height 1: sides first, then the lower and upper cap.
PolygonMesh polygon_prism(std::uint32_t sides) {
  PolygonMesh mesh;
  for (const double z : {0.0, 1.0}) {
    for (std::uint32_t i = 0; i < sides; ++i)
      mesh.positions.emplace_back(std::cos(2 * std::numbers::pi * i / sides),
                                  std::sin(2 * std::numbers::pi * i / sides), z);
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    append_polygon(mesh, {i, next, sides + next, sides + i});
  }
  for (std::uint32_t i = 0; i < sides; ++i) mesh.corners.push_back(sides - 1 - i);
  mesh.begins.push_back(std::uint32_t(mesh.corners.size()));
  for (std::uint32_t i = 0; i < sides; ++i) mesh.corners.push_back(sides + i);
  mesh.begins.push_back(std::uint32_t(mesh.corners.size()));
  return mesh;
}

TEST(PolygonNormals, ArePerpendicularAndZeroWithoutArea) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1e-20, 0, 0}, {0, 1e-20, 0}, {2e-20, 0, 0}};
  append_polygon(mesh, {0, 1, 2});
  append_polygon(mesh, {0, 1, 3});
  const auto normals = polygon_normals(mesh);
  EXPECT_EQ(normals[0], Vector3(0, 0, 1));
  EXPECT_EQ(normals[1], Vector3(0, 0, 0));
}

TEST(CreaseNormals, OfABoxAreItsFacesBelowARightAngle) {
  const PolygonMesh box = polygon_box();
  const auto faces = polygon_normals(box);
  for (const double angle : {0.0, 0.5, 1.57}) {
    const auto normals = crease_normals(box, angle);
    ASSERT_EQ(normals.size(), 24U);
    for (std::size_t i = 0; i < 24; ++i) EXPECT_LT((normals[i] - faces[i / 4]).norm(), 1e-15) << angle;
  }
}

TEST(CreaseNormals, OfABoxAreNoneWhereAllIsSmooth) {
  EXPECT_TRUE(crease_normals(polygon_box(), std::numbers::pi).empty());
  EXPECT_TRUE(crease_normals(polygon_box(), 100.0).empty());
  EXPECT_TRUE(crease_normals(polygon_box(), 1.58).empty());
  // A right angle in single precision.
  EXPECT_TRUE(crease_normals(polygon_box(), 1.570796).empty());
}

TEST(CreaseNormals, OfAPlaneAreNone) {
  PolygonMesh plane;
  plane.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  append_polygon(plane, {0, 1, 2});
  append_polygon(plane, {0, 2, 3});
  EXPECT_TRUE(crease_normals(plane, 0.0).empty());
  EXPECT_TRUE(crease_normals(plane, 1e-3).empty());
}

TEST(CreaseNormals, OfAPrismAreRadialAndStraight) {
  constexpr std::uint32_t kSides = 12;  // 30 degrees between them
  const PolygonMesh mesh = polygon_prism(kSides);
  const auto normals = crease_normals(mesh, 0.6);
  ASSERT_EQ(normals.size(), mesh.corners.size());
  for (std::uint32_t i = 0; i < mesh.corners.size(); ++i) {
    const bool side = i < 4 * kSides;
    Vector3 expected(0, 0, i < 5 * kSides ? -1 : 1);
    if (side) expected = Vector3(mesh.positions[mesh.corners[i]].x(), mesh.positions[mesh.corners[i]].y(), 0);
    EXPECT_LT((normals[i] - expected).norm(), 1e-14) << i;
  }
}

TEST(CreaseNormals, OfAPrismAreItsFacesBelowItsAngle) {
  const PolygonMesh mesh = polygon_prism(12);
  const auto faces = polygon_normals(mesh);
  const auto normals = crease_normals(mesh, 0.5);
  ASSERT_EQ(normals.size(), mesh.corners.size());
  for (std::uint32_t i = 0; i < 48; ++i) EXPECT_LT((normals[i] - faces[i / 4]).norm(), 1e-14) << i;
}

TEST(CreaseNormals, AreTheMeanByAnglesOfWhatIsNear) {
  // Around the origin: a quarter in z = 0, then three faces each turned away a little further.
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0.3}, {0, -1, -0.9}};
  append_polygon(mesh, {0, 1, 2});
  append_polygon(mesh, {0, 2, 3});
  append_polygon(mesh, {0, 3, 4});
  append_polygon(mesh, {0, 4, 1});
  const auto faces = polygon_normals(mesh);
  const double angle = 0.7;
  const auto normals = crease_normals(mesh, angle);
  ASSERT_EQ(normals.size(), 12U);
  for (int own = 0; own < 4; ++own) {
    Vector3 sum = Vector3::Zero();
    for (int other = 0; other < 4; ++other) {
      if (std::acos(faces[own].dot(faces[other])) > angle) continue;
      const Vector3& a = mesh.positions[mesh.corners[3 * other + 1]];
      const Vector3& b = mesh.positions[mesh.corners[3 * other + 2]];
      sum += std::acos(a.normalized().dot(b.normalized())) * faces[other];
    }
    EXPECT_LT((normals[3 * own] - sum.normalized()).norm(), 1e-14) << own;
  }
}

TEST(CreaseNormals, AreTheSameAtAnyScale) {
  PolygonMesh mesh = polygon_prism(7);
  const auto normals = crease_normals(mesh, 1.0);
  for (const double scale : {0x1p-100, 0x1p100}) {
    PolygonMesh other = mesh;
    for (Vector3& position : other.positions) position *= scale;
    EXPECT_EQ(crease_normals(other, 1.0), normals);
  }
}

TEST(CreaseNormals, AreUnitWhateverTheMeshIs) {
  base::Random random(5);
  for (int trial = 0; trial < 200; ++trial) {
    PolygonMesh mesh;
    for (int i = 0; i < 6; ++i)
      mesh.positions.emplace_back(double(random.index(3)), double(random.index(3)), double(random.index(2)));
    for (int i = 0; i < 8; ++i) {
      for (std::uint64_t k = 3 + random.index(3); k > 0; --k)
        mesh.corners.push_back(std::uint32_t(random.index(6)));
      mesh.begins.push_back(std::uint32_t(mesh.corners.size()));
    }
    for (const double angle : {0.0, 0.8, 2.5}) {
      for (const Vector3& normal : crease_normals(mesh, angle)) ASSERT_NEAR(normal.norm(), 1.0, 1e-14);
    }
  }
}

TEST(CreaseNormals, StayQuickAroundOneVertex) {
  PolygonMesh mesh;
  constexpr std::uint32_t kCount = 200'000;
  mesh.positions.emplace_back(0, 0, 0);
  for (std::uint32_t i = 0; i < kCount; ++i) mesh.positions.emplace_back(std::cos(i), std::sin(i), i % 2);
  for (std::uint32_t i = 2; i < kCount; ++i) append_polygon(mesh, {0, i, i - 1});
  EXPECT_EQ(crease_normals(mesh, 0.5).size(), mesh.corners.size());
}

}  // namespace
}  // namespace icome::files
