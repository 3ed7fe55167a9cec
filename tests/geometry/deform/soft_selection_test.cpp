#include "geometry/deform/soft_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/random.h"
#include "geometry/mesh/geodesic_sphere.h"
#include "geometry/meshes.h"

namespace icome::geometry {
namespace {

using Indices = std::vector<std::uint32_t>;

/// From every vertex to every seed.
std::vector<double> straight_by_hand(const TriangleMesh& mesh, const Indices& seeds) {
  std::vector<double> distances(mesh.positions.size(), std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < distances.size(); ++v)
    for (const std::uint32_t seed : seeds)
      distances[v] = std::min(distances[v], (mesh.positions[v] - mesh.positions[seed]).norm());
  return distances;
}

/// Every edge shortens what it can, until none does (Bellman and Ford).
std::vector<double> along_edges_by_hand(const TriangleMesh& mesh, const Indices& seeds) {
  std::vector<double> distances(mesh.positions.size(), std::numeric_limits<double>::infinity());
  for (const std::uint32_t seed : seeds) distances[seed] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& triangle : mesh.triangles) {
      for (int i = 0; i < 6; ++i) {
        const std::uint32_t a = triangle[i % 3], b = triangle[(i + 1 + i / 3) % 3];
        const double on = distances[a] + (mesh.positions[a] - mesh.positions[b]).norm();
        if (!(on < distances[b])) continue;
        distances[b] = on;
        changed = true;
      }
    }
  }
  return distances;
}

/// The formulas as they stand in books.
double weight_by_hand(Falloff falloff, double t) {
  if (t > 1) return 0;
  if (falloff == Falloff::Constant) return 1;
  if (falloff == Falloff::Linear) return 1 - t;
  if (falloff == Falloff::Sharp) return std::pow(1 - t, 2);
  return 1 - 3 * std::pow(t, 2) + 2 * std::pow(t, 3);
}

void expect_weights(const std::vector<SoftWeight>& weights, const std::vector<double>& distances,
                    const SoftSelection& selection) {
  std::map<std::uint32_t, double> given;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    EXPECT_GT(weights[i].weight, 0.0);
    EXPECT_LE(weights[i].weight, 1.0);
    if (i > 0) {
      EXPECT_LT(weights[i - 1].vertex, weights[i].vertex);
    }
    given[weights[i].vertex] = weights[i].weight;
  }
  for (std::uint32_t v = 0; v < distances.size(); ++v) {
    const auto found = given.find(v);
    const double weight = found == given.end() ? 0.0 : found->second;
    EXPECT_NEAR(weight, weight_by_hand(selection.falloff, distances[v] / selection.radius), 1e-12);
  }
}

constexpr Falloff kFalloffs[] = {Falloff::Constant, Falloff::Linear, Falloff::Smooth, Falloff::Sharp};

TEST(SoftSelection, FalloffsRunFromOneToZero) {
  for (const Falloff falloff : kFalloffs) {
    EXPECT_EQ(falloff_weight(falloff, 0), 1.0);
    EXPECT_EQ(falloff_weight(falloff, 1), falloff == Falloff::Constant ? 1.0 : 0.0);
    EXPECT_EQ(falloff_weight(falloff, 1.001), 0.0);
    EXPECT_EQ(falloff_weight(falloff, std::numeric_limits<double>::quiet_NaN()), 0.0);
    for (int i = 0; i < 1000; ++i) {
      EXPECT_NEAR(falloff_weight(falloff, i / 1000.0), weight_by_hand(falloff, i / 1000.0), 1e-15);
      EXPECT_GE(falloff_weight(falloff, i / 1000.0), falloff_weight(falloff, (i + 1) / 1000.0));
    }
  }
  EXPECT_EQ(falloff_weight(Falloff::Smooth, 0.5), 0.5);
  EXPECT_EQ(falloff_weight(Falloff::Sharp, 0.5), 0.25);
  EXPECT_GT(falloff_weight(Falloff::Smooth, std::nextafter(1.0, 0.0)), 0.0);
}

TEST(SoftSelection, AgreesWithBruteForce) {
  base::Random random(71);
  const TriangleMesh mesh = together(bumpy_geodesic_sphere(6, 0.4, 0.2, 3), ring(30, true));
  for (int trial = 0; trial < 40; ++trial) {
    Indices seeds(1 + random.index(trial % 4 == 3 ? 200 : 3));
    for (std::uint32_t& seed : seeds) seed = std::uint32_t(random.index(mesh.positions.size()));
    SoftSelection selection{random.uniform(0.01, 1.5), kFalloffs[trial % 4], SoftDistance::Straight};
    const auto straight = soft_weights(mesh, seeds, selection);
    ASSERT_TRUE(straight) << straight.error().message;
    expect_weights(*straight, straight_by_hand(mesh, seeds), selection);
    selection.distance = SoftDistance::AlongEdges;
    const auto along = soft_weights(mesh, seeds, selection);
    ASSERT_TRUE(along) << along.error().message;
    expect_weights(*along, along_edges_by_hand(mesh, seeds), selection);
  }
}

