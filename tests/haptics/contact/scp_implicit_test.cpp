// The surface contact point on implicit surfaces, against closed forms and plain search.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "geometry/implicit/formula_allowance.h"
#include "geometry/implicit/implicit_surface.h"
#include "geometry/implicit/plain_formula.h"
#include "geometry/plane_formulas.h"
#include "haptics/csg_touch.h"
#include "haptics/judge/contact_judge.h"
#include "haptics/judge/plain_field.h"

namespace icome::haptics {
namespace {

constexpr double kImplicitSize = 0.1;  // m, of the solids in the middle of the box
constexpr double kOnSurface = 1e-9;    // m, ten times what the SCP keeps from a surface

base::Bounds implicit_box() { return {Vector3::Constant(-0.06), Vector3::Constant(0.06)}; }

/// A solid as a formula, and told a second time with the functions of BruteSolid.
struct Field {
  std::string name;
  std::string formula;
  std::function<double(const Vector3&)> value;  // not the formula's, but of the same sign
  double steepest;                              // of `value`, per m

  double bound(const Vector3& p) const {
    const double beside = (p.cwiseAbs() - implicit_box().max()).maxCoeff();
    return std::max(value(p) / steepest, beside);
  }
  bool inside(const Vector3& p) const { return bound(p) < 0.0; }
  const Field& near(const Vector3&, double) const { return *this; }

