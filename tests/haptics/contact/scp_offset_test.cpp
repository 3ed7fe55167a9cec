// Sphere tips on CSG solids: their centre against distances in closed form, against points sampled all over
// the surface, and against the tree itself.
#include <gtest/gtest.h>

#include "geometry/csg/csg_offset.h"
#include "haptics/csg_touch.h"
#include "repeats.h"

namespace icome::haptics {
namespace {

using geometry::CsgOffset;

std::shared_ptr<const Shape> centres_of(const CsgTree& tree, double radius) {
  const auto centres = CsgOffset::create(tree, radius);
  EXPECT_TRUE(centres) << (centres ? "" : centres.error().message);
  return std::make_shared<SmoothShape>(*centres, radius);
}

/// A solver with the program's own budget.
struct SphereToucher {
  SphereToucher(const CsgTree& tree, double radius)
      : scene(HapticScene::compile({object(1, centres_of(tree, radius))})), solver({.tip_radius = radius}) {
    solver.adopt(*scene, {});
  }
  const ScpState& step(const Vector3& tip) { return solver.step(tip, 0.0); }

  ScenePointer scene;
  ScpSolver solver;
};

/// How a tip goes on: to random places around and in the solid, at 0.01 to 5 m/s.
std::vector<Vector3> wandering(std::uint64_t seed, std::size_t ticks, double reach) {
  Random random(seed);
  std::vector<Vector3> path{Vector3(0.0, 0.0, 1.5 * reach)};
  while (path.size() < ticks) {
    const Vector3 from = path.back();
    const Vector3 to = reach * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const double step = 1e-3 * std::pow(10.0, random.uniform(-2.0, 0.7));
    const int count = std::min(150, 1 + int((to - from).norm() / step));
    for (int i = 1; i <= count; ++i)
      path.push_back(from + std::min(1.0, i * step / (to - from).norm()) * (to - from));
  }
  return path;
}

/// Holds the centre at the distance of the radius, or free, where the distance to the solid is known in
/// closed form; how many ticks were in touch. `most_on_the_way`: ticks until an SCP that could not go all its
/// way in one has caught up.
template <typename Distance>
std::size_t expect_at_distance(const CsgTree& tree, double radius, std::uint64_t seed, double reach,
                               Distance&& distance, int most_on_the_way = 0) {
  SphereToucher toucher(tree, radius);
  std::size_t touching = 0;
  int on_the_way = 0;
  for (const Vector3& tip : wandering(seed, std::size_t(std::max(1500, repeats(3000))), reach)) {
    const ScpState& state = toucher.step(tip);
    const double apart = distance(state.scp) - radius;
    EXPECT_GT(apart, -1e-9) << tip.transpose();
    on_the_way = state.converged ? 0 : on_the_way + 1;
    EXPECT_LE(on_the_way, most_on_the_way) << tip.transpose();
    EXPECT_TRUE(state.touching ? apart < 1e-8 : state.scp == tip) << apart << " " << tip.transpose();
    touching += state.touching;
    if (testing::Test::HasFailure()) break;
  }
  return touching;
}

double rectangle_distance(double x, double y) {
  return std::hypot(std::max(x, 0.0), std::max(y, 0.0)) + std::min(std::max(x, y), 0.0);
}

class SphereTips : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Radii, SphereTips, testing::Values(1e-4, 1e-3, 5e-3, 1e-2),
                         [](const auto& it) { return std::to_string(int(1e6 * it.param)) + "um"; });

TEST_P(SphereTips, RollOverTheEdgesAndCornersOfABox) {
  const Vector3 half(0.02, 0.015, 0.01);
  const CsgTree tree = TreeChain(box_shape(0.04, 0.03, 0.02)).tree();
  const auto distance = [&](const Vector3& p) {
    const Vector3 over = p.cwiseAbs() - half;
    return over.cwiseMax(0.0).norm() + std::min(over.maxCoeff(), 0.0);
  };
  EXPECT_GT(expect_at_distance(tree, GetParam(), 1, 0.03, distance), 500u / kSanitizerShare);
}

TEST_P(SphereTips, RestInTheGrooveBetweenTwoBalls) {
  const Vector3 aside(0.012, 0.0, 0.0);
  const CsgTree tree =
      TreeChain(ball_shape(0.02), moved(0.012, 0, 0)).unite(ball_shape(0.02), moved(-0.012, 0, 0)).tree();
  const auto distance = [&](const Vector3& p) {
    return std::min((p - aside).norm(), (p + aside).norm()) - 0.02;
  };
  EXPECT_GT(expect_at_distance(tree, GetParam(), 2, 0.035, distance), 500u / kSanitizerShare);
}

// A plate drilled along z, so wide that its rim is out of reach: a rectangle in the half-plane beside the
// axis. Tips wider than the hole rest on its edge.
TEST_P(SphereTips, RollRoundTheEdgeOfAHole) {
  const double hole = 0.004, thick = 0.006;
  const CsgTree tree = TreeChain(box_shape(0.3, 0.3, thick)).cut(rod_shape(hole, 0.02)).tree();
  const auto distance = [&](const Vector3& p) {
    return rectangle_distance(hole - std::hypot(p.x(), p.y()), std::abs(p.z()) - 0.5 * thick);
  };
  // A ball wider than the hole touches nearly all of its rim at once when it lies on the axis.
  const int most_on_the_way = GetParam() > hole ? 5 : 0;
  EXPECT_GT(expect_at_distance(tree, GetParam(), 3, 0.012, distance, most_on_the_way),
            500u / kSanitizerShare);
}

// What is left of a ball when another is taken away: in the half-plane through both centres it is bounded by
// two arcs that meet in a sharp edge.
TEST_P(SphereTips, RollRoundTheRimOfABowl) {
  const double outer = 0.02, inner = 0.015, apart = 0.016;
  const CsgTree tree = TreeChain(ball_shape(outer)).cut(ball_shape(inner), moved(0, 0, apart)).tree();
  const double rim_z = (outer * outer - inner * inner + apart * apart) / (2.0 * apart);
  const base::Vector2 rim(std::sqrt(outer * outer - rim_z * rim_z), rim_z);
  const auto distance = [&](const Vector3& p) {
    const base::Vector2 at(std::hypot(p.x(), p.y()), p.z());
    double least = (at - rim).norm();
    const base::Vector2 on_outer = outer * at.normalized();
    if (on_outer.y() <= rim.y()) least = std::min(least, std::abs(at.norm() - outer));
    const base::Vector2 arm = at - base::Vector2(0.0, apart);
    const base::Vector2 on_inner = base::Vector2(0.0, apart) + inner * arm.normalized();
    if (on_inner.norm() <= outer) least = std::min(least, std::abs(arm.norm() - inner));
    return at.norm() < outer && arm.norm() > inner ? -least : least;
  };
  EXPECT_GT(expect_at_distance(tree, GetParam(), 4, 0.03, distance), 500u / kSanitizerShare);
}

TEST(ScpOfSphereTips, StaysOutOfAHoleAndASlitThatAreNarrower) {
  const CsgTree plate = TreeChain(box_shape(0.1, 0.1, 0.02))
                            .cut(rod_shape(0.004, 0.05), moved(-0.02, 0, 0))
                            .cut(box_shape(0.008, 0.06, 0.05), moved(0.02, 0, 0))
                            .tree();
  const double radius = 0.005, rests = 0.01 + 0.003;  // 3, 4, 5
  for (const double x : {-0.02, 0.02}) {
    SphereToucher toucher(plate, radius);
    toucher.step({x, 0.0, 0.03});
    for (int i = 1; i <= 40; ++i) {
      const ScpState& state = toucher.step({x, 0.0, 0.03 - 0.0015 * i});
      EXPECT_GE(state.scp.z(), rests - 1e-9);
      if (i < 40) continue;
      EXPECT_LT((state.scp - Vector3(x, 0.0, rests)).norm(), 1e-6) << state.scp.transpose();
    }
  }
}

// ---- Points all over the surface of two crossed cylinders, by their equations

TEST(ScpOfSphereTips, KeepsItsRadiusFromEveryPlaceOfCrossedCylinders) {
  const double thick = 0.015, thin = 0.01, half = 0.03;
  const CsgTree tree = TreeChain(rod_shape(thick, 2 * half))
                           .unite(rod_shape(thin, 2 * half), turned(1.5707963267948966, Vector3::UnitX()))
                           .cut(rod_shape(0.006, 0.1), turned(1.5707963267948966, Vector3::UnitY()))
                           .tree();
  const BruteSolid solid(tree);
  std::vector<Vector3> places;
  Random random(11);
  while (places.size() < 100'000) {
    const double angle = random.uniform(0.0, 6.283185307179586), along = random.uniform(-half, half);
    const Vector3 round(std::cos(angle), std::sin(angle), 0.0);
    const double shrunk = std::sqrt(random.uniform(0.0, 1.0));
    const std::array<Vector3, 5> candidates{
        thick * round + along * Vector3::UnitZ(), Vector3(thin * round.x(), along, thin * round.y()),
        Vector3(along, 0.006 * round.x(), 0.006 * round.y()),
        shrunk * thick * round + (along > 0.0 ? half : -half) * Vector3::UnitZ(),
        Vector3(shrunk * thin * round.x(), along > 0.0 ? half : -half, shrunk * thin * round.y())};
    for (const Vector3& it : candidates) {
      if (std::abs(solid.bound(it)) < 1e-12) places.push_back(it);
    }
  }
  for (const double radius : {5e-4, 2e-3, 8e-3}) {
    SphereToucher toucher(tree, radius);
    std::size_t touching = 0;
    for (const Vector3& tip : wandering(12, std::size_t(std::max(200, repeats(400))), 0.04)) {
      const ScpState& state = toucher.step(tip);
      if (!state.touching) continue;
      ++touching;
      double least = 1.0;
      for (const Vector3& place : places) least = std::min(least, (place - state.scp).squaredNorm());
      least = std::sqrt(least);
      // The nearest place is some 0.2 mm from a sampled one.
      ASSERT_GT(least, radius - 1e-9);
      ASSERT_LT(least, radius + 0.5 * std::pow(4e-4, 2) / radius + 1e-4);
    }
    EXPECT_GT(touching, 20u / kSanitizerShare);
  }
}

// ---- Random and nasty trees, by dividing space

/// Is some of the solid nearer to the place than `reach`? Parts smaller than `finest` may be overlooked.
bool solid_within(const BruteSolid& whole, const Vector3& place, double reach, double finest) {
  const BruteSolid solid = whole.near(place, 1.001 * reach);
  struct Cell {
    Vector3 middle;
    double half;
  };
  std::vector<Cell> open{{place, reach}};
  while (!open.empty()) {
    const Cell cell = open.back();
    open.pop_back();
    const Vector3 over = ((cell.middle - place).cwiseAbs() - Vector3::Constant(cell.half)).cwiseMax(0.0);
    if (over.norm() >= reach) continue;
    const double bound = solid.bound(cell.middle), corner = std::sqrt(3.0) * cell.half;
    if (bound > corner) continue;
    if (bound < -corner || (bound <= 0.0 && (cell.middle - place).norm() < reach)) return true;
    for (int i = 0; i < 8 && cell.half > finest; ++i) {
      const double half = 0.5 * cell.half;
      open.push_back({cell.middle + half * Vector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1), half});
    }
  }
  return false;
}

