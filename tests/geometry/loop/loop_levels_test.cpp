// Refinements of a control mesh: Loop's weights by hand, children, limit normals, and what is refused.
#include "geometry/loop/loop_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/loop/loop_normals.h"
#include "geometry/meshes.h"

namespace icome::geometry {
namespace {

using LevelsPointer = std::shared_ptr<const LoopLevels>;

LevelsPointer refined(const ControlMesh& control, int finest) {
  auto levels = LoopLevels::create(control, {.finest = finest});
  EXPECT_TRUE(levels) << (levels ? "" : levels.error().message);
  return *levels;
}

TriangleMesh octahedron() {
  TriangleMesh mesh;
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

/// A disc of `count` triangles around vertex 0, ring r of `rings` at height `height(r, angle)`.
template <typename Height>
TriangleMesh disc(std::uint32_t count, std::uint32_t rings, Height&& height) {
  TriangleMesh mesh;
  mesh.positions.emplace_back(0.0, 0.0, height(0.0, 0.0));
  for (std::uint32_t r = 1; r <= rings; ++r) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / count;
      mesh.positions.emplace_back(r * std::cos(angle), r * std::sin(angle), height(r, angle));
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({0, 1 + i, 1 + next});
    for (std::uint32_t r = 1; r < rings; ++r) {
      const std::uint32_t in = 1 + (r - 1) * count, out = in + count;
      mesh.triangles.push_back({in + i, out + i, out + next});
      mesh.triangles.push_back({in + i, out + next, in + next});
    }
  }
  return mesh;
}

TriangleMesh wavy_disc(std::uint32_t count) {
  return disc(count, 3, [](double r, double angle) {
    return 0.3 * r * std::sin(angle) + 0.2 * r * r * std::cos(2 * angle + 1);
  });
}

const Vector3& corner_normal(const LoopLevel& level, std::size_t face, int corner) {
  return level.normals[level.corner_normals[face][corner]];
}

/// The same corner of the same face in the next level.
std::size_t child_at(std::size_t face, int corner) { return 4 * face + std::size_t(corner); }

/// The limit does not care from which level it is found: masks that are exact give the same normal from all.
void expect_one_normal(const LoopLevels& levels) {
  for (int k = 0; k < levels.finest(); ++k) {
    const LoopLevel& level = levels.level(k);
    for (std::size_t face = 0; face < level.mesh.triangles.size(); ++face) {
      for (int i = 0; i < 3; ++i) {
        const Vector3& here = corner_normal(level, face, i);
        const Vector3& finer = corner_normal(levels.level(k + 1), child_at(face, i), i);
        ASSERT_NEAR(here.norm(), 1.0, 1e-12);
        ASSERT_LT((here - finer).norm(), 1e-9) << "level " << k << ", face " << face << ", corner " << i;
      }
    }
  }
}

/// The faces of the finest level turn to the limit normals.
void expect_normals_of_the_surface(const LoopLevels& levels, double tolerance) {
  const LoopLevel& finest = levels.level(levels.finest());
  for (std::size_t face = 0; face < finest.mesh.triangles.size(); ++face) {
    const Vector3& a = finest.mesh.corner(face, 0);
    const Vector3 flat =
        (finest.mesh.corner(face, 1) - a).cross(finest.mesh.corner(face, 2) - a).normalized();
    for (int i = 0; i < 3; ++i) ASSERT_LT((corner_normal(finest, face, i) - flat).norm(), tolerance) << face;
  }
}

TEST(LoopLevels, WeightsAreLoops) {
  const LevelsPointer levels = refined({octahedron(), {}, {}}, 1);
  const TriangleMesh& mesh = levels->level(1).mesh;
  ASSERT_EQ(mesh.positions.size(), 18u);
  ASSERT_EQ(mesh.triangles.size(), 32u);
  // Valence 4: beta = (5/8 - (3/8 + cos(90 degrees) / 4)^2) / 4 = 31/256, neighbours cancel out.
  EXPECT_LT((mesh.corner(child_at(0, 0), 0) - Vector3(33.0 / 64, 0, 0)).norm(), 1e-15);
  // An edge: 3/8 of its ends, 1/8 of the two opposite vertices, which cancel out.
  EXPECT_LT((mesh.corner(child_at(0, 0), 1) - Vector3(0.375, 0.375, 0)).norm(), 1e-15);
  EXPECT_TRUE(levels->closed());
}

TEST(LoopLevels, ValenceSixHasAWeightOfASixteenth) {
  const TriangleMesh mesh = disc(6, 2, [](double r, double) { return r == 0.0 ? 16.0 : 0.0; });
  const LevelsPointer levels = refined({mesh, {}, {}}, 1);
  EXPECT_NEAR(levels->level(1).mesh.corner(child_at(0, 0), 0).z(), 16.0 * (1.0 - 6.0 / 16), 1e-12);
}

TEST(LoopLevels, ABoundaryIsASubdivisionCurve) {
  const TriangleMesh mesh = disc(6, 1, [](double, double) { return 0.0; });
  const LevelsPointer levels = refined({mesh, {}, {}}, 1);
  EXPECT_FALSE(levels->closed());
  // (1, 6, 1) / 8 along the hexagon of radius 1: 3/4 + 1/8 * 2 * cos(60 degrees).
  EXPECT_LT((levels->level(1).mesh.corner(child_at(0, 1), 1) - Vector3(0.875, 0, 0)).norm(), 1e-15);
}

TEST(LoopLevels, CreasesAndCornersStaySharp) {
  ControlMesh control{octahedron(), {{0, 2}, {2, 1}, {1, 3}, {3, 0}}, {4}};
  const LevelsPointer levels = refined(control, 3);
  std::size_t face = 0;
  for (int k = 0; k < 3; ++k) face = child_at(face, 2);
  EXPECT_EQ(levels->level(3).mesh.corner(face, 2), Vector3(0, 0, 1));  // the corner
  face = 0;
  for (int k = 0; k < 3; ++k) {
    face = child_at(face, 0);
    EXPECT_EQ(levels->level(k + 1).mesh.corner(face, 0).z(), 0.0);  // the crease is a curve of its plane
  }
  // The two sides of the crease have normals of their own, mirror images.
  const Vector3 above = corner_normal(levels->level(3), 0, 0),
                below = corner_normal(levels->level(3), child_at(child_at(child_at(4, 1), 1), 1), 1);
  EXPECT_GT(above.z(), 0.1);
  EXPECT_LT((above - Vector3(below.x(), below.y(), -below.z())).norm(), 0.2);
}

TEST(LoopLevels, ChildrenTileTheirParent) {
  // A flat regular mesh stays where it is, but for its boundary.
  const TriangleMesh mesh = disc(6, 1, [](double, double) { return 0.0; });
  ControlMesh control{mesh, {}, {1, 2, 3, 4, 5, 6}};
  const LevelsPointer levels = refined(control, 3);
  const auto area = [](const TriangleMesh& m, std::size_t f) {
    return 0.5 * (m.corner(f, 1) - m.corner(f, 0)).cross(m.corner(f, 2) - m.corner(f, 0)).z();
  };
  for (int k = 0; k < 3; ++k) {
    const TriangleMesh& coarse = levels->level(k).mesh;
    const TriangleMesh& fine = levels->level(k + 1).mesh;
    for (std::size_t f = 0; f < coarse.triangles.size(); ++f) {
      double sum = 0.0;
      for (std::size_t child = 4 * f; child < 4 * f + 4; ++child) {
        EXPECT_GT(area(fine, child), 0.0);
        sum += area(fine, child);
      }
      EXPECT_NEAR(sum, area(coarse, f), 1e-12);
      for (int i = 0; i < 3; ++i)
        EXPECT_LT((fine.corner(child_at(f, i), i) - coarse.corner(f, i)).norm(), 1e-12);
    }
  }
}

TEST(LoopLevels, KnowsTheFacesAroundAVertex) {
  const LevelsPointer levels = refined({octahedron(), {}, {}}, 2);
  const LoopLevel& level = levels->level(1);
  for (std::uint32_t v = 0; v < level.mesh.positions.size(); ++v) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t f = 0; f < level.mesh.triangles.size(); ++f)
      for (const std::uint32_t corner : level.mesh.triangles[f])
        if (corner == v) expected.push_back(f);
    const auto found = level.faces_around(v);
    EXPECT_EQ(std::vector<std::uint32_t>(found.begin(), found.end()), expected);
  }
}

