// The judge on solids of which only membership is known. The tip is followed by brute force (csg_brute.h),
// slowly and rightly, and mistakes are planted in that: no solver runs.
#include <gtest/gtest.h>

#include "haptics/csg_brute.h"
#include "haptics/csg_world.h"
#include "haptics/judge/contact_judge.h"
#include "haptics/judge/plain_solid.h"

namespace icome::haptics {
namespace {

constexpr double kPressedSize = 0.1;  // m

JudgedObject judged_by_samples(const CsgTree& tree) { return {plain_solid(tree)}; }

bool approved(const Judgement& judgement) { return judgement.fine(); }

/// An SCP that follows a tip by brute force, in steps that are short against everything.
class BruteFollower {
 public:
  BruteFollower(const BruteSolid& solid, const Vector3& start) : solid_(solid), place_(start) {}

  Vector3 follow(const Vector3& tip) {
    const Vector3 start = place_;
    const double way = (tip - start).norm();
    Vector3 free = start;  // straight on as far as that goes
    for (double t = 0.0; way > 0.0;) {
      const Vector3 there = start + std::min(1.0, t / way) * (tip - start);
      if (solid_.inside(there)) break;
      free = there;
      if (t >= way) break;
      t += std::max(solid_.bound(there), 1e-8);
    }
    for (place_ = free;;) {  // every search looks a little way
      const ScpError found = brute_scp_error(solid_, tip, place_, kPressedSize);
      place_ = found.rest;
      if (found.error < 1e-9 * kPressedSize) return place_;
    }
  }

 private:
  const BruteSolid& solid_;
  Vector3 place_;
};

struct Press {
  const char* name;
  CsgTree tree;
  Vector3 start, deep, end;  // m; the tip goes from start to deep, then to end

