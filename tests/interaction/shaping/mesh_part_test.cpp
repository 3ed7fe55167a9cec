#include "interaction/shaping/mesh_part.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "interaction/shaping/shaping_samples.h"
#include "repeats.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::Vector3;
using geometry::TriangleMesh;

PartFinder finder_for(const TriangleMesh& mesh) {
  auto made = PartFinder::create(std::make_shared<world::MeshGeometry>(mesh));
  if (!made) throw std::runtime_error(made.error().message);
  return std::move(*made);
}

/// Sheets in random places, bent at random.
TriangleMesh crumpled(base::Random& random) {
  TriangleMesh mesh = sheet_of(12);
  for (Vector3& position : mesh.positions) position += 0.1 * random.uniform() * random.direction();
  return mesh;
}

/// The smallest distance of the probe's line from a stretch, by trying 100 places on it and 100 between the
/// neighbours of the best of them.
double distance_by_trying(const PartProbe& probe, const Vector3& from, const Vector3& to) {
  // |point - probe.from - t * along|^2 for points from + u * way, in numbers alone: tests are not optimised.
  const Vector3 start = from - probe.from, way = to - from;
  const double start_along = start.dot(probe.along), way_along = way.dot(probe.along);
  const double start_square = start.squaredNorm(), cross = 2.0 * start.dot(way),
               way_square = way.squaredNorm();
  double best = std::numeric_limits<double>::infinity();
  double nearest = 0.5;
  double reach = 0.5;  // to both sides of `nearest`
  for (int look = 0; look < 2; ++look) {
    const double first = nearest - reach;
    for (int i = 0; i <= 100; ++i) {
      const double u = std::clamp(first + i / 50.0 * reach, 0.0, 1.0);
      const double t = std::max(0.0, start_along + u * way_along);
      const double square = start_square + u * (cross + u * way_square) - t * t;
      const double distance = std::sqrt(std::max(0.0, square)) / probe.radius_at(t);
      if (distance >= best) continue;
      best = distance;
      nearest = u;
    }
    reach = 0.01;
  }
  return best;
}

TEST(MeshPart, TheVertexNextToALineIsFound) {
  base::Random random(1);
  int found = 0;
  for (int round = 0; round < 200; ++round) {
    const TriangleMesh mesh = crumpled(random);
    const Affine3 place = askew(random.uniform(0.5, 2.0));
    const Vector3 eye = 4.0 * random.direction();
    const Vector3 towards = place * Vector3(random.uniform(), random.uniform(), 0.0) - eye;
    const PartProbe probe = probe_along({eye, towards.normalized()}, 0.02);
    double best = 1.0;
    std::optional<std::uint32_t> nearest;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
      const Vector3 there = place * mesh.positions[v] - eye;
      const double t = there.dot(probe.along);
      const double off = (there - t * probe.along).norm() / (0.02 * t);
      if (!(t > 0.0) || off > best) continue;
      best = off;
      nearest = v;
    }
    const auto part = finder_for(mesh).find(PartKind::Vertex, place, probe);
    ASSERT_EQ(part.has_value(), nearest.has_value());
    if (!part) continue;
    ++found;
    EXPECT_EQ(part->vertices, std::vector{*nearest});
    EXPECT_NEAR(part->meeting.cost, best, 1e-9);
    EXPECT_LT((part->place - place * mesh.positions[*nearest]).norm(), 1e-12);
  }
  EXPECT_GT(found, 20);
}