TEST(LoopLevels, LimitNormalsAtEveryValence) {
  for (const std::uint32_t valence : {3u, 4u, 5u, 6u, 7u, 12u}) {
    const LevelsPointer levels = refined({wavy_disc(valence), {}, {}}, 5);
    expect_one_normal(*levels);  // its rim has vertices of several valences too
    expect_normals_of_the_surface(*levels, valence < 12 ? 0.1 : 0.2);
  }
}

TEST(LoopLevels, LimitNormalsAtCreasesDartsAndCorners) {
  // Two spokes make a crease through the middle, one a dart, three a corner.
  for (const std::uint32_t spokes : {1u, 2u, 3u}) {
    ControlMesh control{wavy_disc(7), {}, {}};
    for (std::uint32_t i = 0; i < spokes; ++i) control.creases.push_back({0, 1 + 3 * i % 7});
    SCOPED_TRACE(spokes);
    expect_one_normal(*refined(control, 4));
  }
}

TEST(LoopLevels, LimitNormalsDoNotDependOnSize) {
  ControlMesh small{wavy_disc(5), {}, {}};
  for (Vector3& p : small.mesh.positions) p = 1e-6 * p;
  const LevelsPointer one = refined({wavy_disc(5), {}, {}}, 2), other = refined(small, 2);
  for (std::size_t i = 0; i < one->level(2).normals.size(); ++i)
    ASSERT_LT((one->level(2).normals[i] - other->level(2).normals[i]).norm(), 1e-9);
}

