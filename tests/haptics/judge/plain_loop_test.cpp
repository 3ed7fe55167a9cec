#include "haptics/judge/plain_loop.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "haptics/judge/contact_judge.h"
#include "haptics/loop_controls.h"
#include "repeats.h"

namespace icome::haptics {
namespace {

/// How far places of the exact surface are from the judge's mesh, at most.
double farthest_off(const ControlMesh& control, const TriangleMesh& mesh) {
  const auto surface = geometry::LoopSurface::create(control);
  EXPECT_TRUE(surface);
  const geometry::TriangleTree tree(mesh);
  base::Random random(5);
  double farthest = 0.0;
  for (int i = 0; i < repeats(20'000); ++i) {
    const double u = random.uniform(0.0, 1.0), v = random.uniform(0.0, 1.0 - u);
    const auto triangle = std::uint32_t(random.index(control.mesh.triangles.size()));
    farthest = std::max(farthest, tree.nearest((*surface)->sample(triangle, u, v).point)->parameter);
  }
  return farthest;
}

class JudgesLoops : public testing::TestWithParam<TouchedLoop> {};
INSTANTIATE_TEST_SUITE_P(All, JudgesLoops, testing::ValuesIn(touched_loops()),
                         [](const auto& it) { return it.param.name; });

TEST_P(JudgesLoops, ByAMeshWithinItsErrorOfTheLimit) {
  const auto plain = plain_loop(GetParam().control);
  ASSERT_TRUE(plain);
  EXPECT_LT(plain->error, 2e-4 * kLoopSize);
  EXPECT_LT(farthest_off(GetParam().control, plain->mesh), 1.01 * plain->error);
}

// Creases that end within the surface, three that meet in one vertex, and two fans that share one.
TEST(PlainLoop, KnowsDartsCornersAndPinches) {
  ControlMesh dart = icosahedron();
  const auto first = dart.mesh.triangles[0];
  dart.creases = {{first[0], first[1]}};
  ControlMesh star = dart;
  for (const auto& triangle : star.mesh.triangles) {
    for (int i = 0; i < 3; ++i)
      if (triangle[std::size_t(i)] == first[0])
        star.creases.push_back({first[0], triangle[std::size_t((i + 1) % 3)]});
  }
  ControlMesh pinch = bipyramid(4);
  const auto count = std::uint32_t(pinch.mesh.positions.size());
  for (std::uint32_t v = 0; v < count; ++v)
    pinch.mesh.positions.push_back(2.0 * pinch.mesh.positions[0] - pinch.mesh.positions[v]);
  for (auto triangle : TriangleMesh(pinch.mesh).triangles) {
    for (std::uint32_t& vertex : triangle) vertex = vertex == 0 ? 0 : vertex + count;
    pinch.mesh.triangles.push_back({triangle[0], triangle[2], triangle[1]});
  }
  for (const ControlMesh& control : {dart, star, pinch}) {
    const auto plain = plain_loop(control);
    ASSERT_TRUE(plain);
    EXPECT_LT(farthest_off(control, plain->mesh), 1.01 * plain->error);
  }
}

TEST(PlainLoop, RefusesEdgesOfThreeTriangles) {
  ControlMesh control = bipyramid(4);
  control.mesh.positions.emplace_back(1.0, 1.0, 1.0);
  const auto triangle = control.mesh.triangles[0];
  control.mesh.triangles.push_back(
      {triangle[0], triangle[1], std::uint32_t(control.mesh.positions.size() - 1)});
  EXPECT_FALSE(plain_loop(control));
}

/// What stands for a surface may rise above it by its error: who rests on the surface is neither inside nor
/// held in a hollow that is none.
TEST(ContactJudge, AllowsForTheErrorOfAMeshThatStandsForASurface) {
  const double error = 5e-6;
  const auto plane = std::make_shared<const TriangleMesh>(height_field(
      0.1, 50, [&](double x, double y) { return error * std::sin(900 * x) * std::cos(700 * y); }));
  JudgedObject object{plane};
  object.closed = false;
  object.error = error;
  for (const double radius : {0.0, 2e-3}) {
    ContactJudge judge({object}, {.tip_radius = radius});
    const Vector3 air(-0.02, 0.0, 0.01);
    judge.judge({air, air, false, -1e-3});
    for (int i = 0; i < 400; ++i) {
      const Vector3 scp(-0.02 + 1e-4 * i, 3e-5 * i, radius + 1e-7);
      judge.judge({scp - 2e-3 * Vector3::UnitZ(), scp, true, 1e-3 * i});
    }
    EXPECT_EQ(judge.pops(), 0U);
    EXPECT_EQ(judge.sticks(), 0U);
    // One that stays behind while the tip goes on along the plane sticks.
    const Vector3 held(0.0, 0.0, radius + 1e-7);
    judge.judge({held - 2e-3 * Vector3::UnitZ(), held, true, 0.45});
    EXPECT_TRUE(judge.judge({held + Vector3(5e-3, 0.0, -1e-3), held, true, 0.5}).stick);
  }
}

}  // namespace
}  // namespace icome::haptics
