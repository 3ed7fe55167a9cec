#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "geometry/closed_mesh.h"
#include "geometry/loop/loop_surface.h"
#include "geometry/loop_reference.h"
#include "geometry/tree/triangle_tree.h"

namespace icome::geometry {
namespace loop_contact_test {
namespace {

namespace ref = loop_reference;

constexpr double kSlack = 1e-11;

std::shared_ptr<const LoopSurface> touchable(const ControlMesh& control) {
  auto surface = LoopSurface::create(control);
  EXPECT_TRUE(surface.has_value()) << (surface ? "" : surface.error().message);
  return surface ? *surface : nullptr;
}

/// The first hit on any piece.
std::optional<SurfaceHit> first_hit_of(const LoopSurface& surface, const Vector3& start, const Vector3& step,
                                       bool from_behind) {
  std::optional<SurfaceHit> first;
  surface.near(start, start + step, kSlack, 0.0, [&](std::uint32_t piece, const Bounds&) {
    const auto hit = surface.first_hit(piece, start, step, from_behind, 0.0, kSlack);
    if (hit && (!first || hit->t < first->t)) first = hit;
    return true;
  });
  return first;
}

/// The lowest place around (u, v) of a triangle that looking ever closer finds.
double nearest_by_looking(const LoopSurface& surface, std::uint32_t triangles, const Vector3& goal) {
  struct Best {
    double distance = 1e300;
    std::uint32_t face = 0;
    double u = 0.0, v = 0.0;
  };
  constexpr int kSteps = 12;
  Best best;
  const auto look = [&](std::uint32_t face, double u, double v) {
    if (u < 0.0 || v < 0.0 || u + v > 1.0) return;
    const double distance = (surface.sample(face, u, v).point - goal).norm();
    if (distance < best.distance) best = {distance, face, u, v};
  };
  for (std::uint32_t face = 0; face < triangles; ++face) {
    for (int j = 0; j <= kSteps; ++j) {
      for (int i = 0; i + j <= kSteps; ++i) look(face, double(i) / kSteps, double(j) / kSteps);
    }
  }
  for (double step = 1.0 / kSteps; step > 1e-9; step *= 0.7) {
    const Best from = best;
    for (int i = 0; i < 16; ++i) {
      const double angle = 0.3926990816987241 * i;
      look(from.face, std::max(0.0, from.u + step * std::cos(angle)),
           std::max(0.0, from.v + step * std::sin(angle)));
    }
    const double along = from.u + from.v;
    if (along + step > 1.0) {
      look(from.face, from.u / along + 0.5 * step, 1.0 - from.u / along - 0.5 * step);
      look(from.face, from.u / along - 0.5 * step, 1.0 - from.u / along + 0.5 * step);
    }
  }
  return best.distance;
}

TEST(LoopContact, NearestPlaceIsTheOneThatLookingFinds) {
  const ref::Index count[] = {3, 5, 12, 30};
  for (const ref::Index valence : count) {
    const ControlMesh control{ref::bipyramid(valence, 0.1, valence), {}, {}};
    const auto surface = touchable(control);
    base::Random random(valence);
    for (int trial = 0; trial < 25; ++trial) {
      const auto face = std::uint32_t(random.index(control.mesh.triangles.size()));
      const auto at = surface->sample(face, random.uniform(0.0, 0.4), random.uniform(0.0, 0.4));
      const Vector3 goal = at.point - 0.1 * random.uniform() * at.normal;
      if (!surface->inside(goal)) continue;
      const auto place = surface->way_out(goal, 0.0);
      ASSERT_TRUE(place.has_value());
      const double found = (place->point - goal).norm();
      EXPECT_LT(found,
                nearest_by_looking(*surface, std::uint32_t(control.mesh.triangles.size()), goal) + 1e-9);
    }
  }
}

TEST(LoopContact, FootIsPerpendicularOrAtTheRim) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const ControlMesh control = ref::torn(ref::wild_ball(2, 100, 0.04, seed), 0.05, 0.05, 0.0, seed);
    const auto surface = touchable(control);
    base::Random random(seed);
    int inner = 0, rim = 0;
    for (int trial = 0; trial < 3000; ++trial) {
      const SurfacePlace any{{},
                             {},
                             std::uint32_t(random.index(4 * control.mesh.triangles.size())),
                             random.uniform(0.0, 0.5),
                             random.uniform(0.0, 0.5)};
      const SurfacePlace start = surface->nearest_local(any, Vector3::Zero(), 0.0);
      const Vector3 goal = start.point + 0.05 * random.uniform() * random.direction();
      const SurfacePlace foot = surface->nearest_local(start, goal, 0.0);
      const Vector3 rest = goal - foot.point;
      const double left = (rest - foot.normal * foot.normal.dot(rest)).norm();
      EXPECT_NEAR(foot.normal.norm(), 1.0, 1e-12);
      if (left < 1e-12) {
        ++inner;
        EXPECT_TRUE(surface->covers(foot, goal, 0.0, kSlack));
        continue;
      }
      ++rim;
      EXPECT_LE(std::min(foot.u, foot.v), 0.0);
      EXPECT_FALSE(surface->covers(foot, goal, 0.0, kSlack)) << left;
      // No place of the neighbourhood is nearer.
      for (int near = 0; near < 5; ++near) {
        SurfacePlace other = foot;
        other.u = std::min(1.0, foot.u + 1e-4 * random.uniform());
        other.v = std::min(1.0 - other.u, foot.v + 1e-4 * random.uniform());
        const SurfacePlace again = surface->nearest_local(other, goal, 0.0);
        EXPECT_LT((again.point - foot.point).norm(), 1e-6);
      }
    }
    EXPECT_GT(inner, 300);
    EXPECT_GT(rim, 100);
  }
}

TEST(LoopContact, FootGoesOverEdgesToAPlaceFarAway) {
  const ControlMesh control{ref::wild_ball(2, 60, 0.02, 5), {}, {}};
  const auto surface = touchable(control);
  base::Random random(5);
  for (int trial = 0; trial < 300; ++trial) {
    const auto face = std::uint32_t(random.index(control.mesh.triangles.size()));
    const auto target = surface->sample(face, random.uniform(0.0, 0.5), random.uniform(0.0, 0.5));
    const Vector3 goal = target.point + 1e-3 * target.normal;
    SurfacePlace place{{}, {}, std::uint32_t(random.index(4 * control.mesh.triangles.size())), 0.3, 0.3};
    for (int i = 0; i < 4; ++i) place = surface->nearest_local(place, goal, 0.0);
    EXPECT_LT((place.point - target.point).norm(), 1e-12);
  }
}

TEST(LoopContact, FootAtExtraordinaryVerticesEndsThere) {
  for (const ref::Index valence : {3u, 4u, 5u, 7u, 12u, 40u}) {
    const ControlMesh control{ref::bipyramid(valence, 0.0, 1), {}, {}};
    const auto surface = touchable(control);
    const auto pole = surface->sample(0, 0.0, 0.0);
    const auto next = surface->sample(0, 0.25, 0.2);
    const auto hit = first_hit_of(*surface, next.point + 0.1 * next.normal, -0.2 * next.normal, false);
    ASSERT_TRUE(hit.has_value());
    const SurfacePlace foot = surface->nearest_local(hit->place, pole.point + 0.05 * pole.normal, 0.0);
    EXPECT_LT((foot.point - pole.point).norm(), 1e-12) << valence;
    const SurfacePlace away = surface->nearest_local(foot, next.point + 0.01 * next.normal, 0.0);
    EXPECT_LT((away.point - next.point).norm(), 1e-12) << valence;
  }
}

/// Segments between random places around and on the surface.
void compare_with_mesh(const ControlMesh& control, int level, int trials, std::uint64_t seed) {
  const auto surface = touchable(control);
  const auto mesh = surface->tessellate(level);
  ASSERT_TRUE(mesh.has_value());
  const TriangleTree tree(*mesh);
  base::Random random(seed);
  const double size = surface->bounds().diagonal().norm();
  int hits = 0, differences = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const Vector3 start =
        surface->bounds().center() + 0.6 * size * random.uniform(0.2, 1.0) * random.direction();
    const Vector3 end = surface->bounds().center() + 0.6 * size * random.uniform() * random.direction();
    const auto hit = tree.first_hit(start, end);
    const auto front = first_hit_of(*surface, start, end - start, false);
    const auto back = first_hit_of(*surface, start, end - start, true);
    const bool goes_in = front && (!back || front->t < back->t);
    const auto first = goes_in ? front : back;
    if (hit) ++hits;
    if (first) {
      EXPECT_LT((start + first->t * (end - start) - first->place.point).norm(), 1e-12 * size);
      const double slope = first->place.normal.dot(end - start);
      EXPECT_LT(goes_in ? slope : -slope, 1e-6 * size);
    }
    const bool same =
        hit ? first && std::abs(first->t - hit->parameter) * (end - start).norm() < 0.02 * size : !first;
    if (!same) ++differences;
  }
  EXPECT_GT(hits, trials / 10);
  EXPECT_LT(differences, trials / 200);  // the mesh cuts corners that grazing segments meet
}