/// A tree of every kind, and some random ones; not those with very many leaves.
std::vector<NamedTree> rolled_trees() {
  std::vector<NamedTree> trees = nasty_trees();
  for (const std::size_t primitives : {3, 4, 6}) {
    for (std::uint64_t seed = 0; seed < 6; ++seed)
      trees.push_back({"Random" + std::to_string(primitives) + "of" + std::to_string(seed),
                       random_tree(seed, primitives)});
  }
  std::erase_if(trees, [](const NamedTree& it) { return BruteSolid(it.tree).leaves() > 60; });
  return trees;
}

/// Does some straight way on lead clearly nearer to the tip without touching?
bool finds_a_free_way(const BruteSolid& solid, const Vector3& centre, double radius, const Vector3& pull,
                      Random& random) {
  for (int i = 0; i < 6; ++i) {
    const Vector3 way = random.direction();
    if (way.dot(pull) < 0.15 * pull.norm()) continue;
    bool free = true;
    for (const double share : {1.0, 0.6, 0.3, 0.1, 0.03})
      free = free && !solid_within(solid, centre + share * 2e-4 * way, radius + 2e-7, 2e-5);
    if (free) return true;
  }
  return false;
}

TEST(ScpOfSphereTips, NeitherOverlapsNorSticksOnManyTrees) {
  std::size_t touching = 0, trees = 0, looked = 0, stuck = 0;
  const std::size_t every = kSanitizerShare > 1 ? 4 : 1;  // looked through
  std::size_t which = 0;
  for (const NamedTree& it : rolled_trees()) {
    if (which++ % every != 0) continue;
    SCOPED_TRACE(it.name);
    const double radius = std::array<double, 3>{2e-3, 3e-4, 5e-3}[trees % 3];
    if (!CsgOffset::create(it.tree, radius)) continue;  // stretched
    const BruteSolid solid(it.tree);
    SphereToucher toucher(it.tree, radius);
    Random random(13);
    ++trees;
    int tick = 0;
    for (const Vector3& tip : random_touch(solid, 7, std::size_t(std::max(100, repeats(300))))) {
      const ScpState& state = toucher.step(tip);
      ASSERT_FALSE(solid.inside(state.scp)) << tick;
      ASSERT_TRUE(state.touching || state.scp == tip);
      touching += state.touching;
      if (++tick % 30 != 0) continue;
      ASSERT_FALSE(solid_within(solid, state.scp, radius - 1e-5, 4e-5)) << tick;
      const Vector3 pull = tip - state.scp;
      if (tick % 60 != 0 || !state.touching || !state.converged || pull.norm() < 4e-4) continue;
      ++looked;
      stuck += finds_a_free_way(solid, state.scp, radius, pull, random);
    }
  }
  EXPECT_GT(trees, 25u / every);
  EXPECT_GT(touching, 3000u / kSanitizerShare);
  EXPECT_LE(stuck, looked / 50);
}

