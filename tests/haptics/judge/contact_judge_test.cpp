// The judge must find what is planted and nothing else: tip and SCP are made by hand here, no solver runs.
#include "haptics/judge/contact_judge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/mesh/geodesic_sphere.h"
#include "haptics/contact_world.h"
#include "repeats.h"

namespace icome::haptics {
namespace {

JudgedObject solid(std::string_view text) { return {primitive(text)}; }
JudgedObject solid(const MeshPointer& mesh, const Pose& pose = Pose::Identity()) { return {mesh, pose}; }
JudgedObject samples(std::string_view text) {
  const geometry::Primitive it = primitive(text);
  return {MembershipSolid{[it](const Vector3& p, double) { return geometry::inside(it, p); },
                          geometry::bounds(it)}};
}
JudgedObject sheet(const MeshPointer& mesh) { return {mesh, Pose::Identity(), false, true}; }
MeshPointer flat_sheet() {
  return shared(height_field(0.1, 8, [](double, double) { return 0.0; }));
}

/// The same solid in the ways in which a judge may know one.
std::vector<JudgedObject> boxes() {
  return {solid("box:0.1x0.1x0.1"), solid(shared(box_mesh({0.1, 0.1, 0.1}))), samples("box:0.1x0.1x0.1")};
}
std::vector<JudgedObject> walls() {
  return {solid("box:0.1x0.1x0.001"), solid(shared(box_mesh({0.1, 0.1, 0.001}))),
          samples("box:0.1x0.1x0.001")};
}

ContactJudge judge_of(const std::vector<JudgedObject>& objects, double tip_radius = 0.0,
                      double friction = 0.0) {
  JudgeSettings settings;
  settings.tip_radius = tip_radius;
  settings.static_friction = friction;
  return {objects, settings};
}

bool fine(const Judgement& judgement) { return judgement.fine(); }

TEST(ContactJudge, PassesFreeMotionAndAPerfectPress) {
  for (const JudgedObject& box : boxes()) {
    ContactJudge judge = judge_of({box});
    for (int i = 0; i <= 100; ++i) {
      const Vector3 tip(0.01, 0.02, 0.06 - 0.0002 * i);
      Vector3 scp = tip;
      scp.z() = std::max(tip.z(), 0.05);
      EXPECT_TRUE(fine(judge.judge({tip, scp, tip.z() < 0.05}))) << i;
    }
    EXPECT_EQ(judge.ticks(), 101u);
  }
}

TEST(ContactJudge, CountsEveryTickInsideASolid) {
  for (const JudgedObject& box : boxes()) {
    ContactJudge judge = judge_of({box});
    judge.judge({{0, 0, 0.051}, {0, 0, 0.051}, false});
    for (int i = 0; i < 5; ++i) judge.judge({{0, 0, 0.045}, {0, 0, 0.0496}, true});  // 0.4 mm
    EXPECT_EQ(judge.pops(), 5u);
    EXPECT_EQ(judge.sticks(), 0u);
  }
}

TEST(ContactJudge, ForgivesAShallowerPenetration) {
  for (const JudgedObject& box : boxes()) {
    ContactJudge judge = judge_of({box});
    judge.judge({{0, 0, 0.051}, {0, 0, 0.051}, false});
    judge.judge({{0, 0, 0.0498}, {0, 0, 0.0498}, true});  // 0.2 mm
    EXPECT_EQ(judge.pops(), 0u);
  }
}

TEST(ContactJudge, SeesInsideWhereSolidsOverlap) {
  const MeshPointer cross =
      shared(joined(box_mesh({0.1, 0.03, 0.03}), box_mesh({0.03, 0.1, 0.03}), Vector3(0.001, 0.002, 0.003)));
  ContactJudge judge = judge_of({solid(cross)});
  EXPECT_TRUE(judge.judge({{0.001, 0.002, 0.003}, {0.001, 0.002, 0.003}, false})
                  .pop);  // in both: parity would say outside
  EXPECT_FALSE(judge.judge({{0.04, 0.04, 0.0}, {0.04, 0.04, 0.0}, false}).pop);
}

TEST(ContactJudge, CatchesATipThatWentThroughAThinWall) {
  for (const JudgedObject& wall : walls()) {
    ContactJudge judge = judge_of({wall});
    judge.judge({{0, 0, -0.001}, {0, 0, 0.0005 + 1e-12}, true});
    EXPECT_TRUE(judge.judge({{0, 0, -0.005}, {0, 0, -0.005}, false}).pop);
    EXPECT_FALSE(judge.judge({{0, 0, -0.006}, {0, 0, -0.006}, false}).pop);  // once
  }
}

TEST(ContactJudge, ApprovesAPressThroughAThinWall) {
  for (const JudgedObject& wall : walls()) {
    ContactJudge judge = judge_of({wall});
    for (int i = 0; i < 50; ++i) {
      EXPECT_TRUE(fine(judge.judge({{0, 0, 0.0005 - 1e-4 * i}, {0, 0, 0.0005 + 1e-12}, true}))) << i;
    }
  }
}

TEST(ContactJudge, CatchesASheetLeftByTheOtherSide) {
  ContactJudge judge = judge_of({sheet(flat_sheet())});
  EXPECT_TRUE(fine(judge.judge({{0.003, 0.001, 0.002}, {0.003, 0.001, 0.002}, false})));
  EXPECT_TRUE(fine(judge.judge({{0.003, 0.001, -0.002}, {0.003, 0.001, 1e-12}, true})));
  EXPECT_TRUE(judge.judge({{0.003, 0.001, -0.002}, {0.003, 0.001, -0.002}, false}).pop);
}

TEST(ContactJudge, CatchesASheetPassedInSmallSteps) {
  ContactJudge judge = judge_of({sheet(flat_sheet())});
  for (int i = 0; i < 40; ++i) {  // 0.05 mm each, from 1 mm in front to 1 mm behind
    const Vector3 tip(0.003, 0.001, 0.001 - 5e-5 * i);
    judge.judge({tip, tip, false});
  }
  EXPECT_EQ(judge.pops(), 1u);
}

TEST(ContactJudge, ForgivesATipThatDipsInAndComesBack) {
  ContactJudge judge = judge_of({sheet(flat_sheet())});
  for (const double z : {0.001, 0.0002, -0.0002, 0.0002, 0.001})
    judge.judge({{0.003, 0.001, z}, {0.003, 0.001, z}, false});
  EXPECT_EQ(judge.pops(), 0u);
}

TEST(ContactJudge, ApprovesTheWayRoundARim) {
  ContactJudge judge = judge_of({sheet(flat_sheet())});
  judge.judge({{0.0495, 0.0, -0.0005}, {0.0495, 0.0, 1e-12}, true});
  EXPECT_TRUE(fine(judge.judge({{0.0505, 0.0, -0.001}, {0.0505, 0.0, -0.001}, false})));
  EXPECT_TRUE(fine(judge.judge({{0.0485, 0.0, -0.001}, {0.0485, 0.0, -0.001}, false})));
}

TEST(ContactJudge, ApprovesALongSlideOffAnEdge) {
  // Pressed deep at one face, the tip leaves by the next: within a tick the SCP goes round the edge.
  for (const bool two_sided : {false, true}) {
    JudgedObject wall = solid(shared(box_mesh({0.1, 0.1, 0.001})));
    wall.two_sided = two_sided;
    ContactJudge judge = judge_of({wall});
    judge.judge({{0.0444922, -0.00673525, -0.000492117}, {0.050000000005, -0.00673525, -0.000492117}, true});
    EXPECT_TRUE(
        fine(judge.judge({{0.0435711, -0.0067274, -0.0005018}, {0.0435711, -0.0067274, -0.0005018}, false})));
  }
}

/// A pipe that winds down like a spiral stair, felt from within; open at both ends.
struct Spiral {
  static constexpr double kRadius = 0.02;  // m, of the stair
  static constexpr double kPitch = 0.008;
  static constexpr double kPipe = 0.002;
  static constexpr int kSides = 24;
  static constexpr int kRings = 600;  // six turns