  friend std::ostream& operator<<(std::ostream& out, const Field& it) { return out << it.name; }
};

std::shared_ptr<const Shape> formula_shape(const std::string& formula) {
  auto surface = geometry::ImplicitSurface::create(formula, implicit_box());
  EXPECT_TRUE(surface.has_value()) << (surface ? "" : surface.error().message);
  return std::make_shared<SmoothShape>(*surface);
}

/// How the SCP can have come: along the surface where the straight way dips below it by little for its
/// length.
Way brute_way(const Field& field, const Vector3& from, const Vector3& to, const Vector3& tip, double size) {
  constexpr int kPieces = 24;
  const double length = (to - from).norm(), finest = 1e-7 * size;
  bool along = true;
  Vector3 last = from;
  for (int i = 1; i <= kPieces && along; ++i) {
    Vector3 at = from + (double(i) / kPieces) * (to - from);
    const Vector3 chord = at;
    for (int lift = 0; lift < 40 && field.bound(at) < -1e-3 * finest; ++lift) {
      Vector3 slope;
      for (int k = 0; k < 3; ++k) {
        slope[k] =
            (field.bound(at + finest * Vector3::Unit(k)) - field.bound(at - finest * Vector3::Unit(k)));
      }
      at += (0.1 * finest - field.bound(at) * 2.0 * finest / slope.norm()) * slope.normalized();
    }
    along = field.bound(at) >= -1e-3 * finest && (at - chord).norm() <= 0.3 * length + finest &&
            (at - last).norm() <= 4.0 * length / kPieces + finest;
    last = at;
  }
  return along ? Way::Around : haptics::brute_way<Field>(field, from, to, tip, size);
}

// ---- Solids

Field ball_field() {
  return {"Ball", "x^2 + y^2 + z^2 - 0.05^2", [](const Vector3& p) { return p.norm() - 0.05; }, 1.0};
}

Field ring_field() {
  return {"Ring", "(sqrt(x^2 + y^2) - 0.035)^2 + z^2 - 0.015^2",
          [](const Vector3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 0.035, p.z()) - 0.015; }, 1.0};
}

Field gyroid_field() {
  return {"Gyroid", "sin(80*x)*cos(80*y) + sin(80*y)*cos(80*z) + sin(80*z)*cos(80*x) + 0.3",
          [](const Vector3& p) {
            const Vector3 s = (80.0 * p).array().sin(), c = (80.0 * p).array().cos();
            return s.x() * c.y() + s.y() * c.z() + s.z() * c.x() + 0.3;
          },
          80.0 * 2.0 * std::sqrt(3.0)};
}

Field blend_field() {
  const auto drop = [](const Vector3& p, double x, double y, double width) {
    return std::exp(-((p - Vector3(x, y, 0.0)) / width).squaredNorm());
  };
  return {"Blend",
          "0.5 - exp(-((x - 0.02)^2 + y^2 + z^2)/0.02^2) - exp(-((x + 0.02)^2 + y^2 + z^2)/0.02^2)"
          " - exp(-(x^2 + (y - 0.022)^2 + z^2)/0.012^2)",
          [=](const Vector3& p) {
            return 0.5 - drop(p, 0.02, 0.0, 0.02) - drop(p, -0.02, 0.0, 0.02) - drop(p, 0.0, 0.022, 0.012);
          },
          0.858 * (2.0 / 0.02 + 1.0 / 0.012)};
}

/// Waves over the floor of the box.
Field wave_field(double time = 0.0) {
  return {"Waves", "z - 0.004*sin(90*x - 8*t) - 0.003*cos(70*y + 5*t)",
          [=](const Vector3& p) {
            return p.z() - 0.004 * std::sin(90.0 * p.x() - 8.0 * time) -
                   0.003 * std::cos(70.0 * p.y() + 5.0 * time);
          },
          std::sqrt(1.0 + 0.36 * 0.36 + 0.21 * 0.21)};
}

// ---- Solids whose formulas choose or jump

Field valley_field() {
  return {"Valley", "z - max(x, -2*x)",
          [](const Vector3& p) { return p.z() - std::max(p.x(), -2.0 * p.x()); }, std::sqrt(5.0)};
}

Field waves_and_wall_field() {
  return {"WavesAndWall", "min(z - 0.01*sin(50*x), x)",
          [](const Vector3& p) { return std::min(p.z() - 0.01 * std::sin(50.0 * p.x()), p.x()); },
          std::sqrt(1.25)};
}

double ball_distance(const Vector3& p, double x) { return (p - Vector3(x, 0.0, 0.0)).norm() - 0.03; }

Field joined_balls_field() {
  return {"JoinedBalls", "min((x + 0.015)^2 + y^2 + z^2 - 0.03^2, (x - 0.015)^2 + y^2 + z^2 - 0.03^2)",
          [](const Vector3& p) { return std::min(ball_distance(p, -0.015), ball_distance(p, 0.015)); }, 1.0};
}

Field lens_field() {
  return {"Lens", "max((x + 0.015)^2 + y^2 + z^2 - 0.03^2, (x - 0.015)^2 + y^2 + z^2 - 0.03^2)",
          [](const Vector3& p) { return std::max(ball_distance(p, -0.015), ball_distance(p, 0.015)); }, 1.0};
}

Field octahedron_field() {
  return {"Octahedron", "abs(x) + abs(y) + abs(z) - 0.05",
          [](const Vector3& p) { return p.cwiseAbs().sum() - 0.05; }, std::sqrt(3.0)};
}

Field cube_field() {
  return {"Cube", "max(abs(x), max(abs(y), abs(z))) - 0.04",
          [](const Vector3& p) { return p.cwiseAbs().maxCoeff() - 0.04; }, 1.0};
}

/// A cross of two bars: convex and concave edges, and corners of both.
Field cross_field() {
  return {
      "Cross", "max(min(abs(x) - 0.015, abs(y) - 0.01), abs(z) - 0.02, abs(x) - 0.05, abs(y) - 0.05)",
      [](const Vector3& p) {
        const Vector3 q = p.cwiseAbs();
        return std::max({std::min(q.x() - 0.015, q.y() - 0.01), q.z() - 0.02, q.x() - 0.05, q.y() - 0.05});
      },
      1.0};
}

/// A ridge that goes over into the plane without a crease.
Field smooth_join_field() {
  return {"SmoothJoin", "z - 20*max(x, 0)^2",
          [](const Vector3& p) { return p.z() - 20.0 * std::pow(std::max(p.x(), 0.0), 2.0); },
          std::sqrt(1.0 + 2.4 * 2.4)};
}

/// Solid for x < 0, by a pole, and for x > 0.01.
Field pole_field() {
  return {"Pole", "1/x - 100", [](const Vector3& p) { return 0.005 - std::abs(p.x() - 0.005); }, 1.0};
}

/// Solid between x = 0, where the formula begins to have values, and x = 0.01.
Field begin_field() {
  return {"Begin", "sqrt(x) - 0.1", [](const Vector3& p) { return std::abs(p.x() - 0.005) - 0.005; }, 1.0};
}

/// On a star the angle jumps without a trace.
Field star_field() {
  return {"Star", "max(sqrt(x^2 + y^2) - 0.03 - 0.001*sin(5*atan2(y, x)), abs(z) - 0.04)",
          [](const Vector3& p) {
            const double turned = std::sin(5.0 * std::atan2(p.y(), p.x()));
            return std::max(std::hypot(p.x(), p.y()) - 0.03 - 0.001 * turned, std::abs(p.z()) - 0.04);
          },
          2.0};
}

/// Goes over into the wall where the root ends without an edge.
Field dome_field() {
  return {"Dome", "z - sqrt(0.04^2 - x^2 - y^2)",
          [](const Vector3& p) { return p.z() > 0.0 ? p.norm() - 0.04 : std::hypot(p.x(), p.y()) - 0.04; },
          1.0};
}

Field root_field() {
  constexpr double kSteepest = 0.13;  // of z^2 - 0.01*x in the box
  return {"Root", "z - 0.1*sqrt(x)",
          [](const Vector3& p) {
            if (p.z() > 0.0) return p.z() * p.z() - 0.01 * p.x();
            const double deep = std::min(0.5 * p.x(), 0.1 * std::sqrt(std::max(0.0, 0.5 * p.x())) - p.z());
            return -kSteepest * (p.x() > 0.0 ? deep : p.x());
          },
          kSteepest};
}

Field step_field() {
  return {"Step", "if(x < 0.01 && y < 0.02, z, z + 0.02)",
          [](const Vector3& p) {
            const double over = std::max(p.x() - 0.01, p.y() - 0.02);
            return std::min(std::max(p.z(), over), p.z() + 0.02);
          },
          1.0};
}

// ---- Solids whose formulas have ends, turns and gaps that their surfaces do not have

/// Without a crease, but bent without limit at x = 0.
Field power_field() {
  return {"Power", "z - 2*abs(x)^1.5",
          [](const Vector3& p) { return p.z() - 2.0 * std::pow(std::abs(p.x()), 1.5); }, 1.25};
}

Field pillow_field() {
  return {"Pillow", "abs(x)^1.5 + abs(y)^1.5 + abs(z)^1.5 - 0.04^1.5",
          [](const Vector3& p) { return p.cwiseAbs().array().pow(1.5).sum() - std::pow(0.04, 1.5); }, 0.64};
}

/// Ends in a wall at x = 0.
Field half_power_field() {
  return {
      "HalfPower", "z - 3*x^1.5",
      [](const Vector3& p) { return std::max(p.z() - 3.0 * std::pow(std::max(p.x(), 0.0), 1.5), -p.x()); },
      1.5};
}

Field zigzag_field() {
  return {"Zigzag", "z - 0.003*asin(sin(150*x))",
          [](const Vector3& p) { return p.z() - 0.003 * std::asin(std::sin(150.0 * p.x())); }, 1.1};
}

Field folds_field() {
  return {"Folds", "z - 0.003*acos(cos(120*x)) + 0.002*asin(cos(90*y))",
          [](const Vector3& p) {
            return p.z() - 0.003 * std::acos(std::cos(120.0 * p.x())) +
                   0.002 * std::asin(std::cos(90.0 * p.y()));
          },
          1.1};
}

/// atan jumps along x = 0, its double sine does not.
Field clover_field() {
  return {"Clover", "max(sqrt(x^2 + y^2) - 0.03 - 0.001*sin(2*atan(y/x)), abs(z) - 0.04)",
          [](const Vector3& p) {
            const double square = p.x() * p.x() + p.y() * p.y();
            const double turned = square > 0.0 ? 2.0 * p.x() * p.y() / square : 0.0;
            return std::max(std::sqrt(square) - 0.03 - 0.001 * turned, std::abs(p.z()) - 0.04);
          },
          2.0};
}

Field ripple_field() {
  return {"Ripple", "z - 2*sin(150*hypot(x, y))/(150*hypot(x, y))/100",
          [](const Vector3& p) {
            const double angle = 150.0 * std::hypot(p.x(), p.y());
            return p.z() - 0.02 * (angle > 0.0 ? std::sin(angle) / angle : 1.0);
          },
          1.7};
}

Field pit_field() {
  return {"Pit", "z - sqrt(x^2 + y^2)", [](const Vector3& p) { return p.z() - std::hypot(p.x(), p.y()); },
          std::sqrt(2.0)};
}

// ---- Random presses and slides

class TouchedFields : public testing::TestWithParam<Field> {};

INSTANTIATE_TEST_SUITE_P(Fields, TouchedFields,
                         testing::Values(ball_field(), ring_field(), gyroid_field(), blend_field(),
                                         wave_field(), valley_field(), waves_and_wall_field(),
                                         joined_balls_field(), lens_field(), octahedron_field(), cube_field(),
                                         cross_field(), smooth_join_field(), pole_field(), begin_field(),
                                         star_field(), step_field(), dome_field(), root_field(),
                                         power_field(), pillow_field(), half_power_field(), zigzag_field(),
                                         folds_field(), clover_field(), ripple_field(), pit_field()),
                         [](const auto& it) { return it.param.name; });

TEST_P(TouchedFields, GivesTheConstrainedPlaceAndNoPops) {
  const Field& field = GetParam();
  TouchCheck check;
  check.size = kImplicitSize;
  check.sample = 40;
  check.report = [](const TouchFailure& failure) { ADD_FAILURE() << failure; };
  const auto path = random_touch(field, 7, 2000, kImplicitSize);
  const TouchFigures figures = CheckedTouch(field, formula_shape(field.formula), check).run(path);
  EXPECT_EQ(figures.failures, 0u);
  EXPECT_GT(figures.touching, path.size() / 10);
}

/// Compares with a closed form for tips inside.
template <typename Known>
void compare_with_known(const Field& field, Known&& known) {
  Toucher toucher(HapticScene::compile({object(1, formula_shape(field.formula))}));
  std::size_t compared = 0;
  for (const Vector3& tip : random_touch(field, 21, 5000, kImplicitSize)) {
    const ScpState& state = toucher.step(tip);
    ASSERT_TRUE(state.converged);
    if (!field.inside(tip)) continue;
    ++compared;
    ASSERT_TRUE(state.touching);
    const Vector3 place = known(tip);
    // Next to a ring's core or a ball's centre the rounding of the tip turns the way out.
    ASSERT_LT((state.scp - place).norm(), 1e-8) << tip.transpose();
    ASSERT_LT((state.normal - (place - tip).normalized()).norm(), 1e-6) << tip.transpose();
  }
  EXPECT_GT(compared, 500);
}

// The side of the pit rises towards the tip, but leads nearer to it by 6 parts in 100 of the way only.
TEST(ScpOnImplicit, LeavesThePitOfAConeAlongItsSide) {
  Toucher toucher(HapticScene::compile({object(1, formula_shape(pit_field().formula))}));
  for (int tick = 0; tick < 20; ++tick) toucher.step(Vector3(1e-3, 2e-3, 0.01 - 1e-3 * tick));
  const Vector3 beside(0.0148, -0.0421, -0.0396);
  for (int tick = 0; tick < 5; ++tick) toucher.step(beside);
  const double out = std::hypot(beside.x(), beside.y());
  const double up = 0.5 * (out + beside.z());  // where the side, at 45 degrees, is nearest
  const Vector3 place(up * beside.x() / out, up * beside.y() / out, up);
  EXPECT_LT((toucher.step(beside).scp - place).norm(), 1e-6);
}

TEST(ScpOnImplicit, IsTheNearestPlaceOfABallAndARing) {
  compare_with_known(ball_field(), [](const Vector3& tip) { return Vector3(0.05 * tip.normalized()); });
  compare_with_known(ring_field(), [](const Vector3& tip) {
    const Vector3 core = 0.035 * Vector3(tip.x(), tip.y(), 0.0).normalized();
    return Vector3(core + 0.015 * (tip - core).normalized());
  });
}

/// Planes n . p = c, above all of which is free.
struct Corner {
  std::vector<Vector3> normals;
  std::vector<double> offsets;

