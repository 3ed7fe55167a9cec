#include "render/model/shape_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/model/render_shape.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::render {
namespace {

using base::Vector3;

/// A ball of quads: radius 1, `n` rows.
geometry::TriangleMesh ball(std::uint32_t n) {
  geometry::TriangleMesh mesh;
  const std::uint32_t round = 2 * n;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i < round; ++i) {
      const double t = std::numbers::pi * j / n, p = 2.0 * std::numbers::pi * i / round;
      mesh.positions.emplace_back(std::sin(t) * std::cos(p), std::cos(t), std::sin(t) * std::sin(p));
    }
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < round; ++i) {
      const std::uint32_t a = j * round + i, b = j * round + (i + 1) % round;
      mesh.triangles.push_back({a, b, a + round});
      mesh.triangles.push_back({b, b + round, a + round});
    }
  }
  return mesh;
}

TEST(ShapeLevels, GetCoarserAndStayAtTheSurface) {
  const ShadingMesh fine = make_shading_mesh(ball(120), 0.9);
  const auto levels = make_shape_levels(fine, {});
  ASSERT_GE(levels.size(), 3U);
  std::size_t before = fine.indices.size();
  for (const ShapeLevel& level : levels) {
    EXPECT_LE(level.mesh.indices.size(), 0.6 * double(before));
    before = level.mesh.indices.size();
    EXPECT_EQ(level.mesh.centre, fine.centre);
    EXPECT_EQ(level.mesh.radius, fine.radius);
    for (const auto& it : level.mesh.vertices) {
      const Vector3 at = fine.centre + fine.radius * it.position.cast<double>();
      EXPECT_NEAR(at.norm(), 1.0, level.cell * fine.radius);
      EXPECT_NEAR(it.normal.norm(), 1.0F, 1e-4F);
      EXPECT_GT(it.normal.cast<double>().dot(at), 0.9);
    }
  }
}

TEST(ShapeLevels, EdgesStayEdges) {
  // A fine cube: its sides' normals must not mix at the edges.
  geometry::TriangleMesh cube;
  constexpr std::uint32_t kSide = 40;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double height : {-1.0, 1.0}) {
      const auto first = std::uint32_t(cube.positions.size());
      for (std::uint32_t v = 0; v <= kSide; ++v) {
        for (std::uint32_t u = 0; u <= kSide; ++u) {
          Vector3 p;
          p[axis] = height;
          p[(axis + 1) % 3] = 2.0 * u / kSide - 1.0;
          p[(axis + 2) % 3] = 2.0 * v / kSide - 1.0;
          cube.positions.push_back(p);
        }
      }
      for (std::uint32_t v = 0; v < kSide; ++v) {
        for (std::uint32_t u = 0; u < kSide; ++u) {
          const std::uint32_t a = first + v * (kSide + 1) + u, b = a + kSide + 1;
          cube.triangles.push_back({a, a + 1, b});
          cube.triangles.push_back({a + 1, b + 1, b});
        }
      }
    }
  }
  for (const ShapeLevel& level : make_shape_levels(make_shading_mesh(cube, 0.9), {})) {
    for (const auto& it : level.mesh.vertices) EXPECT_GT(it.normal.cwiseAbs().maxCoeff(), 0.999F);
  }
}

TEST(ShapeLevels, ColoursAreAveraged) {
  const ShadingMesh fine = make_shading_mesh(ball(60), 0.9);
  std::vector<Eigen::Vector3f> colours;
  for (const auto& it : fine.vertices) colours.emplace_back(it.position.y() > 0.0F ? 1.0F : 0.0F, 0.5F, 0.0F);
  const auto levels = make_shape_levels(fine, colours);
  ASSERT_FALSE(levels.empty());
  for (const ShapeLevel& level : levels) {
    ASSERT_EQ(level.colours.size(), level.mesh.vertices.size());
    for (std::size_t v = 0; v < level.colours.size(); ++v) {
      const float height = level.mesh.vertices[v].position.y();
      if (std::abs(height) > float(level.cell)) {
        EXPECT_FLOAT_EQ(level.colours[v].x(), height > 0.0F ? 1.0F : 0.0F);
      }
      EXPECT_FLOAT_EQ(level.colours[v].y(), 0.5F);
    }
  }
}

TEST(ShapeLevels, FewTrianglesHaveNone) {
  EXPECT_TRUE(make_shape_levels(make_shading_mesh(ball(8), 0.9), {}).empty());
  EXPECT_TRUE(make_shape_levels({}, {}).empty());
}

TEST(ShapeLevels, PrimitivesKeepExactNormals) {
  const auto shape = make_render_shape(world::PrimitiveGeometry(geometry::Sphere{0.03}));
  ASSERT_TRUE(shape.has_value());
  ASSERT_GE((*shape)->coarser.size(), 2U);
  for (const ShapeLevel& level : (*shape)->coarser) {
    EXPECT_TRUE((*shape)->mesh.centre == level.mesh.centre && (*shape)->mesh.radius == level.mesh.radius);
    for (const auto& it : level.mesh.vertices) {
      const Vector3 at = level.mesh.centre + level.mesh.radius * it.position.cast<double>();
      EXPECT_NEAR(at.norm(), 0.03, level.cell * level.mesh.radius);
      EXPECT_GT(it.normal.cast<double>().dot(at.normalized()), 0.95);
    }
  }
}

}  // namespace
}  // namespace icome::render
