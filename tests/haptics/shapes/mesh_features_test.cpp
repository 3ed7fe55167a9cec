// The edges and corners that a sphere tip is handed, against brute force: where is one the nearest place of
// the surface?
#include "haptics/shapes/mesh_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "geometry/mesh/geodesic_sphere.h"
#include "haptics/contact_world.h"

namespace icome::haptics {
namespace {

struct FeatureCount {
  int edges = 0;
  int corners = 0;

  void add(unsigned bits) {
    edges += std::popcount(bits & 7u);
    corners += std::popcount(bits >> 3);
  }
};

struct FeatureCounts {
  FeatureCount front, both;
};

FeatureCounts counts(const TriangleMesh& mesh) {
  FeatureCounts result;
  for (const MeshFeatures& features : mesh_features(mesh)) {
    result.front.add(features.front);
    result.both.add(features.both);
  }
  return result;
}

/// Is `place` the nearest of the mesh from `distance` off in this direction, outside the solid?
bool nearest_from(const TriangleMesh& mesh, const Vector3& place, const Vector3& direction, double distance) {
  const Vector3 from = place + distance * direction;
  return brute_nearest(mesh, from).distance >= (1.0 - 1e-9) * distance && brute_winding(mesh, from) < 0.5;
}

/// A direction at more than a right angle to all edges at the vertex, by a perceptron; zero where it finds
/// none.
Vector3 away_from_edges(const TriangleMesh& mesh, std::uint32_t vertex) {
  std::vector<Vector3> edges;
  for (const auto& triangle : mesh.triangles) {
    if (std::find(triangle.begin(), triangle.end(), vertex) == triangle.end()) continue;
    for (const std::uint32_t other : triangle) {
      if (other != vertex) edges.push_back((mesh.positions[other] - mesh.positions[vertex]).normalized());
    }
  }
  Vector3 direction = Vector3::Zero();
  for (int i = 0; i < 3000; ++i) {
    const auto worst = std::max_element(edges.begin(), edges.end(), [&](const Vector3& a, const Vector3& b) {
      return a.dot(direction) < b.dot(direction);
    });
    if (i > 0 && worst->dot(direction) < 0.0) return direction.normalized();
    direction -= *worst;
  }
  return Vector3::Zero();
}

TEST(MeshFeatures, ABoxHasTwelveEdgesAndEightCorners) {
  const FeatureCounts box = counts(box_mesh({0.1, 0.08, 0.06}));
  EXPECT_EQ(box.front.edges, 12);  // and none across its faces
  EXPECT_EQ(box.front.corners, 8);
  EXPECT_EQ(box.both.edges, 12);
  EXPECT_EQ(box.both.corners, 8);
}

TEST(MeshFeatures, AnInnerEdgeIsForTheInsideAlone) {
  const TriangleMesh angle = prism({{0, 0}, {.06, 0}, {.06, .02}, {.02, .02}, {.02, .06}, {0, .06}},
                                   {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}, 0.05);
  const FeatureCounts found = counts(angle);
  EXPECT_EQ(found.front.edges, 17);  // of 18
  EXPECT_EQ(found.front.corners, 10);
  EXPECT_EQ(found.both.edges, 18);
}

// Where a mesh passes through itself, a ball may come to the bottom of a crack from the other side.
TEST(MeshFeatures, TheBottomOfANarrowCrackIsAnEdgeOfBothSides) {
  for (const bool narrow : {false, true}) {
    const double half = narrow ? 0.002 : 0.03;
    const TriangleMesh block =
        prism({{-.05, -.02}, {.05, -.02}, {.05, .02}, {half, .02}, {0, -.01}, {-half, .02}, {-.05, .02}},
              {{0, 1, 4}, {1, 2, 3}, {1, 3, 4}, {0, 4, 5}, {0, 5, 6}}, 0.1);
    EXPECT_EQ(counts(block).front.edges, narrow ? 21 : 20);
  }
}

TEST(MeshFeatures, AFlatSheetHasItsRimAlone) {
  const FeatureCounts sheet = counts(height_field(0.1, 8, [](double, double) { return 0.0; }));
  EXPECT_EQ(sheet.both.edges, 32);
  EXPECT_EQ(sheet.both.corners, 4);
}

TEST(MeshFeatures, ASmoothBallHasAllAndAHollowNone) {
  TriangleMesh ball = geometry::bumpy_geodesic_sphere(6, 0.05, 0.0, 0);
  const auto edges = int(3 * ball.triangles.size() / 2);
  EXPECT_EQ(counts(ball).front.edges, edges);
  EXPECT_EQ(counts(ball).front.corners, int(ball.positions.size()));
  for (auto& triangle : ball.triangles) std::swap(triangle[1], triangle[2]);
  EXPECT_EQ(counts(ball).front.edges, 0);
  EXPECT_EQ(counts(ball).front.corners, 0);
  EXPECT_EQ(counts(ball).both.edges, edges);
}

// The end of a horn, as modellers make them: two of its edges lead away and three lie nearly across, two of
// its triangles pass through each other, so that it is a corner on both sides.
TEST(MeshFeatures, AnApexIsFoundThoughSomeEdgesLieNearlyAcross) {
  TriangleMesh horn;
  horn.positions = {{0, 0, 0},           {-0.39, -0.90, -0.03}, {0.17, -0.44, -1.41},
                    {1.03, 0.30, -0.15}, {2.12, 3.10, -0.40},   {0.92, 1.70, -0.41}};
  horn.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}};
  const Vector3 out = away_from_edges(horn, 0);
  ASSERT_FALSE(out.isZero(0.0));
  for (const bool turned : {false, true}) {
    if (turned) {
      for (auto& triangle : horn.triangles) std::swap(triangle[1], triangle[2]);
    }
    const MeshFeatures first = mesh_features(horn).front();
    EXPECT_EQ(first.front >> 3 & 1, 1) << turned;
    EXPECT_EQ(first.both >> 3 & 1, 1) << turned;
  }
}

