#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "geometry/loop/loop_surface.h"
#include "geometry/loop_reference.h"

namespace icome::geometry {
namespace loop_evaluation_test {
namespace {

namespace ref = loop_reference;

std::shared_ptr<const LoopSurface> make(const ControlMesh& control) {
  auto surface = LoopSurface::create(control);
  EXPECT_TRUE(surface.has_value()) << (surface ? "" : surface.error().message);
  return surface ? *surface : nullptr;
}

struct Difference {
  double point = 0.0, normal = 0.0;
};

/// The largest differences from explicit subdivision over `count` places of random faces.
Difference compare(const ControlMesh& control, int levels, int count, std::uint64_t seed,
                   bool vertices_only) {
  const auto surface = make(control);
  const ref::Mesh mesh = ref::from_control(control);
  base::Random random(seed);
  Difference worst;
  for (int trial = 0; trial < count; ++trial) {
    const auto face = std::uint32_t(random.index(control.mesh.triangles.size()));
    const ref::Index most = ref::Index(1) << levels;
    ref::Index i = ref::Index(random.index(most + 1)), j = ref::Index(random.index(most + 1));
    if (i + j > most) i = most - i, j = most - j;
    if (vertices_only) i = trial % 3 == 1 ? most : 0, j = trial % 3 == 2 ? most : 0;
    const ref::Spot spot = ref::descend(mesh, face, i, j, levels);
    const ref::Limit limit = ref::limit_of(spot.mesh, spot.mesh.faces[0], spot.vertex);
    const double u = double(i) / most, v = double(j) / most;
    const LoopSurface::Sample sample = surface->sample(face, u, v);
    worst.point = std::max(worst.point, (sample.point - limit.point).norm());
    EXPECT_NEAR(sample.normal.norm(), 1.0, 1e-12);
    if (limit.has_normal && limit.normal.allFinite()) {
      worst.normal = std::max(worst.normal, (sample.normal - limit.normal).norm());
    }
  }
  return worst;
}

TEST(LoopEvaluation, AgreesWithEightSubdivisionsAtEveryValence) {
  for (const ref::Index valence : {3u, 4u, 5u, 6u, 7u, 8u, 12u, 20u, 40u, 300u}) {
    SCOPED_TRACE("valence " + std::to_string(valence));
    const ControlMesh control{ref::bipyramid(valence, 0.2, valence), {}, {}};
    const int count = valence > 50 ? 6 : 40;
    const Difference inside = compare(control, 8, count, 1, false);
    EXPECT_LT(inside.point, 1e-12);
    EXPECT_LT(inside.normal, 1e-9);
    const Difference vertices = compare(control, 8, valence > 50 ? 3 : 12, 2, true);
    EXPECT_LT(vertices.point, 1e-12);
    EXPECT_LT(vertices.normal, 1e-9);
  }
}

TEST(LoopEvaluation, AgreesWithExplicitSubdivisionAroundHolesCreasesAndCorners) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ControlMesh control = ref::torn(ref::wild_ball(1, 30, 0.2, seed), 0.1, 0.1, 0.05, seed);
    const Difference inside = compare(control, 8, 150, seed, false);
    EXPECT_LT(inside.point, 1e-12);
    EXPECT_LT(inside.normal, 1e-9);
    const Difference vertices = compare(control, 3, 150, seed, true);
    EXPECT_LT(vertices.normal, 1e-9);
  }
}

TEST(LoopEvaluation, SubdividingTheControlMeshChangesNothing) {
  // Holds for masks that belong to the scheme, and for no others.
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const ControlMesh control = ref::torn(ref::wild_ball(1, 40, 0.2, seed), 0.05, 0.1, 0.02, seed);
    const ref::Mesh fine = ref::subdivide(ref::from_control(control));
    ControlMesh fine_control{{fine.points, fine.faces}, {}, {fine.corners.begin(), fine.corners.end()}};
    for (const auto& [a, b] : fine.creases) fine_control.creases.push_back({a, b});
    const auto one = make(control), other = make(fine_control);
    const ref::Mesh coarse = ref::from_control(control);
    const ref::Around around(coarse);
    for (std::uint32_t face = 0; face < control.mesh.triangles.size(); ++face) {
      const ref::Index vertex = control.mesh.triangles[face][0];
      const bool corner = coarse.corners.contains(vertex) || around.sharp_count(vertex) > 2;
      for (const double u : {0.0, 1e-9, 1e-3, 0.2}) {
        for (const double v : {0.0, 1e-7, 0.3}) {
          const auto a = one->sample(face, u, v), b = other->sample(4 * face, 2.0 * u, 2.0 * v);
          EXPECT_LT((a.point - b.point).norm(), 1e-14);
          if (corner && u + v == 0.0) continue;  // the limit may have no tangent plane
          // Where a single face is rounded off its derivatives become parallel towards the vertex.
          EXPECT_LT((a.normal - b.normal).norm(), u + v == 0.0 || u + v > 1e-4 ? 1e-9 : 1e-6);
        }
      }
    }
  }
}