TEST(LoopContact, EntriesAreThoseOfAFineMesh) {
  compare_with_mesh({ref::wild_ball(1, 30, 0.15, 1), {}, {}}, 4, 5000, 1);
  compare_with_mesh(ref::torn(ref::wild_ball(1, 30, 0.15, 2), 0.1, 0.1, 0.05, 2), 4, 4000, 2);
  compare_with_mesh({ref::bipyramid(30, 0.1, 3), {}, {}}, 4, 2000, 3);
}

TEST(LoopContact, NothingSlipsThroughVerticesAndEdges) {
  for (const std::uint64_t seed : {1u, 2u}) {
    const ControlMesh control{ref::wild_ball(1, 30, 0.15, seed), {}, {}};
    const auto surface = touchable(control);
    base::Random random(seed);
    for (int trial = 0; trial < 1500; ++trial) {
      const auto face = std::uint32_t(random.index(control.mesh.triangles.size()));
      // Corners, middles of sides, places on sides and on the edges of pieces.
      const double along = trial % 5 == 0 ? 0.5 : trial % 5 == 1 ? 0.0 : random.uniform();
      const auto at = trial % 2 ? surface->sample(face, along, 0.0) : surface->sample(face, 0.5, 0.5 * along);
      Vector3 direction = random.direction();
      if (direction.dot(at.normal) > 0.0) direction = -direction;
      if (direction.dot(at.normal) > -1e-3) continue;
      const double length = std::pow(10.0, random.uniform(-8.0, -1.0));
      const auto hit = first_hit_of(*surface, at.point - length * direction, 2.0 * length * direction, false);
      ASSERT_TRUE(hit.has_value()) << trial;
      EXPECT_LT((hit->place.point - at.point).norm(), length + 1e-9);
    }
  }
}

