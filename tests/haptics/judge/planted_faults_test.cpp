// A judge is worth what it finds: known faults are planted between a sound solver and the judge, one at a
// time, and each must be found; of the sound solver, nothing. The solver has the budgets of the product.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>

#include "geometry/csg/csg_solid.h"
#include "geometry/implicit/implicit_surface.h"
#include "geometry/implicit/plain_formula.h"
#include "haptics/contact_world.h"
#include "haptics/judge/contact_judge.h"
#include "haptics/judge/plain_solid.h"
#include "haptics/shapes/smooth_shape.h"

namespace icome::haptics {
namespace {

using Path = std::vector<Vector3>;

constexpr double kTop = 0.05;        // m, the height of what is touched first in all worlds
constexpr double kFaultTick = 1e-3;  // s
constexpr double kPress = 0.0031;    // m; no tick lies just at the height of the top
constexpr double kRise = 0.02;       // m/s
constexpr double kBallTip = 1e-3;    // m
constexpr double kStiffness = 1000.0;

/// What is touched, as the solver and as the judge know it, and the way of the tip.
struct TouchedWorld {
  std::vector<HapticObject> objects;
  std::vector<JudgedObject> judged;
  Path path;
  double radius = 0.0;
};

void go(Path& path, const Vector3& to, double step) {
  const Vector3 from = path.back();
  const int count = std::max(1, int((to - from).norm() / step));
  for (int i = 1; i <= count; ++i) path.push_back(from + (double(i) / count) * (to - from));
}

/// Down onto the top, along it, a rest, over an edge, back through the air, and a stab of 10 mm a tick.
Path round_tour() {
  Path path{{0.0, 0.0, kTop + 0.006}};
  go(path, {0.0, 0.0, kTop - kPress}, 1e-4);
  go(path, {0.03, 0.02, kTop - kPress}, 1e-4);
  path.insert(path.end(), 20, path.back());
  go(path, {0.053, 0.02, kTop - kPress}, 1e-4);
  go(path, {0.053, 0.02, kTop + 0.03}, 1e-3);
  go(path, {0.01, 0.0, kTop + 0.03}, 1e-3);
  go(path, {0.01, 0.0, kTop - 0.03}, 1e-2);
  go(path, {0.01, 0.0, kTop + 0.01}, 1e-2);
  return path;
}

void add(TouchedWorld& world, const MeshPointer& mesh, const Pose& pose = Pose::Identity()) {
  world.objects.push_back(object(std::uint32_t(world.objects.size()), shape_of(mesh), pose));
  world.judged.push_back({mesh, pose});
}

TouchedWorld block() {
  TouchedWorld world;
  add(world, shared(box_mesh(Vector3::Constant(2.0 * kTop))));
  world.path = round_tour();
  return world;
}

/// A plate of 1 mm.
TouchedWorld plate() {
  TouchedWorld world;
  add(world, shared(box_mesh({0.1, 0.1, 0.001})), translation(0.0, 0.0, kTop - 0.0005));
  world.path = round_tour();
  return world;
}

/// The tour upside down, from behind a sheet.
TouchedWorld sheet_from_behind() {
  const MeshPointer mesh = shared(height_field(0.1, 8, [](double, double) { return kTop; }));
  TouchedWorld world;
  world.objects.push_back(object(0, shape_of(mesh, false), Pose::Identity(), TouchableSides::Both));
  world.judged.push_back({mesh, Pose::Identity(), false, true});
  world.path = round_tour();
  for (Vector3& tip : world.path) tip.z() = 2.0 * kTop - tip.z();
  return world;
}

/// Two primitives, of which the second is met on the way along the first.
TouchedWorld ball_on_block() {
  TouchedWorld world;
  const geometry::Primitive base = primitive("box:0.1x0.1x0.1"), ball = primitive("sphere:0.01");
  const Pose place = translation(0.03, 0.02, kTop);
  world.objects = {object(0, shape_of(base)), object(1, shape_of(ball), place)};
  world.judged = {{base}, {ball, place}};
  world.path = round_tour();
  return world;
}

TouchedWorld block_with_ball_tip() {
  TouchedWorld world = block();
  world.objects[0].shape = shape_of(std::get<0>(world.judged[0].surface), true, kBallTip);
  world.radius = kBallTip;
  return world;
}

TouchedWorld start_inside() {
  TouchedWorld world = block();
  world.path = {{0.01, 0.02, kTop - 0.005}};
  go(world.path, {0.02, 0.02, kTop - 0.004}, 1e-4);
  go(world.path, {0.02, 0.02, kTop + 0.005}, 1e-4);
  return world;
}

/// Sinks by half a micrometre a tick.
TouchedWorld slow_descent() {
  TouchedWorld world = block();
  world.path = {{0.01, 0.02, kTop + 1e-6}};
  go(world.path, {0.01, 0.02, kTop - 0.6e-3}, 0.5e-6);
  return world;
}

/// A block that rises under a tip that holds still.
TouchedWorld lift() {
  TouchedWorld world = block();
  world.objects[0].motion.linear = kRise * Vector3::UnitZ();
  world.judged[0].motion = [](double time) {
    return translation(0.0, 0.0, kRise * std::min(time, Motion::kHorizon));
  };
  world.path.assign(130, Vector3(0.01, 0.02, kTop + 0.5e-3));
  return world;
}

/// The surface of a formula that rises under a tip that holds still.
TouchedWorld tide() {
  const std::string formula = "z - 0.05 - 0.01*t - 0.001*sin(40*x)";
  const base::Bounds box(Vector3(-0.1, -0.1, -0.1), Vector3(0.1, 0.1, 0.1));
  TouchedWorld world;
  world.objects = {
      object(0, std::make_shared<SmoothShape>(*geometry::ImplicitSurface::create(formula, box)))};
  const geometry::PlainFormula value = *geometry::plain_formula(formula);
  world.judged = {
      {MembershipSolid{[value](const Vector3& p, double time) { return value(p, time) < 0.0; }, box}}};
  world.path.assign(400, Vector3(0.01, 0.02, kTop + 0.001));
  return world;
}

geometry::CsgTree cube_tree(bool pierced) {
  geometry::CsgTree tree;
  const auto cube = tree.add_leaf(primitive("box:0.1x0.1x0.1"));
  if (!pierced) return tree;
  const auto hole =
      tree.add_leaf(primitive("cylinder:0.008x0.2"), base::Affine3(Eigen::Translation3d(0.015, 0.01, 0.0)));
  tree.add(geometry::CsgOperator::Difference, cube, hole);
  return tree;
}

std::shared_ptr<const Shape> smooth(const geometry::CsgTree& tree) {
  return std::make_shared<SmoothShape>(std::make_shared<const geometry::CsgSolid>(tree));
}

/// A cube, with a hole in the way or without.
TouchedWorld cube_of_tree(bool pierced) {
  const geometry::CsgTree tree = cube_tree(pierced);
  TouchedWorld world;
  world.objects = {object(0, smooth(tree))};
  world.judged = {{plain_solid(tree)}};
  world.path = round_tour();
  return world;
}
TouchedWorld pierced_cube() { return cube_of_tree(true); }
TouchedWorld whole_cube() { return cube_of_tree(false); }

/// What the judge hears of a tick.
struct Answer {
  Vector3 scp;
  bool touching;
  Vector3 force;
};

Answer told(const ScpState& state, const Vector3& tip) {
  return {state.scp, state.touching,
          state.touching ? Vector3(kStiffness * (state.scp - tip)) : Vector3::Zero()};
}

/// A solver, sound or not.
using Answering = std::function<Answer(ScpSolver& solver, const Vector3& tip, double elapsed)>;

Answer sound(ScpSolver& solver, const Vector3& tip, double elapsed) {
  return told(solver.step(tip, elapsed), tip);
}

/// Sound, but for what becomes of its answer.
Answering spoilt(std::function<void(Answer& answer, const Vector3& tip)> spoil) {
  return [=](ScpSolver& solver, const Vector3& tip, double elapsed) {
    Answer answer = sound(solver, tip, elapsed);
    spoil(answer, tip);
    return answer;
  };
}

/// Sound, but for what is done to the solver before.
Answering disturbed(std::function<void(ScpSolver& solver, const Vector3& tip)> disturb) {
  return [=](ScpSolver& solver, const Vector3& tip, double elapsed) {
    disturb(solver, tip);
    return sound(solver, tip, elapsed);
  };
}

/// What the fault does; each call gives one without memories.
using MakeFault = std::function<Answering()>;

/// How often the judge found something of one kind.
using Finding = std::uint64_t (ContactJudge::*)() const;

struct PlantedFault {
  const char* name;
  TouchedWorld (*world)();
  Finding found;  // what it must be found as
  MakeFault answering = [] { return Answering(sound); };
  std::function<void(TouchedWorld&)> misread = {};  // what the solver believes of the world

