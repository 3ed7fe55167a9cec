#include "geometry/tree/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/random.h"
#include "geometry/mesh/geodesic_sphere.h"
#include "repeats.h"

namespace icome::geometry {
namespace {

using base::Random;

TriangleMesh soup(std::size_t triangles, double size, std::uint64_t seed) {
  Random random(seed);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const Vector3 centre = random.uniform(0.0, 1.0) * random.direction();
    for (int corner = 0; corner < 3; ++corner) mesh.positions.push_back(centre + size * random.direction());
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

double brute_distance(const TriangleMesh& mesh, const Vector3& point) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Corners corners{mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)};
    best = std::min(best, (nearest_point(corners, point) - point).norm());
  }
  return best;
}

// Least distance between a triangle and a segment, by sampling the segment finely.
double sampled_distance(const Corners& corners, const Vector3& a, const Vector3& b) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 200; ++i) {
    const Vector3 point = a + (i / 200.0) * (b - a);
    best = std::min(best, (nearest_point(corners, point) - point).norm());
  }
  return best;
}

TEST(NearestPoint, FacesEdgesAndCornersOfATriangle) {
  const Corners corners{Vector3(0, 0, 0), Vector3(2, 0, 0), Vector3(0, 2, 0)};
  EXPECT_EQ(nearest_point(corners, Vector3(0.5, 0.5, 3)), Vector3(0.5, 0.5, 0));
  EXPECT_EQ(nearest_point(corners, Vector3(1, -1, 1)), Vector3(1, 0, 0));
  EXPECT_EQ(nearest_point(corners, Vector3(2, 2, 0)), Vector3(1, 1, 0));
  EXPECT_EQ(nearest_point(corners, Vector3(-1, -1, 5)), Vector3(0, 0, 0));
  EXPECT_EQ(nearest_point(corners, Vector3(5, -1, 0)), Vector3(2, 0, 0));
}

TEST(TriangleTree, NearestAgreesWithBruteForceAtEveryScale) {
  for (const double scale : {1e-3, 1.0, 1e4}) {
    TriangleMesh mesh = soup(500, 0.1, 1);
    for (Vector3& position : mesh.positions) position *= scale;
    const TriangleTree tree(mesh);
    Random random(2);
    for (int i = 0; i < 300; ++i) {
      const Vector3 point = scale * random.uniform(0.0, 2.0) * random.direction();
      const auto hit = tree.nearest(point);
      ASSERT_TRUE(hit);
      EXPECT_NEAR(hit->parameter, brute_distance(mesh, point), 1e-12 * scale);
      EXPECT_NEAR((hit->point - point).norm(), hit->parameter, 1e-12 * scale);
    }
  }
}

TEST(TriangleTree, NearestKeepsToItsLimit) {
  const TriangleTree tree(soup(100, 0.1, 3));
  EXPECT_FALSE(tree.nearest(Vector3(10, 0, 0), 1.0));
  EXPECT_TRUE(tree.nearest(Vector3(10, 0, 0), 20.0));
}

TEST(TriangleTree, NearVisitsEveryTriangleInReachAndStopsWhenTold) {
  const TriangleMesh mesh = soup(1000, 0.05, 4);
  const TriangleTree tree(mesh);
  Random random(5);
  for (int i = 0; i < std::max(5, repeats(50)); ++i) {
    const Vector3 a = random.direction();
    const Vector3 b = a + random.uniform(0.0, 1.5) * random.direction();
    const double radius = random.uniform(0.0, 0.1);
    for (const bool round : {false, true}) {
      std::set<std::uint32_t> seen;
      tree.near(SegmentQuery(a, b, radius, round),
                [&](std::uint32_t slot) { return seen.insert(slot).second; });
      for (std::uint32_t slot = 0; slot < tree.size(); ++slot) {
        if (sampled_distance(tree.corners(slot), a, b) <= radius) {
          EXPECT_TRUE(seen.count(slot)) << slot;
        }
      }
    }
  }
  int visits = 0;
  tree.near(Vector3::Zero(), Vector3::Zero(), 10.0, [&](std::uint32_t) { return ++visits < 7; });
  EXPECT_EQ(visits, 7);
}

/// The first of 201 places along a way at which a triangle is within `radius` of it, as a share of the way; 2
/// where there is none.
double sampled_entry(const Corners& corners, const Vector3& start, const Vector3& step, double radius) {
  for (int i = 0; i <= 200; ++i) {
    const Vector3 point = start + (i / 200.0) * step;
    if ((nearest_point(corners, point) - point).norm() <= radius) return i / 200.0;
  }
  return 2.0;
}