TEST(MeshPart, TheEdgeNextToALineOrATipIsFound) {
  base::Random random(2);
  for (int round = 0; round < repeats(60); ++round) {
    const TriangleMesh mesh = crumpled(random);
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& triangle : mesh.triangles) {
      for (int i = 0; i < 3; ++i) edges.insert(std::minmax({triangle[i], triangle[(i + 1) % 3]}));
    }
    const Affine3 place = askew(random.uniform(0.5, 2.0));
    const Vector3 target = place * Vector3(random.uniform(), random.uniform(), 0.0);
    const Vector3 eye = 4.0 * random.direction();
    const PartProbe line = probe_along({eye, (target - eye).normalized()}, 0.2);
    const PartProbe tip = probe_round(target + 0.01 * random.direction(), 0.5);
    for (const PartProbe& probe : {line, tip}) {
      double best = std::numeric_limits<double>::infinity();
      for (const auto& [a, b] : edges) {
        best =
            std::min(best, distance_by_trying(probe, place * mesh.positions[a], place * mesh.positions[b]));
      }
      const auto part = finder_for(mesh).find(PartKind::Edge, place, probe);
      ASSERT_TRUE(part);
      ASSERT_EQ(part->vertices.size(), 2u);
      const Vector3 from = place * mesh.positions[part->vertices[0]];
      const Vector3 to = place * mesh.positions[part->vertices[1]];
      EXPECT_NEAR(distance_by_trying(probe, from, to), best, 2e-3);
      EXPECT_NEAR(part->meeting.cost, best, 2e-3);
    }
  }
}

TEST(MeshPart, TheFaceThatALineGoesThroughIsFoundAndTheFrontOneOfTwo) {
  TriangleMesh mesh = sheet_of(4);
  const auto size = std::uint32_t(mesh.positions.size());
  const TriangleMesh behind = mesh;
  for (const Vector3& position : behind.positions)
    mesh.positions.emplace_back(position - Vector3(0, 0, 0.001));
  for (const auto& [a, b, c] : behind.triangles) mesh.triangles.push_back({a + size, b + size, c + size});
  const PartFinder finder = finder_for(mesh);
  base::Random random(3);
  for (int round = 0; round < 100; ++round) {
    const double x = random.uniform(), y = random.uniform();
    const Vector3 eye(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 3.0);
    const PartProbe probe = probe_along({eye, (Vector3(x, y, 0.0) - eye).normalized()}, 0.01);
    const auto part = finder.find(PartKind::Face, Affine3::Identity(), probe);
    ASSERT_TRUE(part);
    EXPECT_EQ(part->meeting.cost, 0.0);
    EXPECT_LT((part->place - Vector3(x, y, 0.0)).norm(), 1e-9);
    Vector3 middle = Vector3::Zero();
    for (const std::uint32_t v : part->vertices) {
      EXPECT_LT(v, size);
      middle += mesh.positions[v] / 3.0;
    }
    EXPECT_LT(std::abs(middle.x() - x), 0.25);
    EXPECT_LT(std::abs(middle.y() - y), 0.25);
  }
}