  friend std::ostream& operator<<(std::ostream& out, const Press& it) { return out << it.name; }
};

class MembershipJudge : public testing::TestWithParam<Press> {};

INSTANTIATE_TEST_SUITE_P(
    Presses, MembershipJudge,
    testing::Values(
        Press{
            "RoundedCube", figure_5_6(), {0.036, 0.01, 0.06}, {0.036, 0.008, 0.045}, {0.036, -0.016, 0.045}},
        Press{"IntoTheHole", figure_5_6(), {0.01, 0.003, 0.02}, {0.029, 0.003, 0.02}, {0.029, -0.015, 0.03}},
        Press{"OverTheRimOfTheHole",
              figure_5_6(),
              {0.03, 0, 0.052},
              {0.03, 0.002, 0.047},
              {0.01, 0.002, 0.046}},
        Press{"StepAndRise",
              nasty::stairs().tree,
              {-0.032, 0, 0.02},
              {-0.025, 0.004, 0.005},
              {-0.024, -0.015, 0.012}},
        Press{"OverAnEdge", nasty::stairs().tree, {0.01, 0, 0.045}, {0.012, 0, 0.035}, {0.0, 0.003, 0.036}},
        Press{"ThinWall",
              nasty::thin_walls().tree,
              {0.006, 0.03, 0},
              {-0.004, 0.03, 0.001},
              {-0.004, 0.034, 0.004}},
        Press{"CornerOfPocket",
              nasty::flush_pocket().tree,
              {0.015, 0.015, 0.01},
              {0.023, 0.022, -0.003},
              {0.024, 0.018, -0.004}},
        Press{"Spike",
              nasty::spikes().tree,
              {0.015, 0.0005, 0.06},
              {0.015, 0.001, 0.045},
              {0.013, 0.001, 0.04}},
        Press{"CrossedHoles",
              nasty::crossed_holes().tree,
              {0, 0, 0.03},
              {0.016, 0.017, 0.026},
              {0.017, 0.016, 0.02}}),
    [](const auto& it) { return std::string(it.param.name); });

int ticks_of_press() { return std::max(6, repeats(25)); }

std::vector<Vector3> path_of(const Press& press) {
  std::vector<Vector3> path;
  const int ticks = ticks_of_press();
  for (int i = 0; i <= ticks; ++i)
    path.push_back(press.start + (double(i) / ticks) * (press.deep - press.start));
  for (int i = 1; i <= ticks; ++i)
    path.push_back(press.deep + (double(i) / ticks) * (press.end - press.deep));
  return path;
}

TEST_P(MembershipJudge, ApprovesWhatBruteForceFindsAndNothingElse) {
  const Press& press = GetParam();
  const BruteSolid solid(press.tree);
  ASSERT_FALSE(solid.inside(press.start));
  BruteFollower follower(solid, press.start);
  ContactJudge pleased({judged_by_samples(press.tree)}, {});
  ContactJudge angry({judged_by_samples(press.tree)}, {});
  std::uint64_t touching = 0, planted = 0;
  for (const Vector3& tip : path_of(press)) {
    const Vector3 scp = follower.follow(tip);
    const double pull = (tip - scp).norm();
    touching += pull > 1e-9;
    EXPECT_TRUE(approved(pleased.judge({tip, scp, pull > 1e-9})))
        << pleased.ticks() << " pops " << pleased.pops() << " tip " << tip.transpose() << " scp "
        << scp.transpose();
    Vector3 wrong = scp;
    if (pull > 2e-3 && pleased.ticks() % 3 == 2) wrong += 0.8e-3 * (scp - tip) / pull;  // hangs in the air
    if (solid.inside(wrong)) wrong = scp;
    const Judgement judgement = angry.judge({tip, wrong, pull > 1e-9});
    EXPECT_EQ(judgement.stick || judgement.late, wrong != scp) << pleased.ticks();
    planted += wrong != scp;
  }
  EXPECT_GT(touching, std::uint64_t(ticks_of_press() / 3));
  EXPECT_TRUE(planted > 0 || kSanitizerShare > 1);
  EXPECT_EQ(angry.pops(), 0u);
}

TEST(JudgeBySamples, CatchesAPassageThroughAThinWall) {
  ContactJudge judge({judged_by_samples(nasty::thin_walls().tree)}, {});
  EXPECT_TRUE(approved(judge.judge({{-0.002, 0.03, 0.01}, {0.0001 + 1e-11, 0.03, 0.01}, true})));
  EXPECT_TRUE(judge.judge({{-0.002, 0.03, 0.01}, {-0.002, 0.03, 0.01}, false}).pop);
  EXPECT_TRUE(approved(judge.judge({{-0.003, 0.03, 0.01}, {-0.003, 0.03, 0.01}, false})));  // once
}

TEST(JudgeBySamples, CatchesAnScpThatWasPulledIn) {
  const CsgTree tree = figure_5_6();
  ContactJudge judge({judged_by_samples(tree)}, {});
  EXPECT_TRUE(approved(judge.judge({{0.04, 0, 0.045}, {0.04, 0, 0.05 + 1e-11}, true})));
  EXPECT_TRUE(judge.judge({{0.04, 0, 0.045}, {0.04, 0, 0.0496}, true}).pop);
  EXPECT_TRUE(judge.judge({{0.04, 0, 0.045}, {0.04, 0, 0.045}, false}).pop);
}

TEST(JudgeBySamples, ApprovesAHandThatIsCarriedByAWave) {
  const auto height = [](const Vector3& p, double time) {
    return 0.005 * std::sin(60.0 * p.x() + 6.0 * time);
  };
  MembershipSolid sea{[&](const Vector3& p, double time) { return p.z() <= height(p, time); },
                      base::Bounds(Vector3(-0.1, -0.1, -0.05), Vector3(0.1, 0.1, 0.006))};
  ContactJudge judge({{sea}}, {});
  for (int i = 0; i < 500; ++i) {
    const double time = 0.002 * i;
    const Vector3 tip(0.02, 0.01, -0.01);
    Vector3 scp = tip;  // straight downhill in the distance: a bisection of its derivative along the profile
    double low = -0.02, high = 0.06;
    for (int k = 0; k < 60; ++k) {
      const double x = 0.5 * (low + high), z = 0.005 * std::sin(60.0 * x + 6.0 * time);
      ((x - tip.x()) + (z - tip.z()) * 0.3 * std::cos(60.0 * x + 6.0 * time) > 0.0 ? high : low) = x;
    }
    scp.x() = low;
    scp.z() = height(scp, time) + 1e-11;
    EXPECT_FALSE(judge.judge({tip, scp, true, time}).pop) << i;
  }
  EXPECT_TRUE(judge.judge({{0.02, 0.01, -0.01}, {0.02, 0.01, -0.01}, false, 1.0}).pop);
}

TEST(JudgeBySamples, CatchesASphereThatOverlaps) {
  JudgeSettings settings;
  settings.tip_radius = 0.005;
  ContactJudge judge({judged_by_samples(figure_5_6())}, settings);
  EXPECT_FALSE(judge.judge({{0.036, 0, 0.054}, {0.036, 0, 0.0548}, true}).pop);
  EXPECT_TRUE(judge.judge({{0.036, 0, 0.054}, {0.036, 0, 0.0545}, true}).pop);
}

TEST(JudgeBySamples, ApprovesASphereHeldByAShellThatIsThinnerThanItIsPressed) {
  const CsgTree tree = TreeChain(ball_shape(0.03)).cut(ball_shape(0.0299)).tree();
  JudgeSettings settings;
  settings.tip_radius = 0.002;
  ContactJudge judge({judged_by_samples(tree)}, settings);
  for (int i = 0; i < 20; ++i) {
    const Vector3 out = Vector3(0.1 * i, 1.0, 0.3).normalized();
    EXPECT_TRUE(approved(judge.judge({0.025 * out, (0.032 + 1e-11) * out, true}))) << i;
  }
  const Vector3 away = Vector3(1.0, 0.0, 0.3).normalized();
  EXPECT_TRUE(judge.judge({0.025 * Vector3(0.0, 1.0, 0.3).normalized(), 0.0325 * away, true}).stick);
}

TEST(JudgeBySamples, KnowsWhetherASphereCouldMoveInASlit) {
  constexpr double kRadius = 0.002, kHalf = 0.00015;
  const CsgTree tree = TreeChain(box_shape(0.06, 0.06, 0.06))
                           .cut(box_shape(2.0 * kHalf, 0.08, 0.06), moved(0.0, 0.0, 0.02))
                           .tree();
  JudgeSettings settings;
  settings.tip_radius = kRadius;
  ContactJudge judge({judged_by_samples(tree)}, settings);
  const double height = 0.03 + std::sqrt(kRadius * kRadius - kHalf * kHalf) + 1e-11;
  for (int i = 0; i < 100; ++i) {
    const double y = 1e-4 * i;
    EXPECT_TRUE(approved(judge.judge({{0.0005, y, 0.029}, {0.0, y, height}, true}))) << i;
  }
  EXPECT_EQ(judge.judge({{0.0005, 0.012, 0.029}, {0.0, 0.01, height}, true}).stick, true);
  EXPECT_TRUE(judge.judge({{0.0, 0.01, 0.025}, {0.0, 0.01, height - 0.0004}, true}).pop);
}

TEST(JudgeBySamples, ApprovesASmallSphereBesideASlit) {
  // At rest on the flat, where the nearest place of the way into the slit would be the slit's edge.
  constexpr double kRadius = 0.0001, kHalf = 0.00015;
  const CsgTree tree = TreeChain(box_shape(0.06, 0.06, 0.06))
                           .cut(box_shape(2.0 * kHalf, 0.08, 0.06), moved(0.0, 0.0, 0.02))
                           .tree();
  JudgeSettings settings;
  settings.tip_radius = kRadius;
  ContactJudge judge({judged_by_samples(tree)}, settings);
  for (int i = 0; i < 100; ++i) {
    const double x = kHalf + 1e-6 * (100 - i), y = 0.0088 + 5e-6 * i;
    EXPECT_TRUE(approved(judge.judge({{x, y, 0.026}, {x, y, 0.03 + kRadius + 1e-11}, true}))) << i;
  }
}

}  // namespace
}  // namespace icome::haptics