TEST(ScpOfSphereTips, ComesOutWhereItOverlapsAtTheStart) {
  const CsgTree tree = TreeChain(box_shape(0.06, 0.06, 0.02))
                           .unite(ball_shape(0.015), moved(0.0, 0.0, 0.02))
                           .cut(rod_shape(0.005, 0.1), moved(0.02, 0.02, 0.0))
                           .tree();
  const BruteSolid solid(tree);
  Random random(14);
  for (int i = 0; i < repeats(100); ++i) {
    const double radius = random.uniform(0.001, 0.006);
    SphereToucher toucher(tree, radius);
    const Vector3 tip = 0.035 * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const ScpState& state = toucher.step(tip);
    EXPECT_FALSE(solid_within(solid, state.scp, radius - 1e-6, 2e-5)) << tip.transpose();
    EXPECT_EQ(state.started_inside, solid_within(solid, tip, radius, 2e-6)) << tip.transpose();
  }
}

TEST(ScpOfSphereTips, AreToldWhyThereIsNoExactSurface) {
  const auto reason = [](const CsgTree& tree) {
    const auto made = CsgOffset::create(tree, 0.002);
    return made ? std::string() : made.error().message;
  };
  EXPECT_EQ(reason(TreeChain(ball_shape(0.02), stretched(1, 1, 2)).tree()),
            "curved primitives are stretched");
  EXPECT_EQ(reason(TreeChain(ring_shape(0.005, 0.0035)).tree()),
            "the hole of a torus is too narrow for the tip");
  EXPECT_EQ(reason(TreeChain(box_shape(0.02, 0.02, 0.02), stretched(1, 1, 2)).tree()), "");
}

}  // namespace
}  // namespace icome::haptics