// Far from the origin, too, where single precision has few digits left, and on ways of any length.
TEST(TriangleTree, ASweepVisitsEveryTriangleOnItsWayAndFindsTheFirst) {
  Random random(9);
  for (const double offset : {0.0, 100.0}) {
    TriangleMesh mesh = soup(300, 0.15, 4);
    for (Vector3& position : mesh.positions) position.x() += offset;
    const TriangleTree tree(mesh);
    for (int i = 0; i < repeats(100); ++i) {
      const Vector3 start = Vector3(offset, 0.0, 0.0) + random.uniform(0.0, 1.5) * random.direction();
      const Vector3 step = i % 10 == 0
                               ? Vector3(Vector3::Zero())
                               : Vector3(std::pow(10.0, random.uniform(-4.0, 0.5)) * random.direction());
      const double radius = random.uniform(0.01, 0.4);
      std::set<std::uint32_t> seen;
      tree.sweep(start, step, radius, [&](std::uint32_t slot) {
        seen.insert(slot);
        return 1.0;
      });
      double first = 2.0;
      for (std::uint32_t slot = 0; slot < tree.size(); ++slot) {
        const double entry = sampled_entry(tree.corners(slot), start, step, radius);
        first = std::min(first, entry);
        if (entry <= 1.0) {
          EXPECT_TRUE(seen.count(slot)) << slot;
        }
      }
      double share = 2.0;
      tree.sweep(start, step, radius, [&](std::uint32_t slot) {
        share = std::min(share, sampled_entry(tree.corners(slot), start, step, radius));
        return std::min(1.0, share);
      });
      EXPECT_EQ(share, first) << i;
    }
  }
}

// A way that is stopped at once looks at little of a large mesh.
TEST(TriangleTree, ASweepThatIsStoppedSoonVisitsFewTriangles) {
  const TriangleTree tree(bumpy_geodesic_sphere(100, 1.0, 0.0, 0));
  const Vector3 start(0.0, 0.0, 1.0501);
  const Vector3 step(0.3, 0.0, -0.3);
  const double radius = 0.05;
  int visits = 0;
  double share = 1.0;
  tree.sweep(start, step, radius, [&](std::uint32_t slot) {
    ++visits;
    return share = std::min(share, sampled_entry(tree.corners(slot), start, step, radius));
  });
  EXPECT_LT(share, 0.01);
  EXPECT_LT(visits, 200);
}

// A ball inside a shell meets the box around it, but not the shell.
TEST(TriangleTree, ARoundQueryLeavesOutTheCornersOfItsBox) {
  const TriangleTree shell(bumpy_geodesic_sphere(40, 1.0, 0.0, 0));
  int boxed = 0, round = 0;
  const auto count_in = [](int& count) { return [&count](std::uint32_t) { return ++count > 0; }; };
  shell.near(Vector3::Zero(), Vector3::Zero(), 0.9, count_in(boxed));
  shell.near(SegmentQuery(Vector3::Zero(), Vector3::Zero(), 0.9, true), count_in(round));
  EXPECT_GT(boxed, 10'000);
  EXPECT_LT(20 * round, boxed);  // some boxes hold triangles that lie apart
}

TEST(TriangleTree, FirstHitIsTheFirstAndWatertightAlongEdges) {
  const TriangleMesh mesh = bumpy_geodesic_sphere(12, 1.0, 0.05, 5);
  const TriangleTree tree(mesh);
  Random random(6);
  // Through shared vertices and edges, where a ray is most easily lost.
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const double share = random.uniform(0.0, 1.0);
    const Vector3 target = share * mesh.corner(i, 0) + (1.0 - share) * mesh.corner(i, 1);
    for (const Vector3& aim : {target, mesh.corner(i, 2)}) {
      const auto hit = tree.first_hit(3.0 * aim, -3.0 * aim);
      ASSERT_TRUE(hit) << i;
      EXPECT_LE((hit->point - aim).norm(), 1e-9) << i;
    }
  }
  EXPECT_FALSE(tree.first_hit(Vector3(2, 2, 2), Vector3(3, 2, 2)));
}

