// Sphere tips on the solids of formulas: their centre against distances in closed form, and against grids on
// the surface that zoom in on the nearest place.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "base/random.h"
#include "geometry/implicit/implicit_offset.h"
#include "haptics/contact/scp_solver.h"
#include "haptics/judge/contact_judge.h"
#include "haptics/judge/plain_field.h"
#include "haptics/shapes/smooth_shape.h"
#include "repeats.h"

namespace icome::haptics {
namespace {

using geometry::ImplicitOffset;
using OffsetDistance = std::function<double(const Vector3& point, double time)>;

Bounds offset_box() { return {Vector3(-0.06, -0.06, -0.03), Vector3(0.06, 0.06, 0.03)}; }

/// To random places around and in the box, at 0.01 to 5 m/s.
std::vector<Vector3> offset_path(std::uint64_t seed, std::size_t ticks) {
  base::Random random(seed);
  std::vector<Vector3> path{Vector3(0.0, 0.0, 0.06)};
  while (path.size() < ticks) {
    const Vector3 from = path.back();
    const Vector3 to = 0.055 * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const double step = 1e-3 * std::pow(10.0, path.size() == 1 ? 0.7 : random.uniform(-2.0, 0.7));
    const int count = std::min(60, 1 + int((to - from).norm() / step));
    for (int i = 1; i <= count; ++i)
      path.push_back(from + std::min(1.0, i * step / (to - from).norm()) * (to - from));
  }
  return path;
}

/// Holds the centre at the distance of the radius where it touches, and never nearer.
void expect_centre_at_distance(const std::string& formula, double radius, std::uint64_t seed,
                               std::size_t ticks, double doubt, const OffsetDistance& distance) {
  const auto centres = ImplicitOffset::create(formula, offset_box(), radius);
  ASSERT_TRUE(centres) << formula << ": " << centres.error().message;
  HapticObject object;
  object.id = {1, 0};
  object.shape = std::make_shared<SmoothShape>(*centres, radius);
  const auto scene = HapticScene::compile({object});
  ScpSolver solver({.tip_radius = radius});
  solver.adopt(*scene, {});
  std::size_t touching = 0;
  double time = 0.0;
  for (const Vector3& tip : offset_path(seed, ticks)) {
    const ScpState& state = solver.step(tip, time);
    const double apart = distance(state.scp, time) - radius;
    ASSERT_GT(apart, -doubt) << formula << " " << radius << " at " << time << ": " << tip.transpose();
    ASSERT_TRUE(state.touching ? apart < 10.0 * doubt : state.scp == tip) << apart << " " << tip.transpose();
    touching += state.touching;
    time += 1e-3;
  }
  EXPECT_GT(touching, ticks / 60) << formula;
}

double box_distance(const Vector3& over) {
  return over.cwiseMax(0.0).norm() + std::min(over.maxCoeff(), 0.0);
}

class FormulaTips : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Radii, FormulaTips, testing::Values(1e-4, 1e-3, 5e-3, 1e-2),
                         [](const auto& it) { return std::to_string(int(1e6 * it.param)) + "um"; });

TEST_P(FormulaTips, RollRoundABall) {
  expect_centre_at_distance("x^2 + y^2 + z^2 - 0.025^2", GetParam(), 1, 1500, 1e-9,
                            [](const Vector3& p, double) { return p.norm() - 0.025; });
}

TEST_P(FormulaTips, RollRoundAndThroughARing) {
  expect_centre_at_distance(
      "(sqrt(x^2 + y^2) - 0.035)^2 + z^2 - 0.015^2", std::min(GetParam(), 5e-3), 2, 1500, 1e-9,
      [](const Vector3& p, double) { return std::hypot(std::hypot(p.x(), p.y()) - 0.035, p.z()) - 0.015; });
}

TEST_P(FormulaTips, RollOverTheRimWhereTheBoxCutsACylinder) {
  expect_centre_at_distance("x^2 + y^2 - 0.03^2", GetParam(), 3, 1500, 1e-9, [](const Vector3& p, double) {
    return box_distance({std::hypot(p.x(), p.y()) - 0.03, std::abs(p.z()) - 0.03, -1.0});
  });
}

TEST_P(FormulaTips, RollOverTheEdgesAndCornersThatMaxAndAbsMake) {
  expect_centre_at_distance(
      "max(abs(x) - 0.03, max(abs(y) - 0.02, abs(z) - 0.01))", GetParam(), 4, 1500, 1e-9,
      [](const Vector3& p, double) { return box_distance(p.cwiseAbs() - Vector3(0.03, 0.02, 0.01)); });
}

TEST_P(FormulaTips, RestInTheGrooveThatMinMakes) {
  expect_centre_at_distance("min((x + 0.012)^2 + y^2 + z^2 - 0.02^2, (x - 0.012)^2 + y^2 + z^2 - 0.02^2)",
                            GetParam(), 5, 1500, 1e-9, [](const Vector3& p, double) {
                              const Vector3 aside(0.012, 0.0, 0.0);
                              return std::min((p - aside).norm(), (p + aside).norm()) - 0.02;
                            });
}

/// To the solid below z = height(x, y) in the box, by grids that zoom in on the nearest place. Of what is in
/// the column below a place, the nearest is as high as the point, or the top.
double distance_to_ground(const std::function<double(double, double)>& height, const Vector3& point,
                          double wide) {
  const Bounds box = offset_box();
  double least = std::numeric_limits<double>::infinity();
  Vector3 middle = point;
  for (int level = 0; level < 8; ++level, wide *= 0.12) {
    const int across = level == 0 ? 40 : 12;
    const Vector3 from = middle;
    for (int i = -across; i <= across; ++i) {
      for (int j = -across; j <= across; ++j) {
        const double x = std::clamp(from.x() + wide * i / across, box.min().x(), box.max().x());
        const double y = std::clamp(from.y() + wide * j / across, box.min().y(), box.max().y());
        const double top = std::min(height(x, y), box.max().z());
        if (top < box.min().z()) continue;
        const Vector3 place(x, y, std::clamp(point.z(), box.min().z(), top));
        if ((place - point).norm() >= least) continue;
        least = (place - point).norm();
        middle = place;
      }
    }
  }
  return least;
}

TEST_P(FormulaTips, FeelWavesValleysAndRidges) {
  const double radius = GetParam();
  const auto ground = [&](const std::string& formula, std::uint64_t seed, auto&& height) {
    expect_centre_at_distance(formula, radius, seed, 500, 1e-8, [&](const Vector3& p, double time) {
      return distance_to_ground([&](double x, double y) { return height(x, y, time); }, p, 2.5 * radius);
    });
  };
  ground("z - 0.01*sin(50*x)", 6, [](double x, double, double) { return 0.01 * std::sin(50.0 * x); });
  ground("z - max(x, -2*x)", 7, [](double x, double, double) { return std::max(x, -2.0 * x); });
  ground("z + abs(x) + 0.01*sin(60*y)", 8,
         [](double x, double y, double) { return -std::abs(x) - 0.01 * std::sin(60.0 * y); });
  ground("z - 0.01*sin(50*x + 4*t)", 9,
         [](double x, double, double t) { return 0.01 * std::sin(50.0 * x + 4.0 * t); });
}

// In a hollow of a radius of 3.7 mm a ball of 10 mm rests on two flanks.
// The tip stands still, or gives way more slowly than the ground comes up.
TEST_P(FormulaTips, AreLiftedByGroundThatRisesUnderThem) {
  const double radius = GetParam();
  const auto centres = ImplicitOffset::create("z - 0.02*t + 0.015", offset_box(), radius);
  ASSERT_TRUE(centres) << centres.error().message;
  HapticObject object;
  object.id = {1, 0};
  object.shape = std::make_shared<SmoothShape>(*centres, radius);
  const auto scene = HapticScene::compile({object});
  for (const double speed : {0.0, 0.005}) {
    ScpSolver solver({.tip_radius = radius});
    solver.adopt(*scene, {});
    int touching = 0;
    for (int tick = 0; tick < 2000; ++tick) {
      const double time = 1e-3 * tick;
      const Vector3 tip(0.01 + speed * time, 0.0, 0.002 + speed * time);
      const ScpState& state = solver.step(tip, time);
      const double lowest = 0.02 * time - 0.015 + radius;
      ASSERT_NEAR(state.scp.z(), std::max(tip.z(), lowest), 1e-8) << tick;
      touching += state.touching;
    }
    EXPECT_GT(touching, 200);
  }
}

TEST(ScpOfFormulaTips, RestsOnTheFlanksOfAHollowThatIsNarrower) {
  expect_centre_at_distance("z - 0.003*sin(300*x)", 5e-3, 10, 170, 2e-8, [](const Vector3& p, double) {
    return distance_to_ground([](double x, double) { return 0.003 * std::sin(300.0 * x); }, p, 0.012);
  });
}

// Resting on both flanks, it goes along the hollow as the tip does, and rises out of it.
TEST(ScpOfFormulaTips, FollowsAHollowThatIsNarrower) {
  const double radius = 0.01;
  const auto centres = ImplicitOffset::create("z - 0.003*sin(300*x)", offset_box(), radius);
  ASSERT_TRUE(centres) << centres.error().message;
  HapticObject object;
  object.id = {1, 0};
  object.shape = std::make_shared<SmoothShape>(*centres, radius);
  const auto scene = HapticScene::compile({object});
  ScpSolver solver({.tip_radius = radius});
  solver.adopt(*scene, {});
  const double hollow = -std::numbers::pi / 600.0;
  for (int tick = 0; tick < 400; ++tick) {
    const double height = tick < 100 ? 0.015 - 1e-4 * tick : 0.005;
    const Vector3 tip(hollow + 1e-5 * std::sin(0.1 * tick), -0.03 + 1e-4 * std::max(0, tick - 100), height);
    const ScpState& state = solver.step(tip, 0.0);
    if (!state.touching) continue;
    ASSERT_NEAR(state.scp.x(), hollow, 1e-6) << tick;
    ASSERT_NEAR(state.scp.y(), tip.y(), 1e-6) << tick;
    ASSERT_LT(state.iterations, 40) << tick;
  }
  EXPECT_TRUE(solver.step(Vector3(hollow, 0.0, 0.005), 0.0).touching);
}

TEST(ScpOfFormulaTips, SaysWhyASurfaceIsNotTakenApart) {
  const auto reason = [](const std::string& formula) {
    const auto centres = ImplicitOffset::create(formula, offset_box(), 1e-3);
    return centres ? std::string() : centres.error().message;
  };
  EXPECT_NE(reason("1/x").find("a pole"), std::string::npos);
  EXPECT_NE(reason("x^2 + y^2 - z^2").find("comes to a point"), std::string::npos);
  EXPECT_FALSE(reason("z - 0.001*sin(20000*x)").empty());
}

// The judge's own search: the nearest place of a solid that is known by its values only.
TEST(PlainField, FindsTheNearestPlaceOfASolid) {
  const MembershipSolid ball = plain_solid(
      [](const Vector3& p, double time) { return p.squaredNorm() - 4e-4 - 1e-4 * time; }, offset_box());
  base::Random random(3);
  for (int i = 0; i < 60; ++i) {
    const double time = random.uniform(0.0, 1.0), size = std::sqrt(4e-4 + 1e-4 * time);
    const Vector3 point = (size + random.uniform(1e-4, 4e-3)) * random.direction();
    const auto found = ball.nearest(point, time, 5e-3, 2e-5);
    ASSERT_TRUE(found);
    EXPECT_NEAR((*found - point).norm(), point.norm() - size, 6e-5);
    EXPECT_FALSE(ball.nearest(point, time, 0.9 * (point.norm() - size), 2e-5));
  }
}

/// Where it has to look too long, the judge says so.
TEST(PlainField, CountsQuestionsThatItCouldNotFinish) {
  const auto ground = [](double finest) {
    return [finest](const Vector3& p, double) { return p.z() + 1e-4 * std::abs(std::sin(finest * p.x())); };
  };
  const Vector3 above(0.01, 0.02, 2.2e-3);
  const MembershipSolid plain = plain_solid(ground(10.0), offset_box(), false);
  EXPECT_TRUE(plain.nearest(above, 0.0, 2.5e-3, 2e-5));
  EXPECT_EQ(plain.unfinished(), 0U);
  const MembershipSolid rough = plain_solid(ground(1e7), offset_box(), false);
  rough.nearest(above, 0.0, 2.19e-3, 1e-7);
  EXPECT_EQ(rough.unfinished(), 1U);
  JudgeSettings settings;
  settings.tip_radius = 2e-3;
  ContactJudge judge({{rough}}, settings);
  judge.judge({above, above, false});
  EXPECT_GT(judge.unfinished(), 0U);
  EXPECT_EQ(judge.unfinished(), rough.unfinished() - 1);
}

/// Where it was looked once, a formula need not be asked again: a judge asks some seventy questions a tick.
TEST(PlainField, AsksAFormulaRarelyAboutOnePlace) {
  std::size_t asked = 0;
  const auto waves = [&](const Vector3& p, double) {
    ++asked;
    return p.z() - 0.01 * std::sin(50.0 * p.x());
  };
  const MembershipSolid ground = plain_solid(waves, offset_box(), false);
  const double radius = 0.01;
  const Vector3 crest(0.0314159, 0.0, 0.01);
  const auto at = [&](double x, double height) { return Vector3(crest + Vector3(x, 0.0, radius + height)); };
  const auto first = ground.nearest(at(0.0, 1e-5), 0.0, radius, 4e-5);
  EXPECT_FALSE(first);
  for (int i = 0; i < 70; ++i) {
    const auto found = ground.nearest(at(2e-6 * i, -5e-5 - 1e-6 * i), 0.0, radius, 4e-5);
    ASSERT_TRUE(found);
    EXPECT_LT((*found - at(2e-6 * i, -5e-5 - 1e-6 * i)).norm(), radius);
  }
  EXPECT_LT(asked, 150'000U);
}

// A ball that lies in a bowl touches its rim with a thin sliver only.
TEST(PlainField, FindsAnEdgeWithinTheFinenessAskedFor) {
  const MembershipSolid wedge =
      plain_solid([](const Vector3& p, double) { return std::max(p.x() + p.y(), p.x() - 1.3 * p.y()); },
                  offset_box(), false);
  base::Random random(5);
  for (int i = 0; i < 400; ++i) {
    const double apart = random.uniform(2e-3, 0.01), fineness = 4e-5;
    const Vector3 place(apart, random.uniform(-0.2, 0.2) * apart, random.uniform(-0.02, 0.02));
    const double least = std::hypot(place.x(), place.y());
    const auto found = wedge.nearest(place, 0.0, least + fineness, fineness);
    ASSERT_TRUE(found) << place.transpose();
    EXPECT_LT((*found - place).norm(), least + fineness);
  }
}

// The two functions differ much in steepness, and where they are equal within the bowl nothing is solid.
TEST(PlainField, FindsTheRimOfABowlFromAbove) {
  const MembershipSolid bowl = plain_solid(
      [](const Vector3& p, double) { return std::max(p.z(), 4e-4 - p.squaredNorm()); }, offset_box(), false);
  base::Random random(5);
  for (int i = 0; i < (kSanitizerShare > 1 ? 10 : 100); ++i) {
    const double turn = random.uniform(0.0, 6.28), r = random.uniform(2e-3, 8e-3),
                 z = random.uniform(1e-3, 3e-3);
    const Vector3 place(r * std::cos(turn), r * std::sin(turn), z);
    const double least = std::hypot(0.02 - r, z);
    const auto found = bowl.nearest(place, 0.0, least + 1e-4, 4e-5);
    ASSERT_TRUE(found) << place.transpose();
    EXPECT_LT((*found - place).norm(), least + 4e-5);
    EXPECT_FALSE(bowl.nearest(place, 0.0, least - 1e-6, 4e-5));
  }
}

// Slopes repeat at the middles and corners of halved parts; between them the ground is as high as elsewhere.
TEST(PlainField, IsNotDeceivedByWavesThatFitTheBox) {
  for (const double waves : {4.0, 8.0, 16.0, 32.0}) {
    const double steepness = waves * 2.0 * std::numbers::pi / 0.12;
    const MembershipSolid ground =
        plain_solid([&](const Vector3& p, double) { return p.z() - 0.002 * std::cos(steepness * p.x()); },
                    offset_box(), false);
    base::Random random(7);
    for (int i = 0; i < 50; ++i) {
      const double x = (random.index(std::size_t(waves) - 2) + 1.0) * 0.12 / waves - 0.06;
      const double top = 0.002 * std::cos(steepness * x);
      const Vector3 above(x, random.uniform(-0.04, 0.04), top + random.uniform(1e-4, 2e-3));
      const auto found = ground.nearest(above, 0.0, 2.5e-3, 2e-5);
      ASSERT_TRUE(found) << waves;
      const double least =
          distance_to_ground([&](double u, double) { return 0.002 * std::cos(steepness * u); }, above, 3e-3);
      EXPECT_LT((*found - above).norm(), least + 4e-5) << waves;
    }
  }
}

}  // namespace
}  // namespace icome::haptics
