#include "haptics/judge/witness_ways.h"

#include <gtest/gtest.h>

#include "haptics/contact_world.h"

namespace icome::haptics {
namespace {

TEST(WitnessWays, ProveNothingWhereStepsAreUsedUp) {
  const MeshPointer mesh = shared(height_field(0.1, 8, [](double, double) { return 0.0; }));
  const WitnessTree tree(mesh);
  const WitnessWays ways(tree, *mesh, true);
  const Vector3 above(1e-3, 5e-4, 0.006), below(1e-3, 5e-4, -0.004);
  int enough = 1000, few = 2;  // it takes three triangles at least
  EXPECT_TRUE(ways.apart(above, below, below, enough));
  EXPECT_LT(enough, 998);
  EXPECT_GT(enough, 0);
  EXPECT_FALSE(ways.apart(above, below, below, few));
  EXPECT_EQ(few, 0);
}

TEST(WitnessWays, LeadThroughNoWallBesideASharpCrease) {
  // A slit of a hundredth of a radian to either side: beside the crease, what is off one wall by some noise
  // is behind the other.
  const double half = 1e-4, high = 0.01, wide = 0.005;
  TriangleMesh slit;
  slit.positions = {{0, -wide, 0},       {0, wide, 0},        {-half, -wide, high},
                    {-half, wide, high}, {half, -wide, high}, {half, wide, high}};
  slit.triangles = {{0, 1, 3}, {0, 3, 2}, {1, 0, 4}, {1, 4, 5}};  // they face each other
  const MeshPointer mesh = shared(slit);
  const WitnessTree tree(mesh);
  const WitnessWays ways(tree, *mesh, false);
  const Vector3 within(-0.5 * half + 2e-6, 0.0, 0.5 * high), beyond(0.002, 0.0, 0.0), tip(0.003, 0.0, 0.0);
  int steps = 100'000;
  EXPECT_EQ(ways.leads(within, beyond, tip, 1e-6, steps), WaySearch::None);
  EXPECT_GT(steps, 0);
}

// Who falls from the plate's edge straight to the tip is caught by a trough; who glides on over it, as far as
// the tip is, falls beside it.
TEST(WitnessWays, LeadOnThroughTheAirAsAPointGlidesOverAnEdge) {
  TriangleMesh both =
      prism({{-0.05, -1e-5}, {0.0, -1e-5}, {0.0, 0.0}, {-0.05, 0.0}}, {{0, 1, 2}, {0, 2, 3}}, 0.004);
  const TriangleMesh trough = prism({{0.003, -0.011},
                                     {0.013, -0.011},
                                     {0.013, -0.003},
                                     {0.012, -0.003},
                                     {0.012, -0.010},
                                     {0.004, -0.010},
                                     {0.004, -0.007},
                                     {0.003, -0.007}},
                                    {{1, 2, 3}, {1, 3, 4}, {0, 1, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 7}}, 0.04);
  const auto shift = std::uint32_t(both.positions.size());
  both.positions.insert(both.positions.end(), trough.positions.begin(), trough.positions.end());
  for (const auto& [a, b, c] : trough.triangles) both.triangles.push_back({a + shift, b + shift, c + shift});
  const MeshPointer mesh = shared(both);
  const WitnessTree tree(mesh);
  const WitnessWays ways(tree, *mesh, false);
  const Vector3 on_plate(-1e-4, 1e-9, 0.0), beside(0.02, -0.03, 0.0), within(0.008, -0.0105, 0.0);
  int steps = 100'000;
  EXPECT_EQ(ways.leads(on_plate, beside, beside, 1e-8, steps), WaySearch::Found);
  EXPECT_EQ(ways.leads(on_plate, within, within, 1e-8, steps), WaySearch::None);
  EXPECT_GT(steps, 0);
}

}  // namespace
}  // namespace icome::haptics