  friend std::ostream& operator<<(std::ostream& out, const PlantedFault& it) { return out << it.name; }
};

Answer untouched(const Vector3& tip) { return {tip, false, Vector3::Zero()}; }

Answering lets_everything_through() {
  return [](ScpSolver&, const Vector3& tip, double) { return untouched(tip); };
}

Answering forgets_fast_ways() {
  return disturbed([last = Vector3(0, 0, 1)](ScpSolver& solver, const Vector3& tip) mutable {
    if ((tip - last).norm() > 5e-3) solver.reset();
    last = tip;
  });
}

Answering forgets_slow_ways() {
  return [last = Vector3(0, 0, 1)](ScpSolver& solver, const Vector3& tip, double elapsed) mutable {
    const bool slow = (tip - last).norm() < 1e-6;
    last = tip;
    return slow && !solver.state().touching ? untouched(tip) : sound(solver, tip, elapsed);
  };
}

Answering forgets_every_way() {
  return disturbed([](ScpSolver& solver, const Vector3&) { solver.reset(); });
}

Answering yields_to_a_hard_press() {
  return disturbed([](ScpSolver& solver, const Vector3& tip) {
    if ((solver.state().scp - tip).norm() > 0.9 * kPress) solver.reset();
  });
}

Answering lags() {
  return spoilt([past = std::vector<Answer>()](Answer& answer, const Vector3&) mutable {
    past.push_back(answer);
    answer = past[past.size() > 20 ? past.size() - 21 : 0];
  });
}

Answering stays_where_it_touched() {
  return spoilt([held = std::optional<Vector3>()](Answer& answer, const Vector3&) mutable {
    if (!answer.touching) held.reset();
    if (answer.touching && !held) held = answer.scp;
    if (held) answer.scp = *held;
  });
}

Answering is_caught_at_a_vertex() {
  return spoilt([caught = false](Answer& answer, const Vector3&) mutable {
    const Vector3 vertex(0.012, 0.008, kTop + 1e-9);
    caught = answer.touching && (caught || (answer.scp - vertex).norm() < 1e-4);
    if (caught) answer.scp = vertex;
  });
}

Answering does_not_let_go() {
  return spoilt([last = std::optional<Answer>(), left = 0](Answer& answer, const Vector3&) mutable {
    if (answer.touching) {
      last = answer;
      left = 30;
    } else if (last && left-- > 0) {
      answer = *last;
    }
  });
}

Answering skips_ticks() {
  return [tick = 0, last = std::optional<Answer>()](ScpSolver& solver, const Vector3& tip,
                                                    double elapsed) mutable {
    if (!last || tick++ % 12 == 0) last = sound(solver, tip, elapsed);
    return *last;
  };
}

Answering does_not_notice_a_start_inside() {
  return [outside = false](ScpSolver& solver, const Vector3& tip, double elapsed) mutable {
    outside = outside || tip.z() > kTop;
    return outside ? sound(solver, tip, elapsed) : untouched(tip);
  };
}

Answering stands_still_in_time() {
  return [](ScpSolver& solver, const Vector3& tip, double) { return sound(solver, tip, 0.0); };
}

Answering gives_no_force() {
  return spoilt([](Answer& answer, const Vector3&) { answer.force.setZero(); });
}
Answering turns_the_force_round() {
  return spoilt([](Answer& answer, const Vector3&) { answer.force = -answer.force; });
}
Answering tells_no_touch() {
  return spoilt([](Answer& answer, const Vector3&) { answer.touching = false; });
}

/// Puts the SCP so far (m) from its place towards the tip.
MakeFault shifted(double towards_tip) {
  return [towards_tip] {
    return spoilt([towards_tip](Answer& answer, const Vector3& tip) {
      if (answer.touching) answer.scp += towards_tip * (tip - answer.scp).normalized();
    });
  };
}

MeshPointer mesh_of(const TouchedWorld& world) { return std::get<0>(world.judged[0].surface); }

void leaves_out_a_triangle(TouchedWorld& world) {
  TriangleMesh torn = *mesh_of(world);
  std::erase_if(torn.triangles, [&](const TriangleMesh::Triangle& triangle) {
    return std::all_of(triangle.begin(), triangle.end(),
                       [&](std::uint32_t corner) { return torn.positions[corner].z() > 0.0; });
  });
  world.objects[0].shape = shape_of(shared(torn), false);
}
void shrinks_it(TouchedWorld& world) {
  world.objects[0].shape = shape_of(shared(scaled(*mesh_of(world), 0.98)));
}
void ignores_its_pose(TouchedWorld& world) { world.objects[0].world_from_object = Pose::Identity(); }
void ignores_the_second_object(TouchedWorld& world) { world.objects.pop_back(); }
void ignores_the_back(TouchedWorld& world) { world.objects[0].surface.sides = TouchableSides::Front; }
void takes_a_point_for_a_ball(TouchedWorld& world) { world.radius = 0.0; }
void adds_friction(TouchedWorld& world) {
  world.objects[0].surface.static_friction = world.objects[0].surface.dynamic_friction = 2.0;
}
void fills_the_hole(TouchedWorld& world) { world.objects[0].shape = smooth(cube_tree(false)); }
void drills_a_hole(TouchedWorld& world) { world.objects[0].shape = smooth(cube_tree(true)); }

constexpr auto kPops = &ContactJudge::pops;
constexpr auto kSticks = &ContactJudge::sticks;
constexpr auto kSilent = &ContactJudge::silent;
constexpr auto kPulls = &ContactJudge::pulls;
const MakeFault kSound = [] { return Answering(sound); };

std::vector<PlantedFault> planted_faults() {
  return {{"LetsEverythingThrough", block, kPops, lets_everything_through},
          {"LetsEverythingThroughInSilence", whole_cube, kSilent, lets_everything_through},
          {"ForgetsFastWays", plate, kPops, forgets_fast_ways},
          {"ForgetsSlowWays", slow_descent, kSilent, forgets_slow_ways},
          {"ForgetsEveryWay", plate, kPops, forgets_every_way},
          {"YieldsToAHardPress", plate, kPops, yields_to_a_hard_press},
          {"Lags", block, kSticks, lags},
          {"StaysWhereItTouched", ball_on_block, kSticks, stays_where_it_touched},
          {"IsCaughtAtAVertex", block, kSticks, is_caught_at_a_vertex},
          {"DoesNotLetGo", pierced_cube, kSticks, does_not_let_go},
          {"SkipsTicks", block, kSticks, skips_ticks},
          {"DoesNotNoticeAStartInside", start_inside, kSilent, does_not_notice_a_start_inside},
          {"IgnoresMotion", lift, kPops, stands_still_in_time},
          {"IgnoresTime", tide, kPops, stands_still_in_time},
          {"GivesNoForce", block, kSilent, gives_no_force},
          {"TurnsTheForceRound", block, kPulls, turns_the_force_round},
          {"TellsNoTouch", whole_cube, kSilent, tells_no_touch},
          {"LiesTooDeep", ball_on_block, kPops, shifted(0.5e-3)},
          {"HangsInTheAir", whole_cube, kSticks, shifted(-0.5e-3)},
          {"LeavesOutATriangle", block, kPops, kSound, leaves_out_a_triangle},
          {"ShrinksIt", block, kPops, kSound, shrinks_it},
          {"IgnoresItsPose", plate, kPops, kSound, ignores_its_pose},
          {"IgnoresTheSecondObject", ball_on_block, kPops, kSound, ignores_the_second_object},
          {"IgnoresTheBack", sheet_from_behind, kPops, kSound, ignores_the_back},
          {"TakesAPointForABall", block_with_ball_tip, kPops, kSound, takes_a_point_for_a_ball},
          {"AddsFriction", block, kSticks, kSound, adds_friction},
          {"FillsTheHole", pierced_cube, kSticks, kSound, fills_the_hole},
          {"DrillsAHole", whole_cube, kPops, kSound, drills_a_hole}};
}

/// The judge's findings on a solver that believes in `believed` while `true_world` is judged: to the end of
/// the path, or until something is `found`.
ContactJudge judged_run(const TouchedWorld& true_world, const TouchedWorld& believed, Answering answering,
                        Finding found = nullptr) {
  JudgeSettings settings;
  settings.tip_radius = true_world.radius;
  ContactJudge judge(true_world.judged, settings);
  const ScenePointer scene = HapticScene::compile(believed.objects);
  ScpSettings budgets;
  budgets.tip_radius = believed.radius;
  ScpSolver solver(budgets);
  solver.adopt(*scene, {});
  for (std::size_t i = 0; i < true_world.path.size(); ++i) {
    const Vector3& tip = true_world.path[i];
    const double elapsed = kFaultTick * double(i);
    const Answer answer = answering(solver, tip, elapsed);
    judge.judge({tip, answer.scp, answer.touching, elapsed, answer.force});
    if (found && (judge.*found)() > 0) break;
  }
  return judge;
}

class PlantedFaultsOfEachKind : public testing::TestWithParam<PlantedFault> {};

INSTANTIATE_TEST_SUITE_P(All, PlantedFaultsOfEachKind, testing::ValuesIn(planted_faults()),
                         [](const auto& it) { return std::string(it.param.name); });

TEST_P(PlantedFaultsOfEachKind, AreFound) {
  const PlantedFault& fault = GetParam();
  const TouchedWorld world = fault.world();
  TouchedWorld believed = world;
  if (fault.misread) fault.misread(believed);
  const ContactJudge angry = judged_run(world, believed, fault.answering(), fault.found);
  EXPECT_GT((angry.*fault.found)(), 0u);
}

TEST(PlantedFaults, AreNotSeenInTheSoundSolver) {
  std::set<TouchedWorld (*)()> worlds;
  for (const PlantedFault& fault : planted_faults()) worlds.insert(fault.world);
  for (const auto make : worlds) {
    const TouchedWorld world = make();
    const ContactJudge judge = judged_run(world, world, sound);
    EXPECT_EQ(judge.ticks(), world.path.size());
    EXPECT_EQ(judge.pops() + judge.sticks() + judge.silent() + judge.pulls(), 0u)
        << "pops " << judge.pops() << ", sticks " << judge.sticks() << ", silent " << judge.silent()
        << ", pulls " << judge.pulls();
  }
}

}  // namespace
}  // namespace icome::haptics