TEST(MeshPart, WhatIsWellBehindTheSurfaceIsPassedOver) {
  TriangleMesh mesh;  // one triangle before another, whose first corner is nearer to the line
  mesh.positions = {{0.005, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.001, 0, -1}, {1, 0, -1}, {0, 1, -1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  const PartFinder finder = finder_for(mesh);
  const Ray ray{Vector3(0, 0, 1), -Vector3::UnitZ()};
  const auto with = finder.find(PartKind::Vertex, Affine3::Identity(), probe_along(ray, 0.01, 1.0));
  ASSERT_TRUE(with);
  EXPECT_EQ(with->vertices, std::vector<std::uint32_t>{0});
  const auto without = finder.find(PartKind::Vertex, Affine3::Identity(), probe_along(ray, 0.01));
  ASSERT_TRUE(without);
  EXPECT_EQ(without->vertices, std::vector<std::uint32_t>{3});
}

TEST(MeshPart, ATipFindsWhatIsWithinItsRadiusOnly) {
  const PartFinder finder = finder_for(sheet_of(10));
  const Affine3 place(Eigen::Scaling(2.0));
  const Vector3 tip(0.61, 0.42, 0.05);
  const auto near = finder.find(PartKind::Vertex, place, probe_round(tip, 0.1));
  ASSERT_TRUE(near);
  EXPECT_EQ(near->vertices, std::vector<std::uint32_t>{2 * 11 + 3});
  EXPECT_NEAR(near->meeting.cost, (tip - Vector3(0.6, 0.4, 0.0)).norm() / 0.1, 1e-12);
  EXPECT_FALSE(finder.find(PartKind::Vertex, place, probe_round(tip, 0.05)));
  const auto face = finder.find(PartKind::Face, place, probe_round(tip, 0.051));
  ASSERT_TRUE(face);
  EXPECT_LT((face->place - Vector3(0.61, 0.42, 0.0)).norm(), 1e-12);
}

TEST(MeshPart, TheVerticesRoundAPlaceComeNearestFirst) {
  const TriangleMesh mesh = sheet_of(20);
  const PartFinder finder = finder_for(mesh);
  const Affine3 place = askew(0.8);
  const Vector3 middle = place * Vector3(0.52, 0.47, 0.0);
  std::set<std::uint32_t> wanted;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    if ((place * mesh.positions[v] - middle).norm() <= 0.1) wanted.insert(v);
  }
  const auto found = finder.vertices_near(place, middle, 0.1, 1000);
  EXPECT_GT(found.size(), 5u);
  EXPECT_EQ(std::set<std::uint32_t>(found.begin(), found.end()), wanted);
  for (std::size_t i = 1; i < found.size(); ++i)
    EXPECT_LE((place * mesh.positions[found[i - 1]] - middle).norm(),
              (place * mesh.positions[found[i]] - middle).norm());
  EXPECT_EQ(finder.vertices_near(place, middle, 0.1, 3),
            std::vector<std::uint32_t>(found.begin(), found.begin() + 3));
}

TEST(MeshPart, FollowsAShapeThatIsDragged) {
  TriangleMesh mesh = sheet_of(3);
  PartFinder finder = finder_for(mesh);
  mesh.positions[5] = Vector3(0.3, 0.3, 1.0);
  ASSERT_TRUE(finder.follow(std::make_shared<world::MeshGeometry>(mesh)));
  const auto moved = finder.find(PartKind::Vertex, Affine3::Identity(), probe_round({0.3, 0.3, 1.01}, 0.1));
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->vertices, std::vector<std::uint32_t>{5});
  ASSERT_TRUE(finder.follow(std::make_shared<world::MeshGeometry>(sheet_of(8))));
  const auto other = finder.find(PartKind::Vertex, Affine3::Identity(), probe_round({0.125, 0.0, 0.0}, 0.01));
  ASSERT_TRUE(other);
  EXPECT_EQ(other->vertices, std::vector<std::uint32_t>{1});
  EXPECT_FALSE(finder.follow(world::box(1.0)));
}

TEST(MeshPart, BadInputFindsNothing) {
  const PartFinder finder = finder_for(sheet_of(3));
  const double bad = std::numeric_limits<double>::quiet_NaN();
  const double endless = std::numeric_limits<double>::infinity();
  const Affine3 here = Affine3::Identity();
  EXPECT_FALSE(finder.find(PartKind::Vertex, here, probe_round(Vector3::Constant(bad), 1.0)));
  EXPECT_FALSE(finder.find(PartKind::Edge, here, probe_round(Vector3::Zero(), endless)));
  EXPECT_FALSE(finder.find(PartKind::Edge, here, probe_round(Vector3::Zero(), -1.0)));
  EXPECT_FALSE(finder.find(PartKind::Face, here, probe_along({Vector3::Zero(), Vector3::Zero()}, 0.1)));
  EXPECT_FALSE(
      finder.find(PartKind::Vertex, Affine3(Eigen::Scaling(1.0, 1.0, 0.0)), probe_round({0, 0, 0}, 1)));
  TriangleMesh broken = sheet_of(2);
  broken.triangles[0][0] = 1000;
  EXPECT_FALSE(PartFinder::create(std::make_shared<world::MeshGeometry>(broken)));
  broken = sheet_of(2);
  broken.positions[1].x() = bad;
  EXPECT_FALSE(PartFinder::create(std::make_shared<world::MeshGeometry>(broken)));
  EXPECT_FALSE(PartFinder::create(std::make_shared<world::MeshGeometry>(TriangleMesh())));
  EXPECT_FALSE(PartFinder::create(world::box(1.0)));
}

}  // namespace
}  // namespace icome::interaction