TEST(LoopEvaluation, VerticesOfEveryKindLieWhereSubdivisionLeadsThem) {
  // Fifty levels end near the limit whatever the vertex, without any mask.
  for (const std::uint64_t seed : {1u, 2u}) {
    const ControlMesh control = ref::torn(ref::wild_ball(1, 30, 0.2, seed), 0.08, 0.15, 0.05, seed);
    const auto surface = make(control);
    const ref::Mesh mesh = ref::from_control(control);
    for (std::uint32_t face = 0; face < control.mesh.triangles.size(); ++face) {
      const ref::Spot spot = ref::descend(mesh, face, 0, 0, 30);
      const double error = (surface->sample(face, 0.0, 0.0).point - spot.mesh.points[spot.vertex]).norm();
      EXPECT_LT(error, 1e-9);
    }
  }
}

TEST(LoopEvaluation, DerivativesAreThoseOfThePoints) {
  const ControlMesh control = ref::torn(ref::wild_ball(1, 30, 0.2, 7), 0.1, 0.1, 0.0, 7);
  const auto surface = make(control);
  base::Random random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto face = std::uint32_t(random.index(control.mesh.triangles.size()));
    const double u = random.uniform(0.01, 0.5), v = random.uniform(0.01, 0.48), h = 1e-5;
    const auto at = [&](double du, double dv) { return surface->sample(face, u + du, v + dv).point; };
    const auto sample = surface->sample(face, u, v);
    EXPECT_LT((sample.du - (at(h, 0.0) - at(-h, 0.0)) / (2.0 * h)).norm(), 1e-7);
    EXPECT_LT((sample.dv - (at(0.0, h) - at(0.0, -h)) / (2.0 * h)).norm(), 1e-7);
    EXPECT_LT((sample.normal - sample.du.cross(sample.dv).normalized()).norm(), 1e-10);
  }
}

TEST(LoopEvaluation, FacesMeetInPointAndNormal) {
  for (const std::uint64_t seed : {1u, 2u}) {
    const ControlMesh control = ref::torn(ref::wild_ball(1, 40, 0.2, seed), 0.1, 0.0, 0.0, seed);
    const auto surface = make(control);
    std::map<std::pair<ref::Index, ref::Index>, std::pair<std::uint32_t, int>> side_of;
    const auto& triangles = control.mesh.triangles;
    const auto on_side = [&](std::uint32_t face, int side, double along) {
      std::array<double, 3> weights = {0.0, 0.0, 0.0};
      weights[side] = 1.0 - along;
      weights[(side + 1) % 3] = along;
      return surface->sample(face, weights[1], weights[2]);
    };
    for (std::uint32_t f = 0; f < triangles.size(); ++f) {
      for (int i = 0; i < 3; ++i) side_of[{triangles[f][i], triangles[f][(i + 1) % 3]}] = {f, i};
    }
    for (const auto& [ends, side] : side_of) {
      const auto other = side_of.find({ends.second, ends.first});
      if (other == side_of.end()) continue;
      for (double along = 0.0625; along < 1.0; along += 0.125) {
        const auto a = on_side(side.first, side.second, along);
        const auto b = on_side(other->second.first, other->second.second, 1.0 - along);
        EXPECT_LT((a.point - b.point).norm(), 1e-14);
        EXPECT_LT((a.normal - b.normal).norm(), 1e-11);
      }
    }
  }
}

TEST(LoopEvaluation, MovesAndScalesWithTheControlMesh) {
  const ControlMesh control = ref::torn(ref::wild_ball(1, 30, 0.2, 3), 0.1, 0.1, 0.05, 3);
  ControlMesh tiny = control;
  const Vector3 shift(2.0, -1.0, 0.5);
  for (Vector3& p : tiny.mesh.positions) p = 1e-6 * (p + shift);
  const auto one = make(control), other = make(tiny);
  for (std::uint32_t face = 0; face < control.mesh.triangles.size(); ++face) {
    const auto a = one->sample(face, 0.1, 0.2), b = other->sample(face, 0.1, 0.2);
    EXPECT_LT((1e-6 * (a.point + shift) - b.point).norm(), 1e-20);
    EXPECT_LT((a.normal - b.normal).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace loop_evaluation_test
}  // namespace icome::geometry
