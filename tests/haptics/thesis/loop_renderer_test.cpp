// Thesis 5.4: the inside-outside test and the SCP of a Loop surface against all faces of its finest level,
// and the count of face checks.
#include "haptics/thesis/loop_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "geometry/mesh/geodesic_sphere.h"
#include "geometry/tree/triangle_tree.h"
#include "haptics/contact_world.h"
#include "haptics/thesis/thesis_shapes.h"

namespace icome::haptics {
namespace {

using geometry::ControlMesh;
using geometry::LoopLevels;
using LevelsPointer = std::shared_ptr<const LoopLevels>;

LevelsPointer refined(const TriangleMesh& mesh, int finest) {
  return *LoopLevels::create({mesh, {}, {}}, {.finest = finest});
}

/// A ring of `around` by `across` vertices, all of valence 6.
TriangleMesh torus(std::uint32_t around, std::uint32_t across, double major, double minor) {
  TriangleMesh mesh;
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i % around * across + j % across; };
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double a = 2.0 * std::numbers::pi * i / around, b = 2.0 * std::numbers::pi * j / across;
      const double out = major + minor * std::cos(b);
      mesh.positions.emplace_back(out * std::cos(a), out * std::sin(a), minor * std::sin(b));
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// 20 triangles of the regular lattice: one at the origin, the 12 around it, and 7 more.
TriangleMesh sheet_of_20(double z) {
  TriangleMesh mesh;
  constexpr int kSide = 6;
  for (int j = 0; j <= kSide; ++j)
    for (int i = 0; i <= kSide; ++i)
      mesh.positions.emplace_back(i - 2 + 0.5 * (j - 2) - 0.5, (j - 2) * std::sqrt(0.75) - 0.25, z);
  std::vector<std::pair<double, TriangleMesh::Triangle>> by_distance;
  const auto add = [&](int a, int b, int c) {
    const TriangleMesh::Triangle t{std::uint32_t(a), std::uint32_t(b), std::uint32_t(c)};
    const Vector3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
    by_distance.emplace_back(middle.head<2>().norm(), t);
  };
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const int at = j * (kSide + 1) + i;
      add(at, at + 1, at + kSide + 1);
      add(at + 1, at + kSide + 2, at + kSide + 1);
    }
  }
  std::sort(by_distance.begin(), by_distance.end());
  for (int i = 0; i < 20; ++i) mesh.triangles.push_back(by_distance[std::size_t(i)].second);
  return mesh;
}

double deviation(const LoopLevels& levels) {
  // From the control mesh to the finest level: how far vertices go.
  double most = 0.0;
  std::vector<std::size_t> faces(levels.level(0).mesh.triangles.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      std::size_t child = f;
      for (int k = 0; k < levels.finest(); ++k) child = 4 * child + std::size_t(i);
      most = std::max(
          most,
          (levels.level(0).mesh.corner(f, i) - levels.level(levels.finest()).mesh.corner(child, i)).norm());
    }
  }
  return most;
}

TEST(LoopRenderer, FaceChecksByTheArithmeticOfTheThesis) {
  static_assert(face_checks(100, 4, 5) == 1140);
  static_assert(whole_mesh_checks(100, 4) == 25'600);
  static_assert(face_checks(100, 0, 5) == 100);
}

TEST(LoopRenderer, FaceChecksOfARealMeshOf100FacesCrossedFiveTimes) {
  // Five regular sheets of 20 faces: each crossed face has its 13, none of which belong to another's.
  TriangleMesh mesh;
  for (int i = 0; i < 5; ++i) mesh = joined(mesh, sheet_of_20(i));
  ASSERT_EQ(mesh.triangles.size(), 100u);
  const LoopRenderer renderer(refined(mesh, 4));
  LoopWorkspace space;
  const LoopRenderer::Answer answer = renderer.render({0.013, 0.027, -0.1}, space);
  EXPECT_TRUE(answer.test.inside);
  EXPECT_EQ(answer.test.crossings, 5u);
  EXPECT_EQ(answer.test.level, 4);
  EXPECT_EQ(answer.checks, 1140u);
  EXPECT_LT((answer.scp.point - Vector3(0.013, 0.027, 0.0)).norm(), 1e-12);
}

TEST(LoopRenderer, FaceChecksOfASolidCountTheClosestFaceToo) {
  // Three rings of 36, 32 and 32 faces of valence 6, one upon the other; the ray leaves the first one's tube
  // and goes through two more. The arithmetic leaves out the closest face, whose 13 are one more
  // neighbourhood unless it is crossed; and on so few faces neighbourhoods overlap in the control mesh, and
  // count once.
  TriangleMesh mesh = torus(6, 3, 1.0, 0.4);
  mesh = joined(mesh, torus(4, 4, 1.0, 0.4), {0.0, 0.0, 1.5});
  mesh = joined(mesh, torus(4, 4, 1.0, 0.4), {0.0, 0.0, 3.0});
  ASSERT_EQ(mesh.triangles.size(), 100u);
  const LoopRenderer renderer(refined(mesh, 4));
  LoopWorkspace space;
  Random random(1);
  int asked = 0;
  std::size_t most = 0, least = 10'000, sum = 0;
  for (int i = 0; i < repeats(5000); ++i) {
    const Vector3 p(random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2), random.uniform(-0.2, 0.2));
    const LoopRenderer::Answer answer = renderer.render(p, space);
    if (answer.test.crossings != 5 || answer.test.level < 4) continue;
    ++asked;
    most = std::max(most, answer.checks);
    least = std::min(least, answer.checks);
    sum += answer.checks;
  }
  ASSERT_GT(asked, 0);
  EXPECT_LE(most, face_checks(100, 4, 6));
  EXPECT_GT(least, face_checks(100, 4, 3));
  std::printf("          100 faces of rings, crossed 5 times, level 4: %zu to %zu checks, mean %zu\n", least,
              most, sum / std::size_t(asked));
}