  bool allows(const Vector3& p) const {
    for (std::size_t i = 0; i < normals.size(); ++i) {
      if (normals[i].dot(p) < offsets[i] - 1e-12) return false;
    }
    return true;
  }

  /// The nearest free place: of those that one, two or three planes have, each by the normal equations.
  Vector3 nearest(const Vector3& tip) const {
    Vector3 best = tip;
    double least = allows(tip) ? 0.0 : std::numeric_limits<double>::infinity();
    const std::size_t sets = std::size_t{1} << normals.size();
    for (std::size_t set = 1; set < sets; ++set) {
      Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3> rows(std::min(3, __builtin_popcountll(set)), 3);
      if (__builtin_popcountll(set) > 3) continue;
      Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> lacks(rows.rows());
      Eigen::Index row = 0;
      for (std::size_t i = 0; i < normals.size(); ++i) {
        if ((set >> i & 1) == 0) continue;
        rows.row(row) = normals[i].transpose();
        lacks[row++] = offsets[i] - normals[i].dot(tip);
      }
      const Vector3 place =
          tip + rows.transpose() * (rows * rows.transpose()).fullPivLu().solve(lacks).eval();
      if (!allows(place) || (place - tip).norm() >= least) continue;
      best = place;
      least = (place - tip).norm();
    }
    return best;
  }
};

TEST(ScpOnImplicit, IsTheProjectionInsideAnyConcaveCorner) {
  Random random(52);
  std::size_t edges = 0;
  for (int i = 0; i < repeats(100); ++i) {
    Corner corner;
    std::string text = "min(";
    for (int k = 0; k < 2 + i % 4; ++k) {
      const Vector3 normal = (random.direction() + 1.1 * Vector3::UnitZ()).normalized();
      const double offset = geometry::short_number(random, 0.01);
      corner.normals.push_back(normal);
      corner.offsets.push_back(offset);
      text +=
          fmt::format("{}{}*x + {}*y + {}*z - {}", k ? ", " : "", normal.x(), normal.y(), normal.z(), offset);
    }
    Toucher toucher(HapticScene::compile({object(1, formula_shape(text + ")"))}));
    Vector3 tip(0.0, 0.0, 0.05);
    toucher.step(tip);
    for (int tick = 0; tick < 60; ++tick) {
      const Vector3 next = 0.03 * random.uniform(0.0, 1.0) * random.direction();
      const ScpState& state = toucher.go(tip, next, 4);
      tip = next;
      const Vector3 expected = corner.nearest(tip);
      if (expected.cwiseAbs().maxCoeff() > 0.055) break;  // by the box
      ASSERT_TRUE(state.converged) << text;
      ASSERT_LT((state.scp - expected).norm(), 1e-8) << text << " tip " << tip.transpose();
      edges += (expected - tip).norm() > 1e-3;
    }
  }
  EXPECT_GT(edges, std::size_t(repeats(1000)));
}

/// Two tellings of one solid are felt alike.
void expect_felt_alike(const Field& field, std::shared_ptr<const Shape> other, std::uint64_t seed) {
  Toucher one(HapticScene::compile({object(1, formula_shape(field.formula))}));
  Toucher two(HapticScene::compile({object(1, std::move(other))}));
  std::size_t touching = 0;
  for (const Vector3& tip : random_touch(field, seed, 4000, kImplicitSize)) {
    const ScpState& a = one.step(tip);
    const ScpState& b = two.step(tip);
    ASSERT_EQ(a.touching, b.touching) << tip.transpose();
    ASSERT_LT((a.scp - b.scp).norm(), 1e-8) << tip.transpose();
    touching += a.touching;
  }
  EXPECT_GT(touching, 200);
}

TEST(ScpOnImplicit, IsAsOnTheSameSolidMadeOfPrimitives) {
  const auto left = moved(-0.015, 0.0, 0.0), right = moved(0.015, 0.0, 0.0);
  const CsgTree joined = TreeChain(ball_shape(0.03), left).unite(ball_shape(0.03), right).tree();
  const CsgTree lens = TreeChain(ball_shape(0.03), left).keep(ball_shape(0.03), right).tree();
  expect_felt_alike(joined_balls_field(), shape_of(joined), 61);
  expect_felt_alike(lens_field(), shape_of(lens), 62);
  expect_felt_alike(cube_field(), shape_of(primitive("box:0.08x0.08x0.08")), 63);
}

TEST(ScpOnImplicit, IsNotStabbedThroughAThinWavyWall) {
  const ScenePointer scene =
      HapticScene::compile({object(1, formula_shape("abs(z - 0.004*sin(60*x)) - 0.0001"))});
  Random random(8);
  int pops = 0;
  for (int i = 0; i < repeats(1000); ++i) {
    const double side = i % 2 ? 1.0 : -1.0;
    const double x = random.uniform(-0.04, 0.04), speed = std::pow(10.0, random.uniform(-4.0, -1.7));
    const Vector3 middle(x, random.uniform(-0.04, 0.04), 0.004 * std::sin(60.0 * x));
    const Vector3 way = Vector3(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), -side).normalized();
    Toucher toucher(scene);
    for (double t = -0.01; t < 0.01; t += speed) {  // m a tick
      const Vector3 scp = toucher.step(middle + t * way).scp;
      pops += side * (scp.z() - 0.004 * std::sin(60.0 * scp.x())) < 0.0001 * (1.0 - 1e-6);
    }
    EXPECT_TRUE(toucher.solver.state().converged) << i;
  }
  EXPECT_EQ(pops, 0);
}

