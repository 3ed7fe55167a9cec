#include "geometry/loop/loop_topology.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace icome::geometry {
namespace {

// Triangles thrown together share edges by twos, threes and fours, so that cutting one pair of them otherwise
// takes away sides of another.
TEST(LoopTopology, AnyHeapOfTrianglesIsASurfaceOrRefused) {
  base::Random random(77);
  int surfaces = 0;
  for (int run = 0; run < 20000; ++run) {
    ControlMesh control;
    const std::size_t vertices = 4 + random.index(4);
    for (std::size_t i = 0; i < vertices; ++i) control.mesh.positions.push_back(random.direction());
    for (std::size_t i = 4 + random.index(8); i > 0; --i) {
      const auto a = std::uint32_t(random.index(vertices));
      const auto b = std::uint32_t((a + 1 + random.index(vertices - 1)) % vertices);
      auto c = std::uint32_t(random.index(vertices));
      while (c == a || c == b) c = (c + 1) % std::uint32_t(vertices);
      control.mesh.triangles.push_back({a, b, c});
    }
    const auto topology = loop_topology(control);
    if (!topology) {
      EXPECT_FALSE(topology.error().message.empty());
      continue;
    }
    ++surfaces;
    for (std::size_t t = 0; t < topology->across.size(); ++t) {
      for (std::uint32_t side = 0; side < 3; ++side) {
        const std::uint32_t other = topology->across[t][side];
        if (other == LoopTopology::kNone) continue;
        ASSERT_EQ(topology->across[other / 3][other % 3], 3 * t + side);
      }
    }
  }
  EXPECT_GT(surfaces, 0);
}

}  // namespace
}  // namespace icome::geometry