struct Solid {
  const char* name;
  TriangleMesh mesh;
  double wrong;  // share of points that the heuristic may misjudge
};

std::vector<Solid> solids() {
  return {{"box", box_mesh({0.1, 0.06, 0.1}), 0.0},
          {"sphere", geometry::bumpy_geodesic_sphere(2, 0.05, 0.0, 8), 0.0},
          {"bumpy", geometry::bumpy_geodesic_sphere(5, 0.05, 0.3, 4), 0.005},
          {"ring", torus(10, 5, 0.08, 0.03), 0.015}};
}

/// Half the points anywhere in the box, half near the surface.
Vector3 random_point(Random& random, const TriangleMesh& finest, const base::Bounds& box, int i) {
  if (i % 2 == 0) {
    const Vector3 share(random.uniform(), random.uniform(), random.uniform());
    return box.min() + share.cwiseProduct(box.sizes());
  }
  const Vector3& on = finest.positions[random.index(finest.positions.size())];
  return on + random.uniform(0.0, 0.05) * box.sizes().norm() * random.direction();
}

TEST(LoopRenderer, TellsInsideAsTheWindingOfTheFinestLevelDoes) {
  for (const Solid& solid : solids()) {
    const LoopRenderer renderer(refined(solid.mesh, 2));
    const TriangleMesh& finest = renderer.levels().level(2).mesh;
    LoopWorkspace space;
    Random random(2);
    const int points = repeats(1000);
    const double off = deviation(renderer.levels());
    int wrong = 0;
    for (int i = 0; i < points; ++i) {
      const Vector3 p = random_point(random, finest, renderer.levels().bounds(), i);
      const LoopRenderer::Test test = renderer.inside(p, space);
      if (test.inside == (std::lround(brute_winding(finest, p)) == 1)) continue;
      ++wrong;  // only where refinement still moves the surface, and the test left early
      EXPECT_LT(brute_nearest(finest, p).distance, off) << solid.name;
    }
    EXPECT_LE(wrong, std::ceil(solid.wrong * points)) << solid.name;
  }
}

TEST(LoopRenderer, PutsTheScpOnTheFinestLevelNearest) {
  for (const Solid& solid : solids()) {
    const LoopRenderer renderer(refined(solid.mesh, 2));
    const TriangleMesh& finest = renderer.levels().level(2).mesh;
    const double size = renderer.levels().bounds().sizes().norm();
    LoopWorkspace space;
    Random random(3);
    double worst = 0.0;
    int farther = 0, asked = 0;
    for (int i = 0; i < repeats(600); ++i) {
      const Vector3 p = random_point(random, finest, renderer.levels().bounds(), i);
      const LoopRenderer::Answer answer = renderer.render(p, space);
      if (!answer.test.inside || std::lround(brute_winding(finest, p)) != 1) continue;
      ++asked;
      EXPECT_LT(brute_nearest(finest, answer.scp.point).distance, 1e-12 * size);
      const double more = (answer.scp.point - p).norm() - brute_nearest(finest, p).distance;
      farther += more > 1e-12 * size;
      worst = std::max(worst, more);
    }
    EXPECT_GE(20 * asked, repeats(600)) << solid.name;
    EXPECT_LE(farther, 0.02 * asked) << solid.name;  // the closest control face is not above the closest face
    EXPECT_LT(worst, 0.01 * size) << solid.name;
  }
}

TEST(LoopRenderer, NormalsAreThoseOfTheLimit) {
  // A fine sphere stays round: its limit normals point away from the middle.
  const LoopRenderer renderer(refined(geometry::bumpy_geodesic_sphere(8, 0.05, 0.0, 8), 2));
  LoopWorkspace space;
  Random random(4);
  for (int i = 0; i < repeats(500); ++i) {
    const Vector3 out = random.direction();
    const LoopRenderer::Answer answer = renderer.render(0.045 * out, space);
    ASSERT_TRUE(answer.test.inside);
    EXPECT_LT((answer.scp.normal - answer.scp.point.normalized()).norm(), 0.01);
    EXPECT_NEAR(answer.scp.normal.norm(), 1.0, 1e-12);
  }
}

