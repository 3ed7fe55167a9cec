// Sphere tips that are large against the triangles, and sphere tips that begin inside something.
#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "geometry/mesh/geodesic_sphere.h"
#include "haptics/contact_world.h"
#include "haptics/judge/contact_judge.h"
#include "repeats.h"

namespace icome::haptics {
namespace {

/// As a scan is: bumps, and on them noise from vertex to vertex.
MeshPointer rough_ball(int frequency, double noise) {
  Random random(21);
  TriangleMesh mesh = geometry::bumpy_geodesic_sphere(frequency, 0.05, 0.05, 8);
  for (Vector3& p : mesh.positions) p *= 1.0 + random.uniform(-noise, noise);
  return shared(mesh);
}

MeshPointer grooved_block() {
  return shared(
      prism({{-.05, -.02}, {.05, -.02}, {.05, .02}, {.001, .02}, {0, -.01}, {-.001, .02}, {-.05, .02}},
            {{0, 1, 4}, {1, 2, 3}, {1, 3, 4}, {0, 4, 5}, {0, 5, 6}}, 0.1));
}

/// How deep a tip overlaps a closed mesh, m: by brute force.
double overlap(const TriangleMesh& mesh, const Vector3& centre, double radius) {
  const double distance = brute_nearest(mesh, centre).distance;
  return brute_winding(mesh, centre) > 0.5 ? radius + distance : radius - distance;
}

// Edges of 1 mm under tips of 5 and 10 mm, up to 3 mm deep: several hundred triangles are in a tip's reach.
TEST(SphereTips, AreNeitherPassedNorHeldOnRoughMeshes) {
  const MeshPointer mesh = rough_ball(40, 0.005);
  for (const double radius : {0.005, 0.01}) {
    Toucher toucher(HapticScene::compile({object(1, shape_of(mesh, true, radius))}), radius);
    JudgeSettings settings;
    settings.tip_radius = radius;
    ContactJudge judge({{mesh}}, settings);
    Random random(4);
    Vector3 tip(0.07, 0.0, 0.0), goal = tip;
    int behind = 0, longest_behind = 0;
    for (int i = 0; i < repeats(3000); ++i) {
      if ((goal - tip).norm() < 3e-4)
        goal = (tip + 0.03 * random.direction()).normalized() * (0.047 + radius);
      tip += 2e-4 * (goal - tip).normalized();
      const ScpState& state = toucher.step(tip);
      judge.judge({tip, state.scp, state.touching});
      behind = state.converged ? 0 : behind + 1;
      longest_behind = std::max(longest_behind, behind);
    }
    EXPECT_EQ(judge.pops(), 0u) << radius;
    EXPECT_EQ(judge.sticks(), 0u) << radius;
    EXPECT_LE(longest_behind, 5) << radius;
  }
}

// A tip next to an edge pulls its SCP round that by next to nothing, and along it as much or more.
TEST(SphereTips, RoundAnEdgeInFewSteps) {
  const double radius = 0.005;
  Toucher toucher(HapticScene::compile({object(1, shape_of(shared(box_mesh({.1, .1, .1})), true, radius))}),
                  radius);
  Random random(9);
  for (int i = 0; i < 200; ++i) {
    toucher.solver.reset();
    toucher.go({0.045, 0.0, 0.06}, {0.045, 0.0, 0.0499}, 3);
    const double beside = std::pow(10.0, random.uniform(-6.0, -4.0));  // m, off the side
    const double along = std::pow(10.0, random.uniform(-6.0, -2.0));
    const ScpState& state = toucher.step({0.05 + beside, along, 0.05 - 3.0 * beside});
    EXPECT_TRUE(state.converged) << beside << " " << along;
    EXPECT_LE(state.iterations, 20) << beside << " " << along;
    EXPECT_LT((state.scp - Vector3(0.05 + radius, along, 0.05 - 3.0 * beside)).norm(), 1e-9) << beside;
  }
}

// A wall leans over the edge that the ball rounds: its way lies in the groove between both.
TEST(SphereTips, RoundAnEdgeAlongAWall) {
  const double radius = 5e-4;
  const MeshPointer block = shared(box_mesh({.1, .1, .1}));
  Random random(10);
  for (int i = 0; i < repeats(200); ++i) {
    const double over = random.uniform(0.03, 0.3);  // rad, of the edge's rounding
    const double turn = random.uniform(0.2, 1.3);   // rad, of the wall against the edge
    const Vector3 begin(0.05 + radius * std::sin(over), 0.0, 0.05 + radius * std::cos(over) + 1e-7);
    Pose wall = Pose::Identity();
    wall.linear() = Eigen::AngleAxisd(turn, Vector3::UnitZ()).toRotationMatrix();
    const Vector3 out = wall.linear().col(0);
    wall.translation() = begin - (0.05 + radius + 1e-7) * out;
    Toucher toucher(HapticScene::compile({object(1, shape_of(block, true, radius)),
                                          object(2, shape_of(block, true, radius), wall)}),
                    radius);
    ContactJudge judge({{block}, {block, wall}}, {.tip_radius = radius});
    judge.judge({begin, toucher.step(begin).scp, false});
    const double deep = random.uniform(5e-3, 9e-3);
    const double into_wall = random.uniform(0.5e-3, 3e-3);
    const Vector3 tip = begin - Vector3(0.0, 0.0, deep) - into_wall * out;
    const ScpState& state = toucher.step(tip);
    EXPECT_TRUE(state.converged) << i;
    EXPECT_LE(state.iterations, 40) << i;
    const Judgement judgement = judge.judge({tip, state.scp, state.touching});
    EXPECT_FALSE(judgement.pop || judgement.stick || judgement.late) << i;
  }
}

// Stabs at up to 5 m/s through a fine rough ball, which carry the SCP round half of it in a tick: a tick
// costs its budget and no more, and when the tip holds still, the SCP has caught up within five ticks and is
// held by nothing.
TEST(SphereTips, CatchUpSoonAfterStabs) {
  const MeshPointer mesh = rough_ball(100, 0.004);
  const double radius = 0.005;
  const ScenePointer scene = HapticScene::compile({object(1, shape_of(mesh, true, radius))});
  Toucher toucher(scene, radius);
  JudgeSettings settings;
  settings.tip_radius = radius;
  ContactJudge judge({{mesh}}, settings);
  Random random(12);
  Vector3 tip(0.0, 0.0, 0.08);
  std::uint64_t most = 0;
  for (int stab = 0; stab < repeats(150); ++stab) {
    const Vector3 goal = random.uniform(0.01, 0.06) * random.direction();
    const double speed = 1e-3 * std::pow(10.0, random.uniform(-0.3, 0.7));  // m a tick
    while (tip != goal) {
      const Vector3 way = goal - tip;
      tip = way.norm() <= speed ? goal : Vector3(tip + speed * way.normalized());
      const std::uint64_t before = toucher.solver.work();
      const ScpState& state = toucher.step(tip);
      most = std::max(most, toucher.solver.work() - before);
      judge.judge({tip, state.scp, state.touching});
    }
    bool converged = false;
    for (int i = 0; i < 5 && !converged; ++i) converged = toucher.step(tip).converged;
    EXPECT_TRUE(converged) << stab;
    const ScpState& state = toucher.step(tip);
    EXPECT_FALSE(judge.judge({tip, state.scp, state.touching}).stick) << stab;
  }
  EXPECT_EQ(judge.pops(), 0u);
  // The last sweep or gathering that the budget allows is made whole.
  EXPECT_LE(most, 1.2 * ScpSettings().max_elements);
}

// Whatever a tip overlaps when it begins, its SCP overlaps nothing; when the tip is free again, so is the
// SCP.
TEST(SphereTips, ThatBeginInsideAreFreeOfTheSurface) {
  Random random(6);
  for (const MeshPointer& mesh :
       {rough_ball(12, 0.01), grooved_block(), shared(box_mesh({0.1, 0.08, 0.06}))}) {
    const ScenePointer scene = HapticScene::compile({object(1, shape_of(mesh, true, 0.005))});
    const base::Bounds around = geometry::bounds(*mesh);
    int inside = 0, without_room = 0;
    for (int i = 0; i < std::max(60, repeats(200)); ++i) {
      const double radius = 0.002 * std::pow(5.0, random.uniform());
      const Vector3 share(random.uniform(-0.1, 1.1), random.uniform(-0.1, 1.1), random.uniform(-0.1, 1.1));
      const Vector3 tip = around.min() + share.cwiseProduct(around.sizes());
      Toucher toucher(scene, radius);
      const ScpState first = toucher.step(tip);
      const bool overlaps = overlap(*mesh, tip, radius) > 0.0;
      if (overlaps && first.scp == tip) {  // told that there is no room
        ++without_room;
        continue;
      }
      ASSERT_LE(overlap(*mesh, first.scp, radius), 1e-9) << i;
      ASSERT_EQ(first.started_inside, overlaps) << i;
      inside += overlaps ? 1 : 0;
      ASSERT_LE(overlap(*mesh, toucher.step(tip).scp, radius), 1e-9) << i;
      const Vector3 away = 0.15 * (tip - around.center()).normalized();
      const ScpState& last = toucher.go(tip, around.center() + away, 300);
      ASSERT_FALSE(last.touching) << i;
      ASSERT_LE((last.scp - around.center() - away).norm(), 1e-9) << i;
    }
    EXPECT_GT(inside, repeats(50));
    EXPECT_LE(without_room, inside / 20);  // deep in the groove
  }
}

// Between sheets that leave no room for it anywhere near, a tip is told no contact; once it has come out, it
// feels them from outside.
TEST(SphereTips, WithoutRoomTouchNothingUntilTheyAreOut) {
  TriangleMesh stack;
  for (int i = -10; i <= 10; ++i)
    stack = joined(stack, height_field(0.4, 1, [](double, double) { return 0.0; }), {0.0, 0.0, 0.006 * i});
  const double radius = 0.004;
  Toucher toucher(HapticScene::compile({object(1, shape_of(shared(stack), false, radius), Pose::Identity(),
                                               TouchableSides::Both)}),
                  radius);
  const ScpState& inside = toucher.go({0.01, 0.02, 0.001}, {0.01, 0.02, 0.01}, 10);
  EXPECT_FALSE(inside.touching);
  EXPECT_EQ(inside.scp, Vector3(0.01, 0.02, 0.01));
  toucher.go({0.01, 0.02, 0.01}, {0.01, 0.02, 0.1}, 100);
  const ScpState& back = toucher.go({0.01, 0.02, 0.1}, {0.01, 0.02, 0.05}, 100);
  EXPECT_TRUE(back.touching);
  EXPECT_NEAR(back.scp.z(), 0.06 + radius, 1e-9);
}

// A solid that appears around a resting tip puts it outside.
TEST(SphereTips, ComeOutOfWhatAppearsAroundThem) {
  const MeshPointer box = shared(box_mesh({0.1, 0.1, 0.1}));
  const double radius = 0.005;
  const ScenePointer empty = HapticScene::compile({});
  const ScenePointer full = HapticScene::compile({object(1, shape_of(box, true, radius))});
  ScpSettings settings;
  settings.tip_radius = radius;
  ScpSolver solver(settings);
  solver.adopt(*empty, {});
  const Vector3 tip(0.01, 0.0, 0.053);  // its centre is outside, the tip is not
  solver.step(tip, 0.0);
  const std::vector<SceneChange> changes = {{{1, 1}, geometry::float_box(geometry::bounds(*box))}};
  solver.adopt(*full, changes);
  const ScpState& state = solver.step(tip, 0.0);
  EXPECT_TRUE(state.touching);
  EXPECT_NEAR(state.scp.z(), 0.05 + radius, 1e-9);
}

// Pressed deep, a tip that goes on can send the SCP half round a solid of many small faces within a tick. How
// short a fall to the next face was, or a way that was stopped, says little about how far it glides then.
TEST(SphereTips, SendTheScpHalfRoundASolidInFewSteps) {
  for (const double radius : {0.0003, 0.0006, 0.001}) {
    for (const int frequency : {60, 80, 100}) {
      if (kSanitizerShare > 1 && frequency > 60 && radius > 0.0003) continue;
      const MeshPointer mesh = shared(geometry::bumpy_geodesic_sphere(frequency, 0.05, 0.0, 0));
      Toucher toucher(HapticScene::compile({object(1, shape_of(mesh, true, radius))}), radius);
      toucher.go({0.06, 0.001, 0.002}, {0.0005, 0.001, 0.002}, 400);
      const Vector3 tip(-0.03, 0.001, 0.002);
      const ScpState& state = toucher.step(tip);
      EXPECT_TRUE(state.converged);
      EXPECT_LT(state.iterations, 60) << radius << " " << frequency;
      EXPECT_LT((state.scp - tip).norm(), 0.02 + radius);
    }
  }
}

/// Does the piece hold a tip there?
bool holds_at(const Element& element, const Vector3& position, const Tolerance& tolerance) {
  return covers(element, position, tolerance) && height(element, position) < 0.5 * tolerance.gap;
}

// Compared with looking at many places of the way, one after the other.
TEST(SphereTips, MeetEdgesAndCornersWhereTheyAre) {
  const double radius = 0.004;
  const ScenePointer scene = HapticScene::compile({object(1, shape_of(rough_ball(8, 0.02), true, radius))});
  Random random(8);
  ContactRegion region;
  std::vector<Element> elements(ContactRegion::kElements);
  int met = 0, ended_there = 0;
  for (int i = 0; i < repeats(2000); ++i) {
    const Vector3 start = random.uniform(0.050, 0.058) * random.direction();
    const Vector3 step = random.uniform(0.001, 0.006) * random.direction();
    region.start(*scene, {Vector3::Zero(), radius}, start, start + step, 0.001);
    scene->gather(region);
    const Tolerance& tolerance = region.tolerance();
    const std::size_t count = region.around(start, 0.01, elements);
    for (const Element& element : std::span(elements).first(count)) {
      if (!element.guarded || holds_at(element, start, tolerance)) continue;
      const std::optional<double> t = sweep(element, start, step, tolerance);
      if (t) {
        const Vector3 at = start + *t * step;
        ASSERT_TRUE(covers(element, at, tolerance)) << i;
        ASSERT_LT(height(element, at), 1.01 * tolerance.gap) << i;
        ++met;
      }
      if (!holds_at(element, start + step, tolerance)) continue;
      ++ended_there;
      if (!t) {  // only who comes in deep, from behind the pieces beside this one, is let through
        double share = 0.0;
        while (!holds_at(element, start + share * step, tolerance)) share += 0.005;
        ASSERT_LT(height(element, start + share * step), -edge_dip(radius)) << i;
        continue;
      }
      for (double share = 0.005; share < *t; share += 0.005)
        ASSERT_FALSE(holds_at(element, start + share * step, tolerance)) << i;
    }
  }
  EXPECT_GT(met, repeats(400));
  EXPECT_GT(ended_there, repeats(100));
}

// The pieces beside an edge hold a tip out before it comes round to the edge, but for a hair. Parts of scans
// that are folded through themselves hold nobody from behind: who comes from there is deep in the edge.
TEST(SphereTips, PassAnEdgeThatTheyAreDeepInFromBehind) {
  const double radius = 1e-3;
  Element edge;
  edge.kind = Element::Kind::Rod;
  edge.guarded = true;
  edge.origin = Vector3(-0.01, 0.0, 0.0);
  edge.axis = Vector3::UnitX();
  edge.a = 0.02;
  edge.u = -Vector3::UnitY();  // holds where y is not below 0
  edge.radius = edge.tip = radius;
  const Tolerance tolerance = Tolerance::for_size(0.1);
  const auto meets = [&](double height) {
    return sweep(edge, {0.0, -1e-4, height}, {0.0, 2e-4, -1e-5}, tolerance).has_value();
  };
  EXPECT_TRUE(meets(radius));
  EXPECT_TRUE(meets(radius - edge_dip(radius)));
  EXPECT_FALSE(meets(0.99 * radius - edge_dip(radius)));
  EXPECT_FALSE(meets(0.5 * radius));
}

}  // namespace
}  // namespace icome::haptics
