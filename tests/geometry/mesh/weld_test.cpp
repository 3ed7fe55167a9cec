#include "geometry/mesh/weld.h"

#include <gtest/gtest.h>

#include <limits>

#include "geometry/meshes.h"

namespace icome::geometry {
namespace {

TEST(Weld, EqualPositionsBecomeTheFirst) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  mesh.triangles = {{0, 3, 2}};
  EXPECT_EQ(weld_equal(mesh), 1U);
  EXPECT_EQ(mesh.triangles[0], (TriangleMesh::Triangle{0, 1, 2}));
}

TEST(Weld, NonFinitePositionsEqualNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TriangleMesh mesh{{{nan, 0, 0}, {nan, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(weld_equal(mesh), 0U);
}

TEST(Weld, InnerVerticesAreNeverMovedByCrackWelding) {
  // Closed: there is no crack, however near its vertices are to each other.
  TriangleMesh mesh = together(unit_box(), box_mesh({5, 5, 5}, {5 + 1e-9, 5 + 1e-9, 5 + 1e-9}));
  EXPECT_EQ(weld_cracks(mesh), 0U);
}

TEST(Weld, CracksCloseAcrossCellsOfTheGrid) {
  // A row of pairs at every place in a cell: each pair must meet.
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 64; ++i) {
    const double x = i / 64.0 + i * 1e-8;
    for (const double shift : {0.0, 5e-8}) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(), {{x + shift, 0, 0}, {x, 1, shift}, {x, 0.5, 1 + shift}});
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
  }
  EXPECT_EQ(weld_cracks(mesh), 3U * 64U);
}

}  // namespace
}  // namespace icome::geometry
