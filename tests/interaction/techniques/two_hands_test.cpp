#include "interaction/techniques/two_hands.h"

#include "interaction/techniques/similarity.h"
#include "interaction/techniques/technique_cases.h"

namespace icome::interaction {
namespace {

using HandPair = std::array<Pose, 2>;

HandPair hands_at(const Vector3& left, const Vector3& right) { return {pose_at(left), pose_at(right)}; }

TEST(TwoHands, MoveByHowTheirMiddleMoves) {
  TwoHandGrip grip({}, hands_at({-0.2, 1.0, -0.4}, {0.2, 1.0, -0.4}), Vector3::Zero());
  const Vector3 offset(0.3, -0.1, 0.25);
  grip.follow(hands_at(Vector3(-0.2, 1.0, -0.4) + offset, Vector3(0.2, 1.0, -0.4) + offset));
  EXPECT_TRUE(grip.moved().isApprox(base::Affine3(Eigen::Translation3d(offset)), 1e-15));
}

TEST(TwoHands, GrowByHowFarTheyPart) {
  TwoHandGrip grip({}, hands_at({-0.1, 1.0, -0.4}, {0.1, 1.0, -0.4}), Vector3::Zero());
  grip.follow(hands_at({-0.25, 1.0, -0.4}, {0.25, 1.0, -0.4}));
  EXPECT_DOUBLE_EQ(grip.growth(), 2.5);
  EXPECT_TRUE(grip.moved().isApprox(scaled_about({0.0, 1.0, -0.4}, 2.5), 1e-15));
}

TEST(TwoHands, TurnAsOneRigidThing) {
  // Also about the line between them, and about an axis far away, in 500 steps.
  base::Random random(6);
  for (int i = 0; i < 20; ++i) {
    const HandPair start = {random_pose(random), random_pose(random)};
    const Vector3 axis = random.direction();
    const Vector3 through = random.direction();
    TwoHandGrip grip({}, start, Vector3::Zero());
    base::Affine3 turned = base::Affine3::Identity();
    for (int step = 1; step <= 500; ++step) {
      turned =
          Eigen::Translation3d(through) * turn_about(axis, 0.004 * step) * Eigen::Translation3d(-through);
      grip.follow({carried_by(turned, start[0]), carried_by(turned, start[1])});
    }
    EXPECT_TRUE(grip.moved().isApprox(turned, 1e-11)) << i;
  }
}

TEST(TwoHands, DoOnlyWhatTheyMay) {
  const HandPair start = hands_at({-0.1, 1.0, -0.4}, {0.1, 1.0, -0.4});
  const HandPair end = hands_at({0.2, 1.0, -0.7}, {0.2, 1.0, -0.1});  // moved, turned and parted
  const Vector3 pivot(0.5, 0.0, 0.0);
  for (int choice = 0; choice < 8; ++choice) {
    TwoHandSettings settings;
    settings.moves = choice & 1;
    settings.turns = choice & 2;
    settings.scales = choice & 4;
    TwoHandGrip grip(settings, start, pivot);
    grip.follow(end);
    const base::Affine3 moved = grip.moved();
    EXPECT_NEAR(scale_of(moved), settings.scales ? 3.0 : 1.0, 1e-12);
    const Vector3 right = moved.linear().col(0).normalized();
    EXPECT_TRUE(
        right.isApprox(settings.turns ? Vector3(Vector3::UnitZ()) : Vector3(Vector3::UnitX()), 1e-12));
    if (settings.moves) {
      EXPECT_TRUE((moved * Vector3(0.0, 1.0, -0.4)).isApprox(Vector3(0.2, 1.0, -0.4), 1e-12));
    } else {
      EXPECT_TRUE((moved * pivot).isApprox(pivot, 1e-12));
    }
  }
}

TEST(TwoHands, ThatMeetDoNoHarm) {
  TwoHandGrip grip({}, hands_at({0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}), Vector3::Zero());
  grip.follow(hands_at({0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}));
  EXPECT_TRUE(grip.moved().isApprox(base::Affine3::Identity()));
  grip.follow(hands_at({-0.1, 1.0, 0.0}, {0.1, 1.0, 0.0}));
  grip.follow(hands_at({0.1, 1.0, 0.0}, {-0.1, 1.0, 0.0}));  // swapped at once
  EXPECT_TRUE(grip.moved().matrix().allFinite());
  EXPECT_NEAR(std::abs(grip.turn().w()), 0.0, 1e-9);  // half a turn
}

}  // namespace
}  // namespace icome::interaction