TEST(LoopContact, GrazingSegmentsAreCaught) {
  // Chords that dip below the surface by as little as ten times what counts.
  const ControlMesh control{ref::wild_ball(1, 30, 0.02, 4), {}, {}};
  const auto surface = touchable(control);
  base::Random random(4);
  int caught = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const auto face = std::uint32_t(random.index(control.mesh.triangles.size()));
    const auto at = surface->sample(face, random.uniform(0.0, 0.5), random.uniform(0.0, 0.5));
    const double depth = std::pow(10.0, random.uniform(-10.0, -3.0));
    const Vector3 tangent = at.normal.unitOrthogonal();
    const Vector3 middle = at.point - depth * at.normal;
    const Vector3 step = 3.0 * tangent;
    if (surface->inside(middle - step) || surface->inside(middle + step)) continue;
    const auto hit = first_hit_of(*surface, middle - step, 2.0 * step, false);
    ASSERT_TRUE(hit.has_value()) << depth;
    ++caught;
  }
  EXPECT_GT(caught, 2000);
}

TEST(LoopContact, StartsOnTheSurfaceEnterOnlyWhenTheyMoveIn) {
  const ControlMesh control{ref::wild_ball(1, 30, 0.1, 6), {}, {}};
  const auto surface = touchable(control);
  base::Random random(6);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto face = std::uint32_t(random.index(control.mesh.triangles.size()));
    const auto at = surface->sample(face, random.uniform(0.0, 0.5), random.uniform(0.0, 0.5));
    const Vector3 start = at.point + random.uniform(-0.8, 0.8) * kSlack * at.normal;
    Vector3 step = random.direction();
    if (std::abs(step.dot(at.normal)) < 0.1) continue;
    step *= 1e-3;
    const auto hit = first_hit_of(*surface, start, step, false);
    const auto exit = first_hit_of(*surface, start, step, true);
    const bool in = step.dot(at.normal) < 0.0;
    EXPECT_EQ(hit.has_value(), in);
    EXPECT_EQ(exit.has_value(), !in);
    if (hit) {
      EXPECT_LT(hit->t, 1e-7);
    }
  }
}

