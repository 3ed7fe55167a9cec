#include "interaction/techniques/selecting.h"

#include "interaction/techniques/similarity.h"
#include "interaction/techniques/technique_cases.h"

namespace icome::interaction {
namespace {

const base::Affine3 kAtHome = base::Affine3::Identity();

TargetId meant(Selecting selecting, const TechniqueInput& input, const TechniqueScene& scene,
               const base::Affine3& world_from_room = kAtHome) {
  return pointed_at(selecting, {}, input, 0, world_from_room, scene).id;
}

TEST(Selecting, JdcadTakesWhatIsNearestToTheAxisThenWhatIsNearest) {
  // Off the axis by atan(0.02), atan(0.025), atan(0.1): 0.0200, 0.0250 and 0.0997 rad.
  const Vector3 hand(0.0, 1.3, 0.0);
  const auto at = [&](double x, double z) { return Vector3(hand + Vector3(x, 0.0, z)); };
  const TechniqueInput input = person_with(pose_at(hand));
  const TechniqueScene scene =
      scene_of({ball_target(1, at(0.06, -3.0), 0.01), ball_target(2, at(0.05, -2.0), 0.01),
                ball_target(3, at(0.05, -0.5), 0.01)});
  SelectingSettings settings;
  settings.same_angle = 0.01;
  // 1 is nearest to the axis, 2 as good as that and nearer; 3 is nearest, but farther off.
  EXPECT_EQ(pointed_at(Selecting::Spotlight, settings, input, 0, kAtHome, scene).id, 2u);
  settings.same_angle = 0.004;
  EXPECT_EQ(pointed_at(Selecting::Spotlight, settings, input, 0, kAtHome, scene).id, 1u);
  settings.same_angle = 0.08;
  EXPECT_EQ(pointed_at(Selecting::Spotlight, settings, input, 0, kAtHome, scene).id, 3u);
  settings.same_angle = 0.01;
  settings.spotlight = 0.01;
  EXPECT_EQ(pointed_at(Selecting::Spotlight, settings, input, 0, kAtHome, scene).id, 0u);
}

TEST(Selecting, AHandTouchesWhatIsWithinItsSize) {
  const Vector3 hand(0.2, 1.3, -0.3);
  const TechniqueInput input = person_with(pose_at(hand));
  const double reach = 0.05 + SelectingSettings().hand_radius;
  EXPECT_EQ(meant(Selecting::VirtualHand, input,
                  scene_of({ball_target(4, hand + (reach - 1e-9) * Vector3::UnitX())})),
            4u);
  EXPECT_EQ(meant(Selecting::VirtualHand, input,
                  scene_of({ball_target(4, hand + (reach + 1e-9) * Vector3::UnitX())})),
            0u);
}

TEST(Selecting, GoGoTouchesBeyondTheArm) {
  const SelectingSettings settings;
  TechniqueInput input = person_with(Pose::Identity());
  const Vector3 chest = chest_of(settings.go_go, input.room_from_head);
  const Vector3 far = chest + Vector3(0.3, 0.2, -1.3);
  const TechniqueScene scene = scene_of({ball_target(1, far)});
  input.hands[0].room_from_hand.translation() = go_go_hand_for(settings.go_go, chest, far);
  EXPECT_LT((input.hands[0].room_from_hand.translation() - chest).norm(), settings.go_go.arm);
  EXPECT_EQ(meant(Selecting::GoGo, input, scene), 1u);
  EXPECT_EQ(meant(Selecting::VirtualHand, input, scene), 0u);
}

TEST(Selecting, ARayMeetsTheFirstAndTellsWhere) {
  const Vector3 hand(0.0, 1.3, 0.0);
  const TechniqueScene scene = scene_of(
      {ball_target(1, hand + Vector3(0.0, 0.0, -3.0)), ball_target(2, hand + Vector3(0.0, 0.0, -2.0))});
  const PointedAt pointed =
      pointed_at(Selecting::RayPointer, {}, person_with(pose_at(hand)), 0, kAtHome, scene);
  EXPECT_EQ(pointed.id, 2u);
  EXPECT_TRUE(pointed.point.isApprox(hand + Vector3(0.0, 0.0, -1.95), 1e-12));
  // The eyes, a little higher, see the second over the first one's edge: each has its own ray.
  TechniqueInput looking = person_with(pose_at(hand, turn_about(Vector3::UnitY(), 2.0)));
  looking.room_from_head.linear() = turn_about(Vector3::UnitX(), -std::atan2(0.3, 2.0));
  EXPECT_EQ(meant(Selecting::LookAt, looking, scene), 2u);
  EXPECT_EQ(meant(Selecting::RayPointer, looking, scene), 0u);
}

TEST(Selecting, TheLookTakesWhatItPassesClosely) {
  const SelectingSettings settings;
  const TechniqueInput input = person_with(Pose::Identity());
  const Vector3 eyes = input.room_from_head.translation();
  const auto beside = [&](double angle) {
    return scene_of({ball_target(1, eyes + 2.0 * Vector3(std::sin(angle), 0.0, -std::cos(angle)), 0.02)});
  };
  EXPECT_EQ(meant(Selecting::LookAt, input, beside(settings.look_angle + 0.009)), 1u);
  EXPECT_EQ(meant(Selecting::LookAt, input, beside(settings.look_angle + 0.011)), 0u);
}

TEST(Selecting, TheMiniatureShowsEveryPlaceAndGivesItBack) {
  base::Random random(7);
  for (int i = 0; i < 100; ++i) {
    TechniqueInput input = person_with(random_pose(random));
    input.room_from_head = random_pose(random);
    input.hands[1].tracked = i % 2 == 0;
    input.hands[1].room_from_hand = random_pose(random);
    const base::Affine3 room =
        base::Affine3(random_pose(random, 5.0)) * Eigen::Scaling(random.uniform(0.5, 4.0));
    const base::Bounds bounds(Vector3(-3.0, 0.0, -2.0), Vector3(4.0, 2.5, 6.0));
    const MiniatureSettings settings;
    const base::Affine3 copy = copy_from_world(settings, bounds, input, room);
    const Vector3 place = 5.0 * random.direction();
    EXPECT_TRUE((copy.inverse() * (copy * place)).isApprox(place, 1e-11));
    // As long as it should be in the room, and without shear.
    EXPECT_NEAR(scale_of(copy) * 8.0, settings.size * scale_of(room), 1e-12);
    EXPECT_TRUE((copy.linear() / scale_of(copy)).isUnitary(1e-12));
    // Its floor's middle stands above the hand.
    if (!input.hands[1].tracked) continue;
    const Vector3 foot = room * (input.hands[1].room_from_hand * Vector3(0.0, settings.above_hand, 0.0));
    EXPECT_TRUE((copy * Vector3(0.5, 0.0, 2.0)).isApprox(foot, 1e-11));
  }
}

TEST(Selecting, TheMiniatureIsTouchedInsteadOfTheThing) {
  const TechniqueScene scene =
      scene_of({ball_target(1, Vector3(-4.0, 1.0, -5.0), 0.3), ball_target(2, Vector3(4.0, 1.0, -5.0), 0.3)});
  TechniqueInput input = person_with(Pose::Identity());
  const SelectingSettings settings;
  const base::Affine3 copy = copy_from_world(settings.miniature, scene.bounds(), input, kAtHome);
  for (const TargetId id : {TargetId{1}, TargetId{2}}) {
    const TargetBall ball = ball_of(*scene.find(id));
    const Vector3 shown = copy * ball.centre;
    EXPECT_LT((shown - input.room_from_head.translation()).norm(), 0.7);
    const double reach = scale_of(copy) * ball.radius + settings.finger_radius;
    input.hands[0].room_from_hand.translation() = shown + (reach - 1e-9) * Vector3::UnitY();
    EXPECT_EQ(meant(Selecting::Miniature, input, scene), id);
    input.hands[0].room_from_hand.translation() = shown + (reach + 1e-9) * Vector3::UnitY();
    EXPECT_EQ(meant(Selecting::Miniature, input, scene), 0u);
  }
}

TEST(Selecting, IsTheSameInARoomThatStandsElsewhere) {
  base::Random random(11);
  for (int i = 0; i < 200; ++i) {
    const base::Affine3 room =
        base::Affine3(random_pose(random, 5.0)) * Eigen::Scaling(random.uniform(0.2, 5.0));
    const TechniqueInput input = person_with(random_pose(random, 0.4));
    TechniqueScene home, away;
    for (TargetId id = 1; id <= 12; ++id) {
      SceneTarget target =
          ball_target(id, Vector3(0.0, 1.4, 0.0) + random.uniform(0.2, 1.0) * random.direction(), 0.1);
      EXPECT_TRUE(home.add(target));
      target.world_from_target = room * target.world_from_target;
      EXPECT_TRUE(away.add(target));
    }
    // The miniature shows a box along the world's axes, which turn with the room.
    for (const Selecting selecting : {Selecting::VirtualHand, Selecting::GoGo, Selecting::RayPointer,
                                      Selecting::Spotlight, Selecting::LookAt})
      EXPECT_EQ(meant(selecting, input, home), meant(selecting, input, away, room)) << name_of(selecting);
  }
}

TEST(Selecting, WithoutAHandOnlyTheEyesMeanAnything) {
  const TechniqueScene scene = scene_of({ball_target(1, Vector3(0.0, 1.6, -1.0))});
  TechniqueInput input = person_with(pose_at(Vector3(0.0, 1.6, -0.9)));
  input.hands[0].tracked = false;
  for (const Selecting selecting : kAllSelecting)
    EXPECT_EQ(meant(selecting, input, scene), selecting == Selecting::LookAt ? 1u : 0u) << name_of(selecting);
}

}  // namespace
}  // namespace icome::interaction
