#include "interaction/techniques/go_go.h"

#include <cmath>

#include "interaction/techniques/technique_cases.h"

namespace icome::interaction {
namespace {

TEST(GoGo, IsThePapersMappingInCentimetres) {
  const GoGoSettings settings;
  for (const double r_cm : {10.0, 46.0, 50.0, 60.0, 70.0}) {
    const double d_cm = 70.0 * 2.0 / 3.0;
    const double expected = r_cm < d_cm ? r_cm : r_cm + (r_cm - d_cm) * (r_cm - d_cm) / 6.0;
    EXPECT_NEAR(100.0 * go_go_reach(settings, r_cm / 100.0), expected, 1e-10) << r_cm;
  }
  // The stretched arm of 70 cm: 70 + 23.33^2 / 6.
  EXPECT_NEAR(go_go_reach(settings, 0.7), 1.6074074, 1e-7);
}

TEST(GoGo, IsSmoothWhereTheArmBeginsToGrow) {
  const GoGoSettings settings;
  const double d = settings.near_share * settings.arm;
  constexpr double kStep = 1e-6;
  EXPECT_NEAR(go_go_reach(settings, d + kStep) - go_go_reach(settings, d - kStep), 2.0 * kStep, 1e-10);
  EXPECT_DOUBLE_EQ(go_go_slope(settings, d), 1.0);
  EXPECT_DOUBLE_EQ(go_go_slope(settings, 0.5 * d), 1.0);
  for (double r = 0.3; r < 0.9; r += 0.013) {
    const double measured =
        (go_go_reach(settings, r + kStep) - go_go_reach(settings, r - kStep)) / (2.0 * kStep);
    EXPECT_NEAR(measured, go_go_slope(settings, r), 1e-4) << r;
  }
}

TEST(GoGo, KnowsWhereTheHandMustBe) {
  GoGoSettings settings;
  for (const double gain : {0.0, 1e-9, 100.0 / 6.0, 1e4}) {
    settings.gain = gain;
    for (double r = 0.0; r < 3.0; r += 0.07)
      EXPECT_NEAR(go_go_distance(settings, go_go_reach(settings, r)), r, 1e-12) << gain << " " << r;
  }
}

TEST(GoGo, TheVirtualHandIsInTheHandsDirection) {
  const GoGoSettings settings;
  base::Random random(4);
  const Vector3 chest(0.1, 1.3, 0.2);
  for (int i = 0; i < 200; ++i) {
    Pose hand = random_pose(random);
    hand.translation() += chest;
    const Pose mapped = go_go_hand(settings, chest, hand);
    EXPECT_EQ(mapped.linear(), hand.linear());
    const Vector3 way = hand.translation() - chest;
    EXPECT_NEAR((mapped.translation() - chest).cross(way).norm(), 0.0, 1e-12);
    EXPECT_GE((mapped.translation() - chest).norm(), way.norm() - 1e-15);
    EXPECT_TRUE(go_go_hand_for(settings, chest, mapped.translation()).isApprox(hand.translation(), 1e-12));
  }
  const Pose in_the_chest = pose_at(chest);
  EXPECT_EQ(go_go_hand(settings, chest, in_the_chest).translation(), chest);
}

}  // namespace
}  // namespace icome::interaction