TEST(TriangleTree, EnclosesTheInsideAlsoWherePartsOverlap) {
  TriangleMesh mesh = bumpy_geodesic_sphere(8, 1.0, 0.0, 1);
  const std::size_t vertices = mesh.positions.size();
  const std::size_t triangles = mesh.triangles.size();
  for (std::size_t i = 0; i < vertices; ++i) mesh.positions.push_back(mesh.positions[i] + Vector3(0.5, 0, 0));
  for (std::size_t i = 0; i < triangles; ++i) {
    TriangleMesh::Triangle moved = mesh.triangles[i];
    for (std::uint32_t& vertex : moved) vertex += std::uint32_t(vertices);
    mesh.triangles.push_back(moved);
  }
  const TriangleTree tree(mesh);
  EXPECT_TRUE(tree.encloses(Vector3(-0.7, 0, 0)));   // in one
  EXPECT_TRUE(tree.encloses(Vector3(0.25, 0, 0)));   // in both
  EXPECT_FALSE(tree.encloses(Vector3(0.25, 1, 0)));  // beside both
}

TEST(TriangleTree, RefitFollowsMovedVertices) {
  TriangleMesh mesh = soup(400, 0.1, 7);
  TriangleTree tree(mesh);
  for (Vector3& position : mesh.positions)
    position = Vector3(position.y(), 3.0 + position.z(), -position.x());
  const TriangleTree other(tree, mesh);
  tree.refit(mesh);
  Random random(8);
  for (int i = 0; i < 100; ++i) {
    const Vector3 point = Vector3(0, 3, 0) + random.direction();
    EXPECT_NEAR(tree.nearest(point)->parameter, brute_distance(mesh, point), 1e-12);
    EXPECT_EQ(other.nearest(point)->parameter, tree.nearest(point)->parameter);
  }
  EXPECT_TRUE(tree.bounds().contains(mesh.positions[5]));
  EXPECT_EQ(other.bounds().max(), tree.bounds().max());
}

TEST(TriangleTree, HoldsEveryTriangleOnceInAtMostAHundredBytesEach) {
  const TriangleMesh mesh = bumpy_geodesic_sphere(40, 1.0, 0.05, 5);
  const TriangleTree tree(mesh);
  std::set<std::uint32_t> triangles;
  for (std::uint32_t slot = 0; slot < tree.size(); ++slot) triangles.insert(tree.triangle(slot));
  EXPECT_EQ(triangles.size(), mesh.triangles.size());
  EXPECT_LE(double(tree.bytes()) / double(tree.size()), 100.0);
}

TEST(TriangleTree, AMeshWithoutTrianglesAnswersNothing) {
  const TriangleTree tree{TriangleMesh{}};
  EXPECT_FALSE(tree.nearest(Vector3::Zero()));
  EXPECT_FALSE(tree.first_hit(Vector3::Zero(), Vector3::Ones()));
  EXPECT_FALSE(tree.encloses(Vector3::Zero()));
}

// A way of nanometres across a face of decimetres: single precision knows the way, but not the face's middle.
TEST(FourBoxes, AreMetByWaysMuchShorterThanTheyAre) {
  Random random(17);
  for (int i = 0; i < 20'000; ++i) {
    const Vector3 on_box = std::pow(10.0, random.uniform(-9.0, -2.0)) * random.direction();
    base::Bounds bounds(on_box);
    for (int k = 0; k < 2; ++k) bounds.extend(on_box + random.uniform(0.01, 0.2) * random.direction());
    FourBoxes boxes;
    boxes.set(0, float_box(bounds));
    const Vector3 way = std::pow(10.0, random.uniform(-10.0, -3.0)) * random.direction();
    const SegmentQuery query(on_box - random.uniform() * way, on_box + random.uniform() * way, 1e-11);
    ASSERT_EQ(boxes.near_mask(query) & 1u, 1u) << i;
  }
}

/// The farthest way there is meets what is in it, and nothing where a node has fewer than four boxes.
TEST(FourBoxes, ThatAreEmptyAreNotMetByWaysAcrossEverything) {
  for (const double farthest : {1e30, 1e38, 1e39, 1e60, 1e200, 1e308}) {
    for (const Vector3& direction :
         {Vector3(1.0, 0.0, 0.0), Vector3(0.0, -1.0, 0.0), Vector3(1.0, -1.0, 1.0)}) {
      FourBoxes boxes;
      boxes.set(0, float_box(base::Bounds(Vector3::Constant(-0.1), Vector3::Constant(0.1))));
      const SegmentQuery across(farthest * direction, -farthest * direction, 0.001);
      EXPECT_EQ(boxes.near_mask(across), 1u) << farthest;
      const SegmentQuery beyond(farthest * direction, farthest * direction, 0.001);
      EXPECT_EQ(boxes.near_mask(beyond), 0u) << farthest;
    }
  }
}

}  // namespace
}  // namespace icome::geometry
