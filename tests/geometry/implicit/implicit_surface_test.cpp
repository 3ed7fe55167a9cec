#include "geometry/implicit/implicit_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "geometry/implicit/implicit_walk.h"

namespace icome::geometry {
namespace implicit_surface_test {
namespace {

using Surface = std::shared_ptr<const ImplicitSurface>;

constexpr double kFieldInfinity = std::numeric_limits<double>::infinity();

Bounds cube(double half) { return {Vector3::Constant(-half), Vector3::Constant(half)}; }

Surface surface_of(const std::string& formula, const Bounds& box = cube(0.1)) {
  auto surface = ImplicitSurface::create(formula, box);
  EXPECT_TRUE(surface) << formula << ": " << (surface ? "" : surface.error().message);
  return surface ? *surface : nullptr;
}

std::string surface_error(const std::string& formula, const Bounds& box = cube(0.1)) {
  const auto surface = ImplicitSurface::create(formula, box);
  return surface ? "" : surface.error().message;
}

Vector3 random_in(const Bounds& box, base::Random& random) {
  Vector3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = random.uniform(box.min()[axis], box.max()[axis]);
  return p;
}

double distance_to(const ImplicitSurface& surface, const Vector3& point, double time = 0.0) {
  const ImplicitSurface::Value at = surface.value(point, time);
  return std::abs(at.value) / at.gradient.norm();
}

const std::string kSphere = "x^2 + y^2 + z^2 - 0.05^2";
const std::string kTorus = "(sqrt(x^2 + y^2) - 0.05)^2 + z^2 - 0.02^2";
const std::string kGyroid = "sin(80*x)*cos(80*y) + sin(80*y)*cos(80*z) + sin(80*z)*cos(80*x)";
const std::string kWaves = "z - 0.005*sin(60*x + 3*t)*cos(60*y)";
const std::string kEllipsoid = "(x/0.08)^2 + (y/0.05)^2 + (z/0.03)^2 - 1";
constexpr double kFieldSlack = 2e-12;  // 1e-11 of the cube's edge

/// Through whichever piece comes first.
std::optional<SurfaceHit> first_hit_of(const ImplicitSurface& surface, const Vector3& start,
                                       const Vector3& step, bool from_behind = false) {
  std::optional<SurfaceHit> first;
  surface.near(start, start + step, kFieldSlack, 0.0, [&](std::uint32_t piece, const Bounds&) {
    const auto hit = surface.first_hit(piece, start, step, from_behind, 0.0, kFieldSlack);
    if (hit && (!first || hit->t < first->t)) first = hit;
    return true;
  });
  return first;
}

// ---- Creation ----------------------------------------------------------------------------------------

TEST(ImplicitSurface, RefusesBoxesThatAreNone) {
  EXPECT_NE(surface_error(kSphere, Bounds()), "");
  EXPECT_NE(surface_error(kSphere, cube(0.0)), "");
  EXPECT_NE(surface_error(kSphere, cube(-1.0)), "");
  EXPECT_NE(surface_error(kSphere, cube(kFieldInfinity)), "");
  EXPECT_NE(surface_error(kSphere, cube(std::nan(""))), "");
  EXPECT_NE(surface_error(kSphere, cube(1e300)), "");
  EXPECT_NE(surface_error(kSphere, {Vector3(-1, -1, 0), Vector3(1, 1, 1e-12)}), "");
}

TEST(ImplicitSurface, RefusesFormulasWithoutSurface) {
  EXPECT_NE(surface_error("x^2 + y^2 + 0.1").find("positive"), std::string::npos);
  EXPECT_NE(surface_error("x - 1").find("negative"), std::string::npos);
  EXPECT_NE(surface_error("z - 0.2 - 0.05*sin(60*x + 3*t)").find("negative"), std::string::npos);
  EXPECT_NE(surface_error("log(x - 5)").find("undefined"), std::string::npos);
  EXPECT_NE(surface_error("3").find("depend"), std::string::npos);
  EXPECT_NE(surface_error("sin(t)").find("depend"), std::string::npos);
  EXPECT_NE(surface_error("x + foo").find("column 5"), std::string::npos);
  EXPECT_NE(surface_error(""), "");
}

TEST(ImplicitSurface, KnowsItsBoundsAndWhetherItChanges) {
  const Surface sphere = surface_of(kSphere);
  EXPECT_FALSE(sphere->changes());
  EXPECT_TRUE(sphere->bounds().contains(cube(0.05)));
  EXPECT_TRUE(cube(0.07).contains(sphere->bounds()));
  EXPECT_LT(sphere->bytes(), 200'000U);
  const Surface waves = surface_of(kWaves);
  EXPECT_TRUE(waves->changes());
  EXPECT_NEAR(waves->bounds().min().z(), -0.1, 1e-12);  // its box's floor and sides
  EXPECT_LT(waves->bounds().max().z(), 0.013);
}

TEST(ImplicitSurface, IsInsideWhereTheFormulaIsNegativeInTheBox) {
  const Surface waves = surface_of(kWaves);
  EXPECT_TRUE(waves->inside({0, 0, -0.01}, 0.0));
  EXPECT_FALSE(waves->inside({0, 0, 0.01}, 0.0));
  EXPECT_FALSE(waves->inside({0, 0, -0.11}, 0.0));
  EXPECT_FALSE(surface_of("z - sqrt(x)")->inside({-0.01, 0, -0.05}, 0.0));  // not a number there
}

TEST(ImplicitSurface, MovesAtTheSpeedOfItsWaves) {
  const Surface rising = surface_of("z - 0.01*t");
  EXPECT_NEAR(rising->normal_speed({{0, 0, 0}, Vector3::UnitZ()}, 0.0), 0.01, 1e-15);
  const Surface steep = surface_of("3*z - 4*x - 0.05*t");
  EXPECT_NEAR(steep->normal_speed({{0, 0, 0}, Vector3(-0.8, 0, 0.6)}, 0.0), 0.01, 1e-15);
  EXPECT_EQ(steep->normal_speed({{0.1, 0, 0}, Vector3::UnitX(), 2}, 0.0), 0.0);
}

// ---- Entries -----------------------------------------------------------------------------------------

struct Segment {
  Vector3 start, step;
};

Segment random_segment(const Bounds& box, base::Random& random) {
  const Vector3 a = random_in(box, random), b = random_in(box, random);
  const double part = std::pow(10.0, random.uniform(-3.0, 0.0));
  return {a, part * (b - a)};
}

/// Dense sampling finds some crossings; none of them may come before the answer, and the answer must be a
/// crossing.
void compare_with_samples(const std::string& formula, int segments, double time) {
  const Surface surface = surface_of(formula);
  base::Random random(11);
  int found = 0;
  for (int i = 0; i < segments; ++i) {
    const auto [start, step] = random_segment(surface->box(), random);
    const auto hit = surface->first_hit(0, start, step, false, time, kFieldSlack);
    constexpr int kSamples = 40;
    double before = surface->value(start, time).value;
    for (int k = 1; k <= kSamples; ++k) {
      const double t = static_cast<double>(k) / kSamples;
      const double value = surface->value(start + t * step, time).value;
      if (before >= 0.0 && value < 0.0) {
        ASSERT_TRUE(hit.has_value()) << formula << " segment " << i;
        ASSERT_LE(hit->t, t) << formula << " segment " << i;
        break;
      }
      before = value;
    }
    if (!hit) continue;
    ++found;
    ASSERT_LE(distance_to(*surface, hit->place.point, time), kFieldSlack);
    ASSERT_NEAR((hit->place.point - start - hit->t * step).norm(), 0.0, 1e-15);
    const double falls = surface->value(hit->place.point, time).gradient.dot(step);
    ASSERT_LE(falls, 1e-4 * surface->value(hit->place.point, time).gradient.norm() * step.norm());
  }
  EXPECT_GT(found, segments / 50) << formula;
}

TEST(ImplicitSurface, EntersWhereDenseSamplesDo) {
  compare_with_samples(kSphere, 30'000, 0.0);
  compare_with_samples(kTorus, 20'000, 0.0);
  compare_with_samples(kGyroid, 20'000, 0.0);
  compare_with_samples(kWaves, 30'000, 1.3);
}

TEST(ImplicitSurface, EntersASphereWhereTheQuadraticEquationSays) {
  const Surface sphere = surface_of(kSphere);
  base::Random random(12);
  for (int i = 0; i < 30'000; ++i) {
    // Ways past the sphere at distances from the grazing one down to far below rounding.
    const Vector3 to = random.direction(), ahead = to.unitOrthogonal();
    const double depth = std::pow(10.0, random.uniform(-14.0, -2.0)) * (random.index(2) == 0 ? 1.0 : -1.0);
    const Vector3 nearest = (0.05 - depth) * to;
    const Vector3 start = nearest - random.uniform(0.03, 0.1) * ahead;
    if (!sphere->box().contains(start)) continue;
    const Vector3 step = random.uniform(0.11, 0.2) * ahead;
    const auto hit = sphere->first_hit(0, start, step, false, 0.0, kFieldSlack);
    const double half_chord_square = 0.05 * 0.05 - nearest.squaredNorm();
    if (depth > kFieldSlack) {
      ASSERT_TRUE(hit.has_value()) << depth;
      const double t = ((nearest - start).dot(ahead) - std::sqrt(half_chord_square)) / step.norm();
      // Across the surface it is exact; along a grazing way that is a longer length.
      const double angle = std::sqrt(half_chord_square) / 0.05;
      ASSERT_NEAR(hit->t, t, (0.1 * kFieldSlack / angle + 1e-13) / step.norm()) << depth;
    } else if (depth < -kFieldSlack) {
      ASSERT_FALSE(hit.has_value()) << depth;
    }
  }
}

TEST(ImplicitSurface, MissesNoThinSheet) {
  const Surface flat = surface_of("z*(z - 1e-6)");
  const Surface wavy = surface_of("abs(z - 0.005*sin(60*x)*cos(60*y)) - 5e-7");
  const Surface shell = surface_of("(x^2 + y^2 + z^2 - 0.05^2)*(x^2 + y^2 + z^2 - 0.050001^2)");
  base::Random random(13);
  for (const Surface& sheet : {flat, wavy, shell}) {
    int crossings = 0;
    for (int i = 0; i < 10'000; ++i) {
      const Segment way = random_segment(sheet->box(), random);
      const auto side = [&](const Vector3& p) {
        if (sheet == shell) return p.norm() - 0.0500005;
        return sheet == flat ? p.z() - 5e-7 : p.z() - 0.005 * std::sin(60 * p.x()) * std::cos(60 * p.y());
      };
      const double before = side(way.start), after = side(way.start + way.step);
      if ((before > 0.0) == (after > 0.0) || std::abs(before) < 6e-7 || std::abs(after) < 6e-7) continue;
      ++crossings;
      const auto hit = first_hit_of(*sheet, way.start, way.step);
      ASSERT_TRUE(hit.has_value());
      ASSERT_NEAR(std::abs(side(hit->place.point)), 5e-7, 1e-9);
      ASSERT_GT(side(hit->place.point) * before, 0.0);
    }
    EXPECT_GT(crossings, 500);
  }
}

TEST(ImplicitSurface, SlidesAtTheGapWithoutEntering) {
  const double gap = 10 * kFieldSlack;
  const Surface plane = surface_of("3*z - x");
  const Vector3 normal = Vector3(-1, 0, 3).normalized();
  EXPECT_FALSE(
      plane->first_hit(0, gap * normal, 0.05 * Vector3(3, 0, 1).normalized(), false, 0.0, kFieldSlack));
  base::Random random(14);
  const Surface sphere = surface_of(kSphere);
  for (int i = 0; i < 2000; ++i) {
    const Vector3 up = random.direction();
    const Vector3 along = up.unitOrthogonal();
    EXPECT_FALSE(sphere->first_hit(0, (0.05 + gap) * up, 0.04 * along, false, 0.0, kFieldSlack));
  }
}

TEST(ImplicitSurface, CountsAStartWithinSlackAsInFront) {
  const Surface sphere = surface_of(kSphere);
  const Vector3 up = Vector3(1, 2, 3).normalized();
  for (const double height : {-0.9, 0.0, 0.9}) {
    const Vector3 start = (0.05 + height * kFieldSlack) * up;
    const auto moving_in = sphere->first_hit(0, start, -0.01 * up, false, 0.0, kFieldSlack);
    ASSERT_TRUE(moving_in.has_value()) << height;
    EXPECT_EQ(moving_in->t, 0.0);
    EXPECT_GT(moving_in->place.normal.dot(up), 0.999999);
    const auto slanted =
        sphere->first_hit(0, start, 0.01 * up.unitOrthogonal() - 0.001 * up, false, 0.0, kFieldSlack);
    ASSERT_TRUE(slanted.has_value()) << height;
    EXPECT_EQ(slanted->t, 0.0);
    EXPECT_FALSE(sphere->first_hit(0, start, 0.01 * up, false, 0.0, kFieldSlack)) << height;
    const auto from_behind = sphere->first_hit(0, start, 0.01 * up, true, 0.0, kFieldSlack);
    ASSERT_TRUE(from_behind.has_value()) << height;
    EXPECT_EQ(from_behind->t, 0.0);
    EXPECT_FALSE(sphere->first_hit(0, start, -0.01 * up, true, 0.0, kFieldSlack)) << height;
  }
  // Deeper, it is behind: through to the other side it only leaves.
  EXPECT_FALSE(sphere->first_hit(0, (0.05 - 3 * kFieldSlack) * up, -0.12 * up, false, 0.0, kFieldSlack));
  const auto leaves = sphere->first_hit(0, 0.04 * up, 0.04 * up, true, 0.0, kFieldSlack);
  ASSERT_TRUE(leaves.has_value());
  EXPECT_NEAR(leaves->t, 0.25, 1e-10);
}

TEST(ImplicitSurface, EntersAgainAfterMovingOut) {
  const Surface slabs = surface_of("cos(300*z)");
  const double slab = std::numbers::pi / 600;  // solid below -slab ... and between slab and 3 slab
  const auto hit = slabs->first_hit(0, {0, 0, -slab}, {0, 0, 4 * slab}, false, 0.0, kFieldSlack);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->t, 0.5, 1e-9);
}

TEST(ImplicitSurface, EntersTheSolidWhereTheFormulaBeginsToHaveValues) {
  const Surface half = surface_of("sqrt(x) - 1");  // solid for x >= 0, nothing for x < 0
  const auto hit = first_hit_of(*half, {-0.05, 0, 0}, {0.1, 0, 0});
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->t, 0.5, 1e-9);
  EXPECT_EQ(hit->place.normal, Vector3(-1, 0, 0));
  const Surface pole = surface_of("-1/x");  // solid for x > 0, its surface a pole
  const auto through = first_hit_of(*pole, {-0.05, 0.01, 0}, {0.1, 0, 0});
  ASSERT_TRUE(through.has_value());
  EXPECT_NEAR(through->t, 0.5, 1e-9);
  EXPECT_EQ(through->place.normal, Vector3(-1, 0, 0));
  const auto back = first_hit_of(*pole, {0.05, 0.01, 0}, {-0.1, 0, 0}, true);
  ASSERT_TRUE(back.has_value());
  EXPECT_NEAR(back->t, 0.5, 1e-9);
}

TEST(ImplicitSurface, AnswersEarlyWhenThereIsTooMuchToLookAt) {
  const Surface wild = surface_of("z - 0.001*sin(1e7*x)*sin(1e7*y + 1e9*x)");
  const auto hit = wild->first_hit(0, {-0.09, -0.08, 0.0015}, {0.18, 0.16, -0.002}, false, 0.0, kFieldSlack);
  ASSERT_TRUE(hit.has_value());
  EXPECT_LT(hit->t, 0.76);
  EXPECT_TRUE(hit->place.normal.allFinite());
}

TEST(ImplicitSurface, EntersThroughTheSidesOfTheBox) {
  const Surface waves = surface_of(kWaves);
  const auto floor = waves->first_hit(5, {0.01, 0.02, -0.2}, {0, 0, 0.2}, false, 0.0, kFieldSlack);
  ASSERT_TRUE(floor.has_value());
  EXPECT_NEAR(floor->t, 0.5, 1e-12);
  EXPECT_EQ(floor->place.piece, 5U);
  EXPECT_EQ(floor->place.point.z(), -0.1);
  EXPECT_EQ(floor->place.normal, Vector3(0, 0, -1));
  EXPECT_FALSE(waves->first_hit(6, {0.01, 0.02, 0.2}, {0, 0, -0.2}, false, 0.0, kFieldSlack));  // air above
  EXPECT_TRUE(waves->first_hit(2, {0.2, 0.0, -0.05}, {-0.2, 0, 0}, false, 0.0, kFieldSlack));
  EXPECT_FALSE(waves->first_hit(2, {0.2, 0.0, 0.05}, {-0.2, 0, 0}, false, 0.0, kFieldSlack));
  EXPECT_FALSE(waves->first_hit(2, {0.2, 0.0, -0.15}, {-0.2, 0, 0}, false, 0.0, kFieldSlack));  // beside it
  EXPECT_FALSE(waves->first_hit(2, {0.05, 0.0, -0.05}, {0.2, 0, 0}, false, 0.0, kFieldSlack));
  EXPECT_TRUE(waves->first_hit(2, {0.05, 0.0, -0.05}, {0.2, 0, 0}, true, 0.0, kFieldSlack));
  const auto resting =
      waves->first_hit(5, {0.01, 0.02, -0.1 + 0.5 * kFieldSlack}, {0, 0, 0.2}, false, 0.0, kFieldSlack);
  ASSERT_TRUE(resting.has_value());
  EXPECT_EQ(resting->t, 0.0);
}

TEST(ImplicitSurface, LeavesNoCrackBetweenFormulaAndSides) {
  // Whoever starts outside and ends inside has met some piece.
  base::Random random(15);
  for (const std::string& formula : {kWaves, kGyroid, std::string("x + 2*y + z - 0.1")}) {
    const Surface surface = surface_of(formula);
    const Bounds around = cube(0.15);
    int tried = 0;
    for (int i = 0; i < 20'000; ++i) {
      Vector3 start = random_in(around, random), end = random_in(surface->box(), random);
      if (i % 2 == 0) {  // aimed at an edge between a side and the formula's surface
        end.x() = 0.1 * (1 - 1e-9 * random.uniform());
        const auto down =
            surface->first_hit(0, {end.x(), end.y(), 0.1}, {0, 0, -0.2}, false, 0.0, kFieldSlack);
        if (!down) continue;
        end = down->place.point - 1e-11 * random.uniform() * down->place.normal;
      }
      if (surface->inside(start, 0.0) || !surface->inside(end, 0.0)) continue;
      ++tried;
      bool met = false;
      for (std::uint32_t piece = 0; piece <= 6 && !met; ++piece) {
        met = surface->first_hit(piece, start, end - start, false, 0.0, kFieldSlack).has_value();
      }
      ASSERT_TRUE(met || distance_to(*surface, end) < 2 * kFieldSlack) << formula << " segment " << i;
    }
    EXPECT_GT(tried, 1000) << formula;
  }
}

// ---- Feet --------------------------------------------------------------------------------------------

TEST(ImplicitSurface, WalksToTheNearestPlaceOfASphere) {
  const Surface sphere = surface_of(kSphere);
  base::Random random(16);
  for (int i = 0; i < 2000; ++i) {
    const Vector3 from = 0.05 * random.direction();
    const Vector3 goal = from + random.uniform(0.0, 0.04) * random.direction();
    const SurfacePlace foot = sphere->nearest_local({from, {}}, goal, 0.0);
    ASSERT_LT((foot.point - 0.05 * goal.normalized()).norm(), 1e-13) << i;
    ASSERT_LT((foot.normal - goal.normalized()).norm(), 1e-11) << i;
  }
  // Also all the way round.
  const SurfacePlace across = sphere->nearest_local({{0, 0, 0.05}, {}}, {0.001, 0.0, -0.03}, 0.0);
  EXPECT_LT((across.point - 0.05 * Vector3(0.001, 0, -0.03).normalized()).norm(), 1e-12);
}

TEST(ImplicitSurface, WalksToTheNearestPlaceOfATorus) {
  const Surface torus = surface_of(kTorus);
  base::Random random(17);
  for (int i = 0; i < 2000; ++i) {
    const double u = random.uniform(0, 6.283), v = random.uniform(0, 6.283);
    const Vector3 ring(std::cos(u), std::sin(u), 0);
    const Vector3 outwards = std::cos(v) * ring + std::sin(v) * Vector3::UnitZ();
    const Vector3 from = 0.05 * ring + 0.02 * outwards;
    const Vector3 goal = from + random.uniform(0.0, 0.015) * random.direction();
    const Vector3 core = 0.05 * Vector3(goal.x(), goal.y(), 0).normalized();
    const Vector3 expected = core + 0.02 * (goal - core).normalized();
    const SurfacePlace foot = torus->nearest_local({from, {}}, goal, 0.0);
    ASSERT_LT((foot.point - expected).norm(), 1e-12) << i;
  }
}

TEST(ImplicitSurface, StandsUprightUnderItsGoalOnEllipsoidGyroidAndWaves) {
  base::Random random(18);
  for (const std::string& formula : {kEllipsoid, kGyroid, kWaves}) {
    const Surface surface = surface_of(formula);
    int tried = 0;
    for (int i = 0; i < 3000; ++i) {
      const auto [start, step] = random_segment(surface->box(), random);
      const auto hit = surface->first_hit(0, start, step, false, 0.5, kFieldSlack);
      if (!hit) continue;
      ++tried;
      const Vector3 goal = hit->place.point + random.uniform(0.0, 0.008) * random.direction();
      const SurfacePlace foot = surface->nearest_local(hit->place, goal, 0.5);
      ASSERT_LT(distance_to(*surface, foot.point, 0.5), 0.1 * kFieldSlack) << formula << i;
      ASSERT_LE((foot.point - goal).norm(), (hit->place.point - goal).norm() * (1 + 1e-12)) << formula;
      const Vector3 pull = goal - foot.point;
      const Vector3 sideways = pull - pull.dot(foot.normal) * foot.normal;
      ASSERT_LT(sideways.norm(), 1e-10) << formula << i;
    }
    EXPECT_GT(tried, 50);
  }
}

TEST(ImplicitSurface, NeverWalksOntoAnotherSheet) {
  // Two sheets 1 mm and 2 um apart: the goal lies deep below both, the foot stays on the upper one.
  for (const double thickness : {1e-3, 2e-6}) {
    const Surface shell = surface_of("abs(z - 0.005*sin(60*x)) - " + std::to_string(thickness / 2));
    const double top = std::stod(std::to_string(thickness / 2));
    base::Random random(19);
    for (int i = 0; i < 300; ++i) {
      const double x = random.uniform(-0.08, 0.08);
      const Vector3 from(x, 0.0, 0.005 * std::sin(60 * x) + top);
      const Vector3 goal = from + Vector3(random.uniform(-0.01, 0.01), 0.01, -random.uniform(0.001, 0.01));
      const SurfacePlace foot = shell->nearest_local({from, {}}, goal, 0.0);
      const double height = foot.point.z() - 0.005 * std::sin(60 * foot.point.x());
      ASSERT_NEAR(height, top, 1e-3 * top) << i;
    }
  }
}

TEST(ImplicitSurface, FollowsAWaveThatHasMoved) {
  const Surface waves = surface_of(kWaves);
  SurfacePlace place{{0.01, 0.02, 0.0}, {}};
  place = waves->nearest_local(place, {0.01, 0.02, -0.02}, 0.0);
  for (int tick = 1; tick <= 500; ++tick) {
    const double time = 0.001 * tick;
    place = waves->nearest_local(place, {0.01, 0.02, -0.02}, time);
    ASSERT_LT(distance_to(*waves, place.point, time), 0.1 * kFieldSlack);
  }
  EXPECT_NEAR(place.point.x(), 0.01, 0.012);
}

TEST(ImplicitSurface, WalksOverTheSidesAsPlanes) {
  const Surface waves = surface_of(kWaves);
  const SurfacePlace foot = waves->nearest_local({{0.1, 0.0, -0.05}, {}, 2}, {0.09, 0.03, -0.2}, 0.0);
  EXPECT_EQ(foot.point, Vector3(0.1, 0.03, -0.2));
  EXPECT_EQ(foot.normal, Vector3(1, 0, 0));
  EXPECT_EQ(foot.piece, 2U);
  EXPECT_FALSE(waves->covers(foot, {}, 0.0, kFieldSlack));
}

TEST(ImplicitWalk, GoesAroundTheEdgesOfABox) {
  const Formula box = *Formula::parse("max(abs(x), abs(y), abs(z)) - 0.05");
  const ImplicitWalk walk(box, 0.0, 0.3);
  // On the top, dragged over the edge and down along the side.
  const auto down = walk.descend({0.03, 0.01, 0.05}, {0.045, 0.01, 0.02});
  EXPECT_NEAR(down.point.z(), 0.05, 1e-12);  // still above its goal on the top
  EXPECT_NEAR(down.point.x(), 0.045, 1e-12);
  const auto round = walk.descend({0.03, 0.01, 0.05}, {0.06, 0.01, 0.02});
  EXPECT_NEAR(round.point.x(), 0.05, 1e-12);
  EXPECT_NEAR(round.point.z(), 0.02, 1e-10);
  EXPECT_NEAR(round.point.y(), 0.01, 1e-10);
}

TEST(ImplicitWalk, RestsInTheGrooveBetweenTwoSpheres) {
  const Formula pair =
      *Formula::parse("min((x - 0.03)^2 + y^2 + z^2 - 0.05^2, (x + 0.03)^2 + y^2 + z^2 - 0.05^2)");
  // The groove is the circle x = 0, y^2 + z^2 = 0.04^2.
  const auto foot = ImplicitWalk(pair, 0.0, 0.3).descend({0.02, 0.0, 0.0489898}, {-0.001, 0.01, 0.01});
  const Vector3 expected(0.0, 0.04 * std::sqrt(0.5), 0.04 * std::sqrt(0.5));
  EXPECT_LT((foot.point - expected).norm(), 1e-6) << foot.point.transpose();
}

// ---- Ways out, covering, boxes, scale, samples -------------------------------------------------------

TEST(ImplicitSurface, LeadsOutOfTheSolid) {
  base::Random random(20);
  const Surface sphere = surface_of(kSphere), torus = surface_of(kTorus), waves = surface_of(kWaves);
  int tried = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3 p = random_in(cube(0.1), random);
    EXPECT_EQ(sphere->way_out(p, 0.0).has_value(), sphere->inside(p));
    if (sphere->inside(p)) {
      const auto out = sphere->way_out(p, 0.0);
      ASSERT_NEAR((out->point - p).norm(), 0.05 - p.norm(), 1e-12);
    }
    if (torus->inside(p)) {
      ++tried;
      const auto out = torus->way_out(p, 0.0);
      const double off_core = std::hypot(std::hypot(p.x(), p.y()) - 0.05, p.z());
      ASSERT_TRUE(out.has_value());
      ASSERT_NEAR((out->point - p).norm(), 0.02 - off_core, 1e-12);
    }
  }
  EXPECT_GT(tried, 100);
  const auto floor = waves->way_out({0.02, 0.01, -0.097}, 0.0);
  ASSERT_TRUE(floor.has_value());
  EXPECT_EQ(floor->piece, 5U);
  EXPECT_NEAR(floor->point.z(), -0.1, 1e-15);
  const auto centre = sphere->way_out(Vector3::Zero(), 0.0);
  ASSERT_TRUE(centre.has_value());
  EXPECT_NEAR(centre->point.norm(), 0.05, 1e-9);
}

TEST(ImplicitSurface, CoversItsPiecesToTheirCommonEdges) {
  const Surface waves = surface_of("z");
  EXPECT_TRUE(waves->covers({{0.1, 0.0, 0.0}, Vector3::UnitZ()}, {}, 0.0, kFieldSlack));
  EXPECT_TRUE(waves->covers({{0.1 + 0.9 * kFieldSlack, 0.0, 0.0}, Vector3::UnitZ()}, {}, 0.0, kFieldSlack));
  EXPECT_FALSE(waves->covers({{0.1 + 2 * kFieldSlack, 0.0, 0.0}, Vector3::UnitZ()}, {}, 0.0, kFieldSlack));
  EXPECT_TRUE(waves->covers({{0.1, 0.0, 0.9 * kFieldSlack}, Vector3::UnitX(), 2}, {}, 0.0, kFieldSlack));
  EXPECT_FALSE(waves->covers({{0.1, 0.0, 2 * kFieldSlack}, Vector3::UnitX(), 2}, {}, 0.0, kFieldSlack));
}

TEST(ImplicitSurface, NamesEveryPieceThatIsNear) {
  base::Random random(21);
  for (const std::string& formula : {kSphere, kGyroid, kWaves}) {
    const Surface surface = surface_of(formula);
    for (int i = 0; i < 2000; ++i) {
      const auto [start, step] = random_segment(surface->box(), random);
      const double time = random.uniform(-5.0, 5.0);
      const auto hit = surface->first_hit(0, start, step, false, time, kFieldSlack);
      if (!hit) continue;
      bool named = false;
      surface->near(start, start + step, kFieldSlack, time, [&](std::uint32_t piece, const Bounds& box) {
        named |= piece == 0 && box.exteriorDistance(hit->place.point) <= kFieldSlack;
        return !named;
      });
      ASSERT_TRUE(named) << formula;
    }
  }
  int visits = 0;
  const Surface sphere = surface_of(kSphere);
  sphere->near({0.09, 0.09, 0.09}, {0.091, 0.09, 0.09}, 0.001, 0.0, [&](std::uint32_t, const Bounds&) {
    ++visits;
    return true;
  });
  EXPECT_EQ(visits, 0);
  std::vector<std::uint32_t> sides;
  surface_of(kWaves)->near({0, 0, -0.11}, {0, 0, -0.09}, 0.001, 0.0, [&](std::uint32_t piece, const Bounds&) {
    sides.push_back(piece);
    return true;
  });
  EXPECT_EQ(sides, std::vector<std::uint32_t>{5});
}

TEST(ImplicitSurface, AnswersAlikeInMetresAndMillimetres) {
  const Surface metres = surface_of("x^2/0.0064 + y^2/0.0025 + z^2/0.0016 - 1", cube(0.125));
  const Surface millimetres = surface_of("x^2/6400 + y^2/2500 + z^2/1600 - 1", cube(125));
  base::Random random(22);
  for (int i = 0; i < 2000; ++i) {
    const auto [start, step] = random_segment(cube(0.125), random);
    const auto one = metres->first_hit(0, start, step, false, 0.0, kFieldSlack);
    const auto other = millimetres->first_hit(0, 1000 * start, 1000 * step, false, 0.0, 1000 * kFieldSlack);
    ASSERT_EQ(one.has_value(), other.has_value());
    if (!one) continue;
    ASSERT_NEAR(one->t * step.norm(), other->t * step.norm(), 1e-11);
    const Vector3 goal = 0.9 * one->place.point + Vector3(0.001, 0.002, 0.003);
    const SurfacePlace foot = metres->nearest_local(one->place, goal, 0.0);
    const SurfacePlace other_foot = millimetres->nearest_local(other->place, 1000 * goal, 0.0);
    ASSERT_LT((foot.point - other_foot.point / 1000).norm(), 1e-12);
  }
}

TEST(ImplicitSurface, SurvivesPlacesWhereTheFormulaHasNoGradient) {
  for (const char* formula :
       {"x^2 + y^2 - z^2", "sqrt(x^2 + y^2) + z", "x*y*z", "abs(x) - abs(y)", "1/x + y", "log(x) + y",
        "tan(100*x) - z", "atan2(y, x) - 1", "x^3", "(x + y)^(1/3) - z"}) {
    const Surface surface = surface_of(formula);
    base::Random random(23);
    for (int i = 0; i < 200; ++i) {
      auto [start, step] = random_segment(surface->box(), random);
      if (i % 4 == 0) step = -start;
      const auto hit = surface->first_hit(0, start, step, i % 2 == 0, 0.0, kFieldSlack);
      const SurfacePlace from = hit ? hit->place : SurfacePlace{Vector3::Zero(), Vector3::UnitZ()};
      const SurfacePlace foot = surface->nearest_local(from, random_in(surface->box(), random), 0.0);
      ASSERT_TRUE(foot.point.allFinite() && foot.normal.allFinite()) << formula;
      ASSERT_NEAR(foot.normal.norm(), 1.0, 1e-9) << formula;
      (void)surface->way_out(start, 0.0);
    }
  }
}

TEST(ImplicitSurface, SurvivesArgumentsThatAreNoNumbers) {
  const Surface sphere = surface_of(kSphere);
  const Vector3 nothing = Vector3::Constant(std::nan("")), good(0, 0, 0.06);
  EXPECT_FALSE(sphere->first_hit(0, nothing, good, false, 0.0, kFieldSlack));
  EXPECT_FALSE(sphere->first_hit(0, good, nothing, false, 0.0, kFieldSlack));
  EXPECT_FALSE(sphere->first_hit(0, good, Vector3::Zero(), false, 0.0, kFieldSlack));
  EXPECT_FALSE(sphere->first_hit(3, nothing, good, false, 0.0, kFieldSlack));
  EXPECT_FALSE(sphere->inside(nothing));
  EXPECT_FALSE(sphere->way_out(nothing, 0.0));
  (void)sphere->nearest_local({good, {}}, nothing, 0.0);
  (void)surface_of(kWaves)->first_hit(0, good, -good, false, std::nan(""), kFieldSlack);
}

TEST(ImplicitSurface, CanBeSampledForMeshing) {
  const Surface surface =
      surface_of("x^2 + y^2 + z^2 - 0.05^2", {Vector3(-0.1, -0.1, 0.0), Vector3(0.1, 0.1, 0.1)});
  const SampledSolid half_ball = sampled(*surface, 0.0);
  EXPECT_TRUE(half_ball.inside({0, 0, 0.01}));
  EXPECT_FALSE(half_ball.inside({0, 0, -0.01}));
  base::Random random(24);
  int crossed = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3 in = random_in(cube(0.05), random), out = random_in(cube(0.1), random);
    if (!half_ball.inside(in) || half_ball.inside(out)) continue;
    ++crossed;
    const SurfacePoint at = half_ball.crossing(out, in);
    if (at.normal == Vector3(0, 0, -1)) {
      ASSERT_NEAR(at.point.z(), 0.0, 1e-14);
      ASSERT_LE(at.point.norm(), 0.05 + 1e-14);
    } else {
      ASSERT_NEAR(at.point.norm(), 0.05, 1e-14);
      ASSERT_LT((at.normal - at.point.normalized()).norm(), 1e-12);
      ASSERT_GE(at.point.z(), -1e-14);
    }
  }
  EXPECT_GT(crossed, 50);
}

}  // namespace
}  // namespace implicit_surface_test
}  // namespace icome::geometry