TEST(SoftSelection, ManySeedsAtOnePlaceAgreeToo) {
  base::Random random(72);
  TriangleMesh mesh;  // no triangles at all: vertices of a cloud, many of them at the same place
  for (int i = 0; i < 500; ++i)
    mesh.positions.emplace_back(random.index(4), random.index(4), 0.25 * double(random.index(4)));
  Indices seeds;
  for (std::uint32_t v = 0; v < 100; ++v) seeds.push_back(5 * v);
  const SoftSelection selection{0.3, Falloff::Linear, SoftDistance::Straight};
  const auto weights = soft_weights(mesh, seeds, selection);
  ASSERT_TRUE(weights);
  expect_weights(*weights, straight_by_hand(mesh, seeds), selection);
}

TEST(SoftSelection, RadiusZeroTakesTheSeedsOnly) {
  TriangleMesh mesh = unit_box();
  mesh.positions.push_back(mesh.positions[3]);  // even what lies at the same place stays
  for (const SoftDistance distance : {SoftDistance::Straight, SoftDistance::AlongEdges}) {
    const auto weights = soft_weights(mesh, Indices{5, 3, 5}, {0.0, Falloff::Constant, distance});
    ASSERT_TRUE(weights);
    EXPECT_EQ(*weights, (std::vector<SoftWeight>{{3, 1.0}, {5, 1.0}}));
  }
}

TEST(SoftSelection, AlongEdgesNeverJumpsToAnotherPart) {
  const TriangleMesh mesh = together(unit_box(), box_mesh({1.01, 0, 0}, {2, 1, 1}));
  const auto straight = soft_weights(mesh, Indices{1}, {0.5, Falloff::Smooth, SoftDistance::Straight});
  const auto along = soft_weights(mesh, Indices{1}, {100.0, Falloff::Smooth, SoftDistance::AlongEdges});
  ASSERT_TRUE(straight && along);
  ASSERT_EQ(straight->size(), 2U);
  EXPECT_EQ((*straight)[1].vertex, 8U);
  EXPECT_EQ(along->size(), 8U);
}

TEST(SoftSelection, DoesNotDependOnTheUnitOfLength) {
  const TriangleMesh mesh = bumpy_geodesic_sphere(4, 1.0, 0.2, 2);
  for (const SoftDistance distance : {SoftDistance::Straight, SoftDistance::AlongEdges}) {
    const auto metres = soft_weights(mesh, Indices{3, 40}, {0.8, Falloff::Smooth, distance});
    ASSERT_TRUE(metres);
    for (const double unit : {0x1p-900, 0x1p900}) {
      TriangleMesh scaled = mesh;
      for (Vector3& p : scaled.positions) p *= unit;
      const auto weights = soft_weights(scaled, Indices{3, 40}, {0.8 * unit, Falloff::Smooth, distance});
      ASSERT_TRUE(weights);
      EXPECT_EQ(*weights, *metres);
    }
  }
}

TEST(SoftSelection, ExtremesGiveNumbers) {
  const double most = std::numeric_limits<double>::max();
  const TriangleMesh mesh{{{-most, 0, 0}, {most, 0, 0}, {0, most, most}}, {{0, 1, 2}, {1, 1, 2}}};
  for (const SoftDistance distance : {SoftDistance::Straight, SoftDistance::AlongEdges}) {
    for (const double radius : {5e-324, 1.0, most}) {
      const auto weights = soft_weights(mesh, Indices{0}, {radius, Falloff::Linear, distance});
      ASSERT_TRUE(weights);
      ASSERT_FALSE(weights->empty());
      EXPECT_EQ(weights->front(), (SoftWeight{0, 1.0}));
      for (const SoftWeight& weight : *weights) EXPECT_TRUE(weight.weight > 0 && weight.weight <= 1);
    }
  }
}

TEST(SoftSelection, RefusesWhatMakesNoSense) {
  const TriangleMesh box = unit_box();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double radius : {-0.1, nan, std::numeric_limits<double>::infinity()}) {
    const auto weights = soft_weights(box, Indices{0}, {radius});
    ASSERT_FALSE(weights);
    EXPECT_NE(weights.error().message.find("radius"), std::string::npos);
  }
  const auto absent = soft_weights(box, Indices{8}, {1.0});
  ASSERT_FALSE(absent);
  EXPECT_NE(absent.error().message.find("vertex 8 is not there"), std::string::npos);
  TriangleMesh broken = box;
  broken.positions[4].z() = nan;
  EXPECT_FALSE(soft_weights(broken, Indices{0}, {1.0}));
  broken = box;
  broken.triangles[0][0] = 99;
  EXPECT_FALSE(soft_weights(broken, Indices{0}, {1.0}));
  const auto none = soft_weights(box, {}, {1.0});
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->empty());
}

}  // namespace
}  // namespace icome::geometry
