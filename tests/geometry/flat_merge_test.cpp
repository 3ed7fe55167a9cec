#include "geometry/flat_merge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "closed_mesh.h"
#include "meshes.h"

namespace icome::geometry {
namespace {

/// A box of n x n squares a side, each of two triangles, and the side that each lies on.
struct GridBox {
  TriangleMesh mesh;
  std::vector<std::uint32_t> planes;
};

GridBox grid_box(int n) {
  GridBox box;
  std::vector<std::array<int, 3>> places;
  const auto vertex = [&](const std::array<int, 3>& place) {
    const auto number = std::uint32_t(std::find(places.begin(), places.end(), place) - places.begin());
    if (number == places.size()) places.push_back(place);
    return number;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const int end : {0, n}) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          std::array<std::uint32_t, 4> square;
          for (int k = 0; k < 4; ++k) {
            std::array<int, 3> place;
            place[std::size_t(axis)] = end;
            place[std::size_t((axis + 1) % 3)] = i + (k == 1 || k == 2 ? 1 : 0);
            place[std::size_t((axis + 2) % 3)] = j + (k >= 2 ? 1 : 0);
            square[std::size_t(k)] = vertex(place);
          }
          if (end == 0) std::swap(square[1], square[3]);
          box.mesh.triangles.push_back({square[0], square[1], square[2]});
          box.mesh.triangles.push_back({square[0], square[2], square[3]});
          box.planes.insert(box.planes.end(), 2, std::uint32_t(2 * axis + (end == 0 ? 0 : 1)));
        }
      }
    }
  }
  for (const auto& place : places) box.mesh.positions.emplace_back(place[0], place[1], place[2]);
  return box;
}

TEST(FlatMerge, BoxOfManyTrianglesBecomesTwelve) {
  const GridBox box = grid_box(7);
  ASSERT_TRUE(is_closed(box.mesh));
  const TriangleMesh merged = merge_flat_faces(box.mesh, box.planes, 1e-9);
  EXPECT_TRUE(is_closed(merged));
  EXPECT_EQ(merged.triangles.size(), 12u);
  EXPECT_EQ(merged.positions.size(), 8u);
  EXPECT_NEAR(volume(merged), 343.0, 1e-9);
}

TEST(FlatMerge, BentFacesStayAsTheyAre) {
  GridBox box = grid_box(4);
  for (std::uint32_t& plane : box.planes) {
    if (plane == 5) plane = kNoPlane;
  }
  const TriangleMesh merged = merge_flat_faces(box.mesh, box.planes, 1e-9);
  EXPECT_TRUE(is_closed(merged));
  EXPECT_NEAR(volume(merged), 64.0, 1e-9);
  // All 25 vertices of the bent side, and the four corners opposite.
  EXPECT_EQ(merged.positions.size(), 29u);
}

}  // namespace
}  // namespace icome::geometry