TEST(LoopLevels, LeavesOutUnusedVertices) {
  ControlMesh control{octahedron(), {{3, 5}}, {}};
  control.mesh.positions.insert(control.mesh.positions.begin(), Vector3(9, 9, 9));
  for (TriangleMesh::Triangle& t : control.mesh.triangles)
    for (std::uint32_t& v : t) ++v;
  const LevelsPointer levels = refined(control, 1);
  EXPECT_EQ(levels->level(0).mesh.positions.size(), 6u);
  EXPECT_EQ(levels->bounds().max(), Vector3(1, 1, 1));
}

std::string levels_refusal(const ControlMesh& control, const LoopLevelsSettings& settings = {}) {
  const auto levels = LoopLevels::create(control, settings);
  return levels ? "accepted" : levels.error().message;
}

TEST(LoopLevels, RefusesWhatIsNoSurface) {
  EXPECT_EQ(levels_refusal({}), "the control mesh has no triangles");
  ControlMesh control{octahedron(), {}, {}};
  control.mesh.positions[2].y() = std::nan("");
  EXPECT_NE(levels_refusal(control).find("vertex 2"), std::string::npos);
  control.mesh = octahedron();
  control.mesh.positions[2].y() = -1e300;
  EXPECT_NE(levels_refusal(control).find("vertex 2"), std::string::npos);
  control.mesh = octahedron();
  control.mesh.triangles[3] = {0, 0, 1};
  EXPECT_NE(levels_refusal(control).find("triangle 3"), std::string::npos);
  control.mesh.triangles[3] = {0, 77, 1};
  EXPECT_NE(levels_refusal(control).find("triangle 3"), std::string::npos);
  control.mesh = octahedron();
  control.mesh.triangles.push_back({0, 2, 3});
  EXPECT_NE(levels_refusal(control).find("three triangles"), std::string::npos);
  control.mesh = octahedron();
  std::swap(control.mesh.triangles[0][0], control.mesh.triangles[0][1]);
  EXPECT_NE(levels_refusal(control).find("turn them"), std::string::npos);
  control = {octahedron(), {{0, 1}}, {}};
  EXPECT_NE(levels_refusal(control).find("crease from vertex 0 to 1"), std::string::npos);
  control = {octahedron(), {}, {6}};
  EXPECT_NE(levels_refusal(control).find("corner 6"), std::string::npos);
}

TEST(LoopLevels, KeepsToItsMemory) {
  EXPECT_NE(levels_refusal({octahedron(), {}, {}}, {.finest = 11}).find("0 to 10"), std::string::npos);
  EXPECT_NE(levels_refusal({octahedron(), {}, {}}, {.finest = -1}).find("0 to 10"), std::string::npos);
  const LoopLevelsSettings tight{.finest = 8, .max_bytes = 1'000'000};
  const std::string message = levels_refusal({octahedron(), {}, {}}, tight);
  EXPECT_NE(message.find("use level 5"), std::string::npos) << message;
  const LevelsPointer fits =
      *LoopLevels::create({octahedron(), {}, {}}, {.finest = 5, .max_bytes = 1'000'000});
  EXPECT_LE(fits->bytes(), 1'000'000u);
  EXPECT_GE(fits->bytes(), 300'000u);
}

TEST(LoopLevels, TakesVerticesWhereSurfacesTouch) {
  TriangleMesh bow;  // two triangles that share one vertex, which stays in place
  bow.positions = {{0, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}};
  bow.triangles = {{0, 1, 2}, {0, 3, 4}};
  const LevelsPointer levels = refined({bow, {}, {}}, 2);
  EXPECT_EQ(levels->level(1).mesh.corner(child_at(0, 0), 0), Vector3(0, 0, 0));
  for (const Vector3& normal : levels->level(2).normals) EXPECT_LT((normal - Vector3::UnitZ()).norm(), 1e-12);
}

}  // namespace
}  // namespace icome::geometry