// The end of a thin flap that is twisted in itself, as scans have them: some of its triangles face the other
// way.
TEST(MeshFeatures, TheEndOfATwistedFlapIsACornerOfBothSides) {
  TriangleMesh flap;
  flap.positions = {
      {0, 0, 0}, {-0.17, -0.22, -1.0}, {-1.66, 0.23, -1.0}, {-0.13, -0.20, -1.0}, {0.13, 0.20, -1.0}};
  flap.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  ASSERT_FALSE(away_from_edges(flap, 0).isZero(0.0));
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_EQ(mesh_features(flap).front().front >> 3 & 1, 1) << turn;
    for (auto& triangle : flap.triangles) std::swap(triangle[1], triangle[2]);
  }
}

// On rough balls: whatever is nearest to some position is handed out, once; what is handed out is the nearest
// to some position, but for a few corners whose directions are too narrow for the search.
TEST(MeshFeatures, AreThoseThatAreNearestSomewhere) {
  Random random(11);
  int corners = 0, unused = 0;
  unsigned edges = 0, convex_sides = 0;
  for (int shape = 0; shape < repeats(20); ++shape) {
    TriangleMesh mesh = geometry::bumpy_geodesic_sphere(4, 0.05, 0.0, 0);
    const double rough = shape % 2 == 0 ? 0.1 : 0.6;
    for (Vector3& p : mesh.positions) p *= random.uniform(1.0 - rough, 1.0 + rough);
    const std::vector<MeshFeatures> features = mesh_features(mesh);
    std::vector<int> handed_out(mesh.positions.size(), 0);
    const double near = 1e-5;
    for (std::size_t i = 0; i < features.size(); ++i) {
      for (unsigned which = 0; which < 3; ++which) {
        if (features[i].front >> (3 + which) & 1) ++handed_out[mesh.triangles[i][which]];
        const Vector3 middle = 0.5 * (mesh.corner(i, int(which)) + mesh.corner(i, int(which + 1) % 3));
        const Vector3 normal = face_normal(mesh, i);
        const Vector3 along = (mesh.corner(i, int(which + 1) % 3) - mesh.corner(i, int(which))).normalized();
        // Outwards, and a little over the edge: over a convex one still nearest to it.
        const Vector3 over = (normal + 1e-4 * along.cross(normal)).normalized();
        const bool convex = nearest_from(mesh, middle, over, near);
        convex_sides += convex ? 1 : 0;
        edges += features[i].front >> which & 1;
        EXPECT_TRUE(convex || (features[i].front >> which & 1) == 0) << i << " " << which;
      }
    }
    for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
      const Vector3 direction = away_from_edges(mesh, vertex);
      const bool nearest =
          !direction.isZero(0.0) && nearest_from(mesh, mesh.positions[vertex], direction, near);
      EXPECT_LE(handed_out[vertex], 1) << vertex;
      EXPECT_TRUE(!nearest || handed_out[vertex] == 1) << vertex;
      corners += handed_out[vertex];
      unused += handed_out[vertex] != 0 && !nearest ? 1 : 0;
    }
  }
  EXPECT_EQ(convex_sides, 2 * edges);
  EXPECT_GT(corners, 50);
  EXPECT_LE(unused, corners / 20);
}

}  // namespace
}  // namespace icome::haptics