// ---- Surfaces that change with time

/// The least of what a wave's SCP must be at any time.
void expect_on_waves(const Field& field, const ScpState& state, double time) {
  EXPECT_TRUE(state.converged) << time;
  EXPECT_GE(field.bound(state.scp), -1e-3 * kOnSurface) << time;
  if (state.touching) {
    EXPECT_LE(field.bound(state.scp), kOnSurface) << time;
  }
}

TEST(ScpOnImplicit, RidesOnMovingWaves) {
  const ScenePointer scene = HapticScene::compile({object(1, formula_shape(wave_field().formula))});
  Random random(3);
  for (int i = 0; i < repeats(40); ++i) {
    const Vector3 tip(random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03),
                      random.uniform(-0.02, -0.008));
    Toucher toucher(scene);
    toucher.step({tip.x(), tip.y(), 0.01});
    for (int tick = 0; tick < 300; ++tick) {
      const double time = 1e-3 * tick;
      const Field field = wave_field(time);
      const ScpState& state = toucher.solver.step(tip, time);
      expect_on_waves(field, state, time);
      ASSERT_TRUE(state.touching) << i << " " << tick;
      if (tick % 100 == 99) {
        EXPECT_LT(brute_scp_error(field, tip, state.scp, kImplicitSize).error, 1e-6) << i << " " << tick;
      }
      // How fast the surface goes up there, as a difference; along its normal it is slower.
      const double dt = 1e-5;
      const double lift = -(wave_field(time + dt).value(state.scp) - wave_field(time - dt).value(state.scp));
      const Vector3 swell = lift / (2.0 * dt) * state.normal.z() * state.normal;
      EXPECT_LT((state.surface_velocity - swell).norm(), 1e-6) << i << " " << tick;
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(ScpOnImplicit, SlidesOverMovingWavesWithoutPops) {
  const ScenePointer scene = HapticScene::compile({object(1, formula_shape(wave_field().formula))});
  const auto path = random_touch(wave_field(), 12, 4000, kImplicitSize);
  Toucher toucher(scene);
  Vector3 last = path.front();
  std::size_t touching = 0;
  for (std::size_t tick = 0; tick < path.size(); ++tick) {
    const double time = 1e-3 * double(tick);
    const ScpState& state = toucher.solver.step(path[tick], time);
    const Field field = wave_field(time);
    expect_on_waves(field, state, time);
    touching += state.touching;
    // In a tick the waves rise by as much as 50 um under the SCP, which they take along.
    const Vector3 before = last + std::max(0.0, -1.1 * field.steepest * field.bound(last)) * Vector3::UnitZ();
    EXPECT_NE(brute_way(field, before, state.scp, path[tick], kImplicitSize), Way::None) << tick;
    last = state.scp;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(touching, path.size() / 10);
}

TEST(ScpOnImplicit, SurfacesWhenABallGrowsOverTheTip) {
  for (const double speed : {0.01, 1.0, 20.0}) {  // m/s
    const std::string formula = "x^2 + y^2 + z^2 - (0.01 + " + std::to_string(speed) + "*t)^2";
    const ScenePointer scene = HapticScene::compile({object(1, formula_shape(formula))});
    Random random(5);
    for (int i = 0; i < repeats(20); ++i) {
      const Vector3 out = random.direction();
      const Vector3 tip = random.uniform(0.0101, 0.03) * out;
      Toucher toucher(scene);
      for (double time = 0.0; 0.01 + speed * time < 0.05; time += std::max(1e-3, 2e-5 / speed)) {
        const double radius = 0.01 + speed * time;
        const ScpState& state = toucher.solver.step(tip, time);
        ASSERT_TRUE(state.converged);
        if (std::abs(radius - tip.norm()) < 1e-8) continue;
        ASSERT_EQ(state.touching, radius > tip.norm()) << radius << " " << tip.norm();
        ASSERT_LT((state.scp - (state.touching ? radius * out : tip)).norm(), 2e-9) << speed << " " << time;
        if (state.touching) {
          ASSERT_LT((state.surface_velocity - speed * out).norm(), 1e-6 * speed);
        }
      }
    }
  }
}

/// A stair and a spiral have no tangent plane at their axis: who is pressed against it stays outside.
TEST(ScpOnImplicit, IsNotPressedThroughTheAxisOfAStair) {
  struct AxisPress {
    const char* formula;
    std::vector<Vector3> way;
  };
  const std::vector<AxisPress> presses = {
      {"z - 0.003*atan2(y, x)",
       {{-0.0165, -0.01, 0.0}, {-0.0165, 0.02, -0.0105}, {0.003, 0.0333, -0.0098}, {0.02, 0.036, -0.0095}}},
      {"z + 0.01*sin(3*atan2(y, x) + 200*sqrt(x^2 + y^2))",
       {{-0.0304, -0.0304, 0.03},
        {-0.0304, -0.0304, 0.0146},
        {-0.048, -0.048, 0.0082},
        {-0.0431, -0.0431, -0.0014},
        {-0.016, -0.016, -0.0112},
        {0.0076, 0.0076, -0.0177}}}};
  for (const AxisPress& press : presses) {
    const auto value = *geometry::plain_formula(press.formula);
    Toucher toucher(HapticScene::compile({object(1, formula_shape(press.formula))}));
    for (std::size_t leg = 1; leg < press.way.size(); ++leg) {
      for (int i = 0; i <= 100; ++i) {
        const Vector3 tip = press.way[leg - 1] + 0.01 * i * (press.way[leg] - press.way[leg - 1]);
        ASSERT_GE(value(toucher.step(tip).scp, 0.0), 0.0) << press.formula << " at " << tip.transpose();
      }
    }
  }
}

// ---- Surfaces with nodes, points and axes, where there is no tangent plane

struct Singular {
  const char* name;
  const char* formula;  // of x, y, z in units of `unit`
  double unit;          // m

  std::string text() const {
    std::string scaled;
    for (const char* c = formula; *c != 0; ++c) {
      const bool variable = *c == 'x' || *c == 'y' || *c == 'z';
      scaled += variable ? fmt::format("({}/{})", *c, unit) : std::string(1, *c);
    }
    return scaled;
  }
  friend std::ostream& operator<<(std::ostream& out, const Singular& it) { return out << it.name; }
};

class TouchedSingular : public testing::TestWithParam<Singular> {};

INSTANTIATE_TEST_SUITE_P(
    Formulas, TouchedSingular,
    testing::Values(Singular{"Heart", "(x^2 + 2.25*y^2 + z^2 - 1)^3 - x^2*z^3 - 0.1125*y^2*z^3", 0.04},
                    Singular{"Barth",
                             "4*(2.618*x^2 - y^2)*(2.618*y^2 - z^2)*(2.618*z^2 - x^2) - "
                             "4.236*(x^2 + y^2 + z^2 - 1)^2",
                             0.03},
                    Singular{"Cones", "x^2 + y^2 - z^2", 0.05}, Singular{"Pinch", "x^2 - y^2*z", 0.05},
                    Singular{"Stair", "z - 0.5*atan2(y, x)", 0.02}),
    [](const auto& it) { return it.param.name; });

TEST_P(TouchedSingular, FindsAWayOnWhereThereIsOneAndTakesNoLongerThanItMay) {
  const std::string formula = GetParam().text();
  const auto value = *geometry::plain_formula(formula);
  struct Known {
    geometry::PlainFormula value;
    bool inside(const Vector3& p) const { return implicit_box().contains(p) && value(p, 0.0) < 0.0; }
  };
  Toucher toucher(HapticScene::compile({object(1, formula_shape(formula))}));
  ContactJudge judge({{plain_solid(value, implicit_box(), false)}}, {});
  std::uint64_t most = 0;
  for (const Vector3& tip : random_touch(Known{value}, 7, std::size_t(repeats(1500)), kImplicitSize)) {
    const std::uint64_t before = geometry::FormulaAllowance::counted();
    const ScpState& state = toucher.step(tip);
    most = std::max(most, geometry::FormulaAllowance::counted() - before);
    judge.judge({tip, state.scp, state.touching});
  }
  EXPECT_EQ(judge.pops(), 0U);
  EXPECT_EQ(judge.sticks(), 0U);
  EXPECT_LT(most, 2.5 * ScpSettings().max_evaluations);
}

TEST(ScpOnImplicit, IsHeldByTheFloorOfTheBox) {
  const ScenePointer scene = HapticScene::compile({object(1, formula_shape(wave_field().formula))});
  Random random(14);
  for (int i = 0; i < repeats(100); ++i) {
    const Vector3 below(random.uniform(-0.055, 0.055), random.uniform(-0.055, 0.055), -0.07);
    const Vector3 tip = below + Vector3(0.0, 0.0, random.uniform(0.011, 0.05));
    Toucher toucher(scene);
    toucher.step(below);
    const ScpState& state = toucher.go(below, tip, 30);
    ASSERT_TRUE(state.touching && state.converged) << i;
    ASSERT_LT((state.scp - Vector3(tip.x(), tip.y(), -0.06)).norm(), kOnSurface) << i;
    ASSERT_EQ(state.normal, Vector3(0.0, 0.0, -1.0)) << i;
  }
}

}  // namespace
}  // namespace icome::haptics