  static Vector3 axis(double turns) {
    const double angle = 6.283185307179586 * turns;
    return {kRadius * std::cos(angle), kRadius * std::sin(angle), -kPitch * turns};
  }
  /// So far (m) below the axis of the pipe.
  static Vector3 below(double turns, double depth) {
    const Vector3 along = (axis(turns + 1e-4) - axis(turns - 1e-4)).normalized();
    const Vector3 out = Vector3(axis(turns).x(), axis(turns).y(), 0.0).normalized();
    return axis(turns) + depth * along.cross(out).normalized();
  }

  static MeshPointer mesh() {
    TriangleMesh mesh;
    for (int i = 0; i < kRings; ++i) {
      const double turns = 0.01 * i;
      const Vector3 down = (below(turns, 1.0) - axis(turns)).normalized();
      const Vector3 out = Vector3(axis(turns).x(), axis(turns).y(), 0.0).normalized();
      for (int j = 0; j < kSides; ++j) {
        const double angle = 6.283185307179586 * j / kSides;
        mesh.positions.push_back(axis(turns) + kPipe * (std::cos(angle) * down + std::sin(angle) * out));
      }
    }
    const auto at = [](int i, int j) { return std::uint32_t(i * kSides + j % kSides); };
    for (int i = 0; i + 1 < kRings; ++i) {
      for (int j = 0; j < kSides; ++j) {
        mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      }
    }
    return shared(mesh);
  }
};

/// Judges an SCP that runs down four turns of the pipe in one tick.
TEST(ContactJudge, FindsALongWayWithinATick) {
  constexpr double kTurns = kSanitizerShare > 1 ? 1.0 : 4.0;
  for (const bool two_sided : {false, true}) {
    ContactJudge judge = judge_of({{Spiral::mesh(), Pose::Identity(), false, two_sided}});
    const double depth = Spiral::kPipe - 1e-8;
    const Vector3 tip(0.0, 0.0, -1.0), from = Spiral::below(1.0, depth),
                                       to = Spiral::below(1.0 + kTurns, depth);
    judge.judge({from, from, false});
    const Judgement judgement = judge.judge({tip, to, true});
    EXPECT_FALSE(judgement.pop) << two_sided;
    EXPECT_FALSE(judgement.unjudged) << two_sided;
  }
}

TEST(ContactJudge, KnowsAFastStabThroughAWallForAPop) {
  for (const double radius : {0.0, 0.002}) {
    for (const bool two_sided : {false, true}) {
      JudgedObject wall = solid(shared(box_mesh({0.1, 0.1, 0.001})));
      wall.two_sided = two_sided;
      ContactJudge judge = judge_of({wall}, radius);
      judge.judge({{0, 0, 0.02}, {0, 0, 0.02}, false});
      const Judgement judgement = judge.judge({{0.005, 0, -0.02}, {0.005, 0, -0.02}, false});
      EXPECT_TRUE(judgement.pop);
      EXPECT_FALSE(judgement.unjudged);
    }
  }
}

/// A flat sheet with a hole, too small for a ball of 2 mm to come through, 9 mm beside its middle.
MeshPointer sheet_with_a_hole() {
  TriangleMesh mesh = height_field(0.1, 40, [](double, double) { return 0.0; });
  const base::Bounds hole(Vector3(7.5e-3, 5e-3, -1.0), Vector3(10e-3, 7.5e-3, 1.0));
  std::erase_if(mesh.triangles, [&](const TriangleMesh::Triangle& it) {
    const auto& at = mesh.positions;
    return hole.contains(Vector3((at[it[0]] + at[it[1]] + at[it[2]]) / 3.0));
  });
  return shared(mesh);
}

/// Judges an SCP that is found on the other side of what lies in the plane z = 0.
Judgement judgement_of_passage(const std::vector<JudgedObject>& objects, double tip_radius) {
  const Vector3 from(1e-4, 5e-5, 0.006), to(1e-4, 5e-5, -0.004);
  ContactJudge judge = judge_of(objects, tip_radius);
  judge.judge({from, from, false});
  return judge.judge({to, to, false});
}

TEST(ContactJudge, LeavesUnjudgedWhatTakesTooLongToTellOfAMesh) {
  // The hole lies in the ball around the tip that the SCP was on, so that the sheet surely parts nothing
  // there; and the space above has more places to look at than a search may.
  const Judgement judgement = judgement_of_passage({sheet(sheet_with_a_hole())}, 0.002);
  EXPECT_TRUE(judgement.unjudged);
  EXPECT_FALSE(judgement.pop);
}

TEST(ContactJudge, CountsAPopThroughWhatIsNoMeshAlsoWithinARoom) {
  const JudgedObject wall = samples("box:0.1x0.1x0.001");
  const JudgedObject room = sheet(shared(box_mesh({1.0, 1.0, 1.0})));
  for (const std::vector<JudgedObject>& objects : {std::vector{wall}, std::vector{wall, room}}) {
    const Judgement judgement = judgement_of_passage(objects, 0.0);
    EXPECT_TRUE(judgement.pop) << objects.size();
    EXPECT_FALSE(judgement.unjudged) << objects.size();
  }
}

// A sphere tip under a ceiling rests on a ridge that leaves it 2 um too little room for some hundredths of a
// millimetre, and room enough before and behind.
TEST(ContactJudge, SeesWhatIsInTheWayOfASphereTipBetweenTwoFreePlaces) {
  const double radius = 1e-3, below = radius - 2e-6;
  const double ahead = std::sqrt(radius * radius - below * below);
  const auto ridge = [&](double deeper) {
    return solid(shared(
        prism({{ahead - 1e-4, -2e-3}, {ahead + 1e-4, -2e-3}, {ahead, -below - deeper}}, {{0, 1, 2}}, 0.1)));
  };
  JudgedObject ceiling = solid(shared(box_mesh({0.1, 0.001, 0.1})));
  ceiling.world_from_object.translation().y() = radius + 5e-4;
  for (const double deeper : {0.0, 4e-6}) {
    ContactJudge judge({ridge(deeper), ceiling}, {.tip_radius = radius});
    judge.judge({{-0.001, 0.0, 0.0}, {-0.001, 0.0, 0.0}, false});
    const Judgement judgement = judge.judge({{0.0004, 0.0, 0.0}, {0.0, 0.0, 0.0}, true});
    EXPECT_EQ(judgement.stick || judgement.late, deeper > 0.0) << deeper;
  }
}

TEST(ContactJudge, CatchesAContactWithNothingInTheWay) {
  for (const JudgedObject& box : boxes()) {
    ContactJudge judge = judge_of({box});
    EXPECT_TRUE(judge.judge({{0, 0, 0.06}, {0, 0, 0.05 + 1e-12}, true}).stick);
  }
}

TEST(ContactJudge, CatchesAnScpAwayFromTheTipWithoutAContact) {
  for (const JudgedObject& box : boxes()) {
    ContactJudge judge = judge_of({box});
    EXPECT_TRUE(judge.judge({{0, 0, 0.045}, {0, 0, 0.05 + 1e-12}, false}).stick);
  }
}

TEST(ContactJudge, CatchesAnScpThatLagsBehind) {
  for (const JudgedObject& box : boxes()) {
    for (const double radius : {0.0, 0.001}) {
      ContactJudge judge = judge_of({box}, radius);
      const double z = 0.05 + radius + 1e-12;
      EXPECT_TRUE(fine(judge.judge({{0, 0, z - 0.002}, {0, 0, z}, true})));
      EXPECT_TRUE(judge.judge({{0.004, 0, z - 0.002}, {0, 0, z}, true}).stick);
      EXPECT_TRUE(fine(judge.judge({{0.004, 0, z - 0.002}, {0.004, 0, z}, true})));
    }
  }
}

// The SCP comes nearer to a tip that is still by 2 mm a tick.
TEST(ContactJudge, LetsAnScpBeLateForFiveTicks) {
  for (const JudgedObject& box : boxes()) {
    ContactJudge judge = judge_of({box});
    const Vector3 tip(0.02, 0.0, 0.049);
    for (int i = 0; i <= 6; ++i) {
      const Judgement judgement = judge.judge({tip, {-0.03 + 2e-3 * i, 0.0, 0.05}, true});
      EXPECT_EQ(judgement.late, i >= 1 && i <= 5) << i;
      EXPECT_EQ(judgement.stick, i < 1 || i == 6) << i;
    }
    EXPECT_EQ(judge.late(), 5U);
  }
}

TEST(ContactJudge, LetsFrictionHoldWithinItsCone) {
  for (const JudgedObject& box : boxes()) {
    ContactJudge judge = judge_of({box}, 0.0, 0.5);
    EXPECT_TRUE(fine(judge.judge({{0.00095, 0, 0.048}, {0, 0, 0.05 + 1e-12}, true})));
    EXPECT_TRUE(judge.judge({{0.003, 0, 0.048}, {0, 0, 0.05 + 1e-12}, true}).stick);
  }
}

TEST(ContactJudge, LetsAConcaveCornerHold) {
  const MeshPointer step = shared(prism({{0, 0}, {.06, 0}, {.06, .02}, {.02, .02}, {.02, .06}, {0, .06}},
                                        {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}, 0.05));
  ContactJudge judge = judge_of({solid(step)});
  EXPECT_TRUE(fine(judge.judge({{0.017, 0.012, 0.003}, {0.02 + 1e-12, 0.02 + 1e-12, 0.003}, true})));
  EXPECT_TRUE(judge.judge({{0.017, 0.012, 0.006}, {0.02 + 1e-12, 0.02 + 1e-12, 0.003}, true})
                  .stick);  // along the corner
}

TEST(ContactJudge, LetsASphereRestInAGrooveTooNarrowForIt) {
  // A V of 4 degrees: a 1 mm ball rests where it touches both walls.
  const double slope = std::tan(1.5358897417550099);  // 88 degrees
  const MeshPointer groove =
      shared(height_field(0.02, 2, [&](double x, double) { return slope * std::abs(x); }));
  JudgedObject v = sheet(groove);
  ContactJudge judge = judge_of({v}, 0.001);
  const double rest = 0.001 / std::cos(1.5358897417550099);
  EXPECT_TRUE(fine(judge.judge({{0, 0.001, rest - 0.004}, {0, 0.001, rest + 1e-9}, true})));
  EXPECT_TRUE(judge.judge({{0, 0.001, rest - 0.004}, {0, 0.001, rest + 0.001}, true}).stick);
}

TEST(ContactJudge, CatchesASphereThatOverlaps) {
  for (const JudgedObject& box : boxes()) {
    ContactJudge judge = judge_of({box}, 0.005);
    EXPECT_FALSE(judge.judge({{0, 0, 0.054}, {0, 0, 0.0548}, true}).pop);
    EXPECT_TRUE(judge.judge({{0, 0, 0.054}, {0, 0, 0.0545}, true}).pop);
  }
}

TEST(ContactJudge, LetsASphereStandBehindAFrontTouchedSheet) {
  JudgedObject front{flat_sheet(), Pose::Identity(), false, false};
  ContactJudge judge = judge_of({front}, 0.005);
  EXPECT_TRUE(fine(judge.judge({{0, 0, -0.002}, {0, 0, -0.002}, false})));
  EXPECT_TRUE(fine(judge.judge({{0, 0, 0.006}, {0, 0, 0.006}, false})));  // out through the back is free
  EXPECT_TRUE(judge.judge({{0, 0, 0.002}, {0, 0, 0.002}, false}).pop);
}

TEST(ContactJudge, HearsAllObjectsAndTheirPoses) {
  const MeshPointer box = shared(box_mesh({0.1, 0.1, 0.1}));
  Pose turned = translation(0.3, 0.0, 0.0);
  turned.linear() = Eigen::AngleAxisd(0.7853981633974483, Vector3::UnitY()).toRotationMatrix();
  ContactJudge judge = judge_of({solid(box), solid(box, turned)});
  const double top = 0.05 * std::sqrt(2.0);
  EXPECT_TRUE(fine(judge.judge({{0.3, 0.0, top + 0.001}, {0.3, 0.0, top + 0.001}, false})));
  EXPECT_TRUE(judge.judge({{0.3, 0.0, top - 0.002}, {0.3, 0.0, top - 0.002}, false}).pop);
  EXPECT_TRUE(judge.judge({{0.0, 0.0, 0.045}, {0.0, 0.0, 0.045}, false}).pop);
}

/// Is a tip pulled so far (m) into the top of a box of that size (m) a pop?
bool pops_in_box(double size, double depth, const Vector3& place = Vector3::Zero(),
                 const std::vector<JudgedObject>& others = {}) {
  std::vector<JudgedObject> objects = others;
  objects.push_back(
      solid(shared(box_mesh(Vector3::Constant(size))), translation(place.x(), place.y(), place.z())));
  ContactJudge judge = judge_of(objects);
  const Vector3 top = place + 0.5 * size * Vector3::UnitZ();
  judge.judge({top, top + 1e-9 * size * Vector3::UnitZ(), true});
  return judge.judge({top - 2.0 * depth * Vector3::UnitZ(), top - depth * Vector3::UnitZ(), true}).pop;
}

TEST(ContactJudge, ShrinksItsLengthsToTinyObjects) {
  EXPECT_TRUE(pops_in_box(1e-4, 0.011 * 1e-4 * std::sqrt(3.0)));
  EXPECT_FALSE(pops_in_box(1e-4, 0.009 * 1e-4 * std::sqrt(3.0)));
}

TEST(ContactJudge, MeasuresALargeSceneByWhatIsNear) {
  const JudgedObject far = solid(shared(box_mesh(Vector3::Ones())), translation(1e6, 0.0, 0.0));
  for (const double size : {0.1, 10.0, 2000.0}) {
    EXPECT_TRUE(pops_in_box(size, 0.31e-3)) << size;
    EXPECT_FALSE(pops_in_box(size, 0.29e-3)) << size;
    EXPECT_TRUE(pops_in_box(size, 0.31e-3, Vector3::Zero(), {far})) << size;
    EXPECT_TRUE(pops_in_box(size, 0.31e-3, Vector3(0.0, 3e5, -1e5))) << size;
  }
}

TEST(ContactJudge, HearsNothingOfATipInside) {
  for (const JudgedObject& box : boxes()) {
    ContactJudge judge = judge_of({box});
    EXPECT_TRUE(judge.judge({{0, 0, 0.045}, {0, 0, 0.045}, false}).silent);
    EXPECT_FALSE(judge.judge({{0, 0, 0.0498}, {0, 0, 0.0498}, false}).silent);  // 0.2 mm
    EXPECT_FALSE(judge.judge({{0, 0, 0.051}, {0, 0, 0.051}, false}).silent);
    EXPECT_EQ(judge.silent(), 1u);
  }
}

TEST(ContactJudge, HearsNoForceButLetsDampingUseItUp) {
  for (const JudgedObject& box : boxes()) {
    ContactJudge judge = judge_of({box});
    const Vector3 scp(0, 0, 0.05 + 1e-12), none = Vector3::Zero();
    EXPECT_TRUE(judge.judge({{0, 0, 0.045}, scp, true, 0.0, Vector3(0, 0, 3)}).fine());
    EXPECT_TRUE(judge.judge({{0, 0, 0.045}, scp, true, 0.0, none}).silent);   // at rest
    EXPECT_TRUE(judge.judge({{0, 0, 0.044}, scp, true, 0.0, none}).silent);   // deeper
    EXPECT_FALSE(judge.judge({{0, 0, 0.046}, scp, true, 0.0, none}).silent);  // on its way out
  }
}

TEST(ContactJudge, CatchesAForceThatPulls) {
  ContactJudge judge = judge_of({solid("box:0.1x0.1x0.1")});
  const Vector3 tip(0, 0, 0.045), scp(0, 0, 0.05 + 1e-12);
  EXPECT_FALSE(judge.judge({tip, scp, true, 0.0, Vector3(0, 0, 2)}).pull);
  EXPECT_FALSE(judge.judge({tip, scp, true, 0.0, Vector3(0, 0, -2)}).pull);
  EXPECT_FALSE(judge.judge({tip, scp, true, 0.0, Vector3(0, 0, -2)}).pull);
  EXPECT_TRUE(judge.judge({tip, scp, true, 0.0, Vector3(0, 0, -2)}).pull);
  EXPECT_TRUE(judge.judge({tip, scp, true, 0.0, Vector3(0, 0, -2)}).pull);
  EXPECT_FALSE(judge.judge({tip, scp, true, 0.0, Vector3(0, 0, -1)}).pull);  // it comes round
  EXPECT_EQ(judge.pulls(), 2u);
}

TEST(ContactJudge, FollowsAnObjectThatMoves) {
  for (JudgedObject box : boxes()) {
    box.motion = [](double time) { return translation(0.0, 0.0, 0.1 * (time + 2.0)); };
    ContactJudge judge = judge_of({box});
    const Vector3 tip(0.01, 0.02, 0.055);
    for (int i = 0; i < 300; ++i) {
      const double time = -2.0 + 0.001 * i, top = 0.05 + 0.1 * (time + 2.0);
      const Vector3 scp(0.01, 0.02, std::max(tip.z(), top + 1e-12));
      EXPECT_TRUE(judge.judge({tip, scp, top > tip.z(), time}).fine()) << i;
    }
    const Vector3 old(0.01, 0.02, 0.05 + 1e-12);  // where its top was at first
    EXPECT_TRUE(judge.judge({tip, old, true, -1.7}).pop);
  }
}

TEST(ContactJudge, ToleratesTheRoundingOfATraceFile) {
  ContactJudge judge = judge_of({solid(shared(geometry::bumpy_geodesic_sphere(17, 0.05, 0.0, 0)))});
  const MeshPointer mesh = shared(geometry::bumpy_geodesic_sphere(17, 0.05, 0.0, 0));
  for (int i = 0; i < 200; ++i) {
    const Vector3 direction = Vector3(std::cos(0.01 * i), std::sin(0.01 * i), 0.2).normalized();
    Vector3 scp = brute_nearest(*mesh, 0.048 * direction).point;
    scp = (scp * 1e8).array().round() / 1e8;
    EXPECT_TRUE(fine(judge.judge({0.048 * direction, scp, true}))) << i;
  }
}

// Everything at once: a good run along a bumpy sphere with 40 mistakes planted in it.
TEST(ContactJudge, FindsExactlyThePlantedMistakes) {
  const MeshPointer mesh = shared(geometry::bumpy_geodesic_sphere(12, 0.05, 0.0, 0));
  ContactJudge judge = judge_of({solid(mesh)});
  Random random(3);
  std::uint64_t pops = 0, sticks = 0;
  for (int i = 0; i < 400; ++i) {
    const Vector3 direction = Vector3(std::cos(0.004 * i), std::sin(0.004 * i), 0.3).normalized();
    const Vector3 tip = 0.047 * direction;
    const BruteNearest nearest = brute_nearest(*mesh, tip);
    const Vector3 out = (nearest.point - tip).normalized();
    Vector3 scp = nearest.point + 1e-12 * out;
    if (i % 20 == 7) scp -= out * random.uniform(0.35e-3, 1.5e-3);
    if (i % 20 == 17) scp += out * random.uniform(0.4e-3, 1.5e-3);
    const Judgement judgement = judge.judge({tip, scp, true});
    EXPECT_EQ(judgement.pop, i % 20 == 7) << i;
    EXPECT_EQ(judgement.stick, i % 20 == 17) << i;
    pops += i % 20 == 7;
    sticks += i % 20 == 17;
  }
  EXPECT_EQ(judge.pops(), pops);
  EXPECT_EQ(judge.sticks(), sticks);
}

}  // namespace
}  // namespace icome::haptics