TEST(LoopContact, InsideIsToldNextToTheSurface) {
  for (const std::uint64_t seed : {1u, 2u}) {
    const ControlMesh control = ref::torn(ref::wild_ball(1, 30, 0.15, seed), 0.0, 0.1, 0.05, seed);
    const auto surface = touchable(control);
    ASSERT_TRUE(surface->closed());
    base::Random random(seed);
    for (int trial = 0; trial < 2000; ++trial) {
      const auto face = std::uint32_t(random.index(control.mesh.triangles.size()));
      const double u = trial % 7 == 0 ? 0.0 : random.uniform(0.0, 0.5);
      const auto at = surface->sample(face, u, random.uniform(0.01, 0.49));
      const Vector3 off = 1e-9 * at.normal;
      if (trial % 7 != 0 || control.creases.empty()) {
        EXPECT_TRUE(surface->inside(at.point - off));
        EXPECT_FALSE(surface->inside(at.point + off));
      }
    }
    EXPECT_FALSE(surface->inside({10.0, 0.0, 0.0}));
    EXPECT_TRUE(surface->inside({0.0, 0.0, 0.0}));
  }
}

TEST(LoopContact, TessellationsLieOnTheSurfaceAndStayClosed) {
  const ControlMesh control = ref::torn(ref::wild_ball(1, 30, 0.1, 6), 0.0, 0.1, 0.05, 6);
  const auto surface = touchable(control);
  for (const int level : {0, 1, 2, 3}) {
    const auto mesh = surface->tessellate(level);
    ASSERT_TRUE(mesh.has_value());
    EXPECT_EQ(mesh->triangles.size(), control.mesh.triangles.size() << (2 * level));
    EXPECT_TRUE(is_closed(*mesh));
    EXPECT_EQ(euler_characteristic(*mesh), 2);
    EXPECT_GT(volume(*mesh), 0.0);
  }
  EXPECT_FALSE(surface->tessellate(-1).has_value());
  EXPECT_FALSE(surface->tessellate(12).has_value());
}

TEST(LoopContact, SamePiecesShareASmoothVertex) {
  ControlMesh control{ref::wild_ball(1, 30, 0.1, 6), {}, {}};
  const auto round = touchable(control);
  for (const auto& t : control.mesh.triangles) control.creases.push_back({t[0], t[1]});
  const auto creased = touchable(control);
  const auto pieces = std::uint32_t(4 * control.mesh.triangles.size());
  std::size_t round_pairs = 0, creased_pairs = 0;
  for (std::uint32_t a = 0; a < pieces; ++a) {
    EXPECT_TRUE(round->same(a, a));
    for (std::uint32_t b = 0; b < pieces; ++b) {
      EXPECT_EQ(round->same(a, b), round->same(b, a));
      round_pairs += round->same(a, b);
      creased_pairs += creased->same(a, b);
    }
  }
  // A piece and twelve around it where all valences are six.
  EXPECT_GT(round_pairs, 11 * pieces);
  EXPECT_LT(round_pairs, 15 * pieces);
  EXPECT_LT(creased_pairs, 2 * round_pairs / 3);
}

}  // namespace
}  // namespace loop_contact_test
}  // namespace icome::geometry
