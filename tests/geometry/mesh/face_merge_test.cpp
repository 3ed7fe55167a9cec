#include "geometry/mesh/face_merge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "geometry/closed_mesh.h"
#include "geometry/meshes.h"

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

bool all_fit(std::uint32_t /*face*/, const std::array<Vector3, 3>& /*corners*/) { return true; }

std::vector<bool> none_pinned(const TriangleMesh& mesh) {
  return std::vector<bool>(mesh.positions.size(), false);
}

TriangleMesh merged_faces(const GridBox& box, const std::vector<bool>& pinned, const FaceFit& fits) {
  const auto merged = merge_faces(box.mesh, box.planes, pinned, 1e-9, fits, [](double) { return true; });
  EXPECT_TRUE(merged.has_value());
  return merged.value_or(TriangleMesh());
}

TEST(FaceMerge, BoxOfManyTrianglesBecomesTwelve) {
  const GridBox box = grid_box(7);
  ASSERT_TRUE(is_closed(box.mesh));
  const TriangleMesh merged = merged_faces(box, none_pinned(box.mesh), all_fit);
  EXPECT_TRUE(is_closed(merged));
  EXPECT_EQ(merged.triangles.size(), 12u);
  EXPECT_EQ(merged.positions.size(), 8u);
  EXPECT_NEAR(volume(merged), 343.0, 1e-9);
}

TEST(FaceMerge, TrianglesOfNoFaceStayAsTheyAre) {
  GridBox box = grid_box(4);
  for (std::uint32_t& plane : box.planes) {
    if (plane == 5) plane = kNoFace;
  }
  const TriangleMesh merged = merged_faces(box, none_pinned(box.mesh), all_fit);
  EXPECT_TRUE(is_closed(merged));
  EXPECT_NEAR(volume(merged), 64.0, 1e-9);
  // All 25 vertices of that side, and the four corners opposite.
  EXPECT_EQ(merged.positions.size(), 29u);
}

TEST(FaceMerge, PinnedVerticesStay) {
  const GridBox box = grid_box(4);
  std::vector<bool> pinned = none_pinned(box.mesh);
  for (std::size_t i = 0; i < pinned.size(); ++i) pinned[i] = box.mesh.positions[i] == Vector3(4, 2, 2);
  const TriangleMesh merged = merged_faces(box, pinned, all_fit);
  EXPECT_TRUE(is_closed(merged));
  EXPECT_EQ(merged.positions.size(), 9u);
}

TEST(FaceMerge, FacesKeepVerticesThatTheyNeed) {
  // One side may not have triangles that reach over more than two squares.
  const GridBox box = grid_box(8);
  const auto fits = [](std::uint32_t face, const std::array<Vector3, 3>& corners) {
    if (face != 5) return true;
    Bounds around;
    for (const Vector3& corner : corners) around.extend(corner);
    return around.sizes().maxCoeff() <= 2.0;
  };
  const TriangleMesh merged = merged_faces(box, none_pinned(box.mesh), fits);
  EXPECT_TRUE(is_closed(merged));
  EXPECT_NEAR(volume(merged), 512.0, 1e-9);
  std::size_t on_side = 0;
  for (const Vector3& position : merged.positions) on_side += position.z() == 8.0 ? 1 : 0;
  EXPECT_GE(on_side, 25u);
  EXPECT_LT(on_side, 81u);
  EXPECT_EQ(merged.positions.size(), on_side + 4);
}

TEST(FaceMerge, StopsWhereItIsToldTo) {
  const GridBox box = grid_box(27);
  ASSERT_GT(box.mesh.positions.size(), 4096u);  // so that it asks once more in the first round
  std::vector<double> parts;
  const auto go_on = [&](double part) {
    parts.push_back(part);
    return part == 0.0;
  };
  const auto merged = merge_faces(box.mesh, box.planes, none_pinned(box.mesh), 1e-9, all_fit, go_on);
  ASSERT_FALSE(merged.has_value());
  EXPECT_NE(merged.error().message.find("interrupted"), std::string::npos) << merged.error().message;
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_GT(parts[1], 0.4);
  EXPECT_LT(parts[1], 0.5);
}

}  // namespace
}  // namespace icome::geometry