TEST(LoopRenderer, LeavesEarlyWhenTheParityChanges) {
  // Just below the face of a cube, which shrinks away from there with the first refinement.
  const LoopRenderer renderer(refined(box_mesh({0.1, 0.1, 0.1}), 5));
  LoopWorkspace space;
  const LoopRenderer::Test test = renderer.inside({0.045, 0.04, 0.049}, space);
  EXPECT_FALSE(test.inside);
  EXPECT_EQ(test.level, 1);
  EXPECT_EQ(test.crossings, 0u);
}

TEST(LoopRenderer, RaysThroughEdgesAndVerticesCountOnce) {
  const LoopRenderer renderer(refined(box_mesh({0.1, 0.1, 0.1}), 4));
  LoopWorkspace space;
  for (const double x : {-0.0125, 0.0, 0.0125, 0.00625}) {
    for (const double y : {-0.0125, 0.0, 0.0125}) {
      EXPECT_TRUE(renderer.inside({x, y, 0.0}, space).inside) << x << " " << y;
      EXPECT_FALSE(renderer.inside({x, y, -0.2}, space).inside) << x << " " << y;
      EXPECT_FALSE(renderer.inside({x, y, 0.2}, space).inside) << x << " " << y;
    }
  }
}

TEST(LoopRenderer, DoesNotDependOnSize) {
  const TriangleMesh mesh = torus(10, 5, 0.08, 0.03);
  const LoopRenderer one(refined(mesh, 3)), other(refined(scaled(mesh, 1024.0), 3));
  LoopWorkspace space;
  Random random(5);
  for (int i = 0; i < repeats(500); ++i) {
    const Vector3 p = random_point(random, mesh, one.levels().bounds(), i);
    const LoopRenderer::Answer a = one.render(p, space), b = other.render(1024.0 * p, space);
    EXPECT_EQ(a.test.inside, b.test.inside);
    EXPECT_EQ(a.checks, b.checks);
    EXPECT_LT((1024.0 * a.scp.point - b.scp.point).norm(), 1e-9);
  }
}

TEST(LoopRenderer, AdaptiveSubdivisionChecksFewerFacesOfAnUnevenMesh) {
  // A sphere with an upper half that is pressed flat: its triangles there are much smaller.
  TriangleMesh mesh = geometry::bumpy_geodesic_sphere(4, 0.05, 0.0, 8);
  for (Vector3& p : mesh.positions)
    if (p.z() > 0.0) p = {0.2 * p.x(), 0.2 * p.y(), 0.02 + 0.2 * p.z()};
  const LevelsPointer levels = refined(mesh, 3);
  const LoopRenderer uniform(levels), adaptive(levels, {.adaptive = true});
  const geometry::TriangleTree finest(levels->level(3).mesh);
  const double off = deviation(*levels);
  LoopWorkspace space;
  Random random(6);
  std::size_t uniform_checks = 0, adaptive_checks = 0;
  int differ = 0;
  for (int i = 0; i < repeats(1000); ++i) {
    const Vector3 p = random_point(random, levels->level(3).mesh, levels->bounds(), i);
    const LoopRenderer::Answer a = uniform.render(p, space), b = adaptive.render(p, space);
    uniform_checks += a.checks;
    adaptive_checks += b.checks;
    differ += finest.nearest(p)->parameter > off && a.test.inside != b.test.inside;
    if (b.test.inside) {
      EXPECT_LT(finest.nearest(b.scp.point)->parameter, off);
    }
  }
  EXPECT_LT(adaptive_checks, uniform_checks);
  EXPECT_LE(differ, 10 / kSanitizerShare);  // rays slip through cracks between levels
  std::printf("          adaptive: %zu of %zu checks\n", adaptive_checks, uniform_checks);
}

TEST(LoopRenderer, AnswersFromACoarserLevelWhenTooManyFacesMeet) {
  TriangleMesh mesh = fan(17'000, 0.05, 0.03);  // two cones, apex to apex around
  const std::uint32_t below = std::uint32_t(mesh.positions.size());
  mesh.positions.emplace_back(0.0, 0.0, -0.06);
  for (std::uint32_t i = 0; i < 17'000; ++i) mesh.triangles.push_back({below, 1 + (i + 1) % 17'000, 1 + i});
  const LoopRenderer renderer(refined(mesh, 1));
  LoopWorkspace space;
  const LoopRenderer::Answer answer = renderer.render({0.0001, 0.0002, -0.02}, space);
  EXPECT_TRUE(answer.test.inside);
  EXPECT_FALSE(answer.test.complete);
  EXPECT_EQ(answer.test.level, 0);
  EXPECT_LT(brute_nearest(mesh, answer.scp.point).distance, 1e-12);
}

TEST(ThesisLoopShape, RefusesAnOpenSurface) {
  const auto shape = ThesisLoopShape::create(refined(sheet_of_20(0.0), 1));
  ASSERT_FALSE(shape);
  EXPECT_NE(shape.error().message.find("open"), std::string::npos);
}

}  // namespace
}  // namespace icome::haptics
