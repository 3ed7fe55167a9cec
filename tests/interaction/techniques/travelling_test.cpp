#include "interaction/techniques/travelling.h"

#include "interaction/techniques/similarity.h"
#include "interaction/techniques/technique_cases.h"

namespace icome::interaction {
namespace {

/// A person who travels while the test moves the hands.
class Journey {
 public:
  explicit Journey(Travelling travelling) {
    technique_.travelling = travelling;
    state_ = begun(technique_);
    input_ = person_with(pose_at({0.2, 1.2, -0.4}));
  }
  TechniqueInput& input() { return input_; }
  TechniqueScene& scene() { return scene_; }
  TechniqueState& state() { return state_; }
  Pose& hand(std::size_t which) { return input_.hands[which].room_from_hand; }
  void travel(bool down) {
    for (HandInput& hand : input_.hands) hand.travel = down && hand.tracked;
  }
  TechniqueOutcome go(double seconds = 0.01) {
    input_.time += seconds;
    TechniqueStep next = step(technique_, state_, input_, scene_);
    state_ = std::move(next.state);
    return next.outcome;
  }
  Pose eye() const { return carried_by(state_.world_from_room, input_.room_from_head); }
  Pose world_hand() const { return carried_by(state_.world_from_room, input_.hands[0].room_from_hand); }

 private:
  Technique technique_;
  TechniqueState state_;
  TechniqueInput input_;
  TechniqueScene scene_;
};

TEST(Travelling, OneFliesWhereTheHandPoints) {
  Journey journey(Travelling::Fly);
  journey.hand(0).linear() = turn_about(Vector3::UnitY(), -0.5 * EIGEN_PI);  // to +x
  journey.go();
  journey.travel(true);
  for (int i = 0; i < 100; ++i) journey.go();
  const Vector3 expected(0.2 * 10.0, 1.6, 0.0);  // 2 m/s for 1 s
  EXPECT_TRUE(journey.eye().translation().isApprox(expected, 1e-10));
  // The hand came along.
  EXPECT_TRUE((journey.world_hand().translation() - journey.eye().translation())
                  .isApprox(Vector3(0.2, -0.4, -0.4), 1e-10));
  journey.go(30.0);  // a pause carries nobody far
  EXPECT_LT((journey.eye().translation() - expected).norm(), 0.21);
  journey.travel(false);
  const Vector3 last = journey.eye().translation();
  journey.go();
  EXPECT_EQ(journey.eye().translation(), last);
}

TEST(Travelling, TwoHandsOrbitAndSetTheDistance) {
  Journey journey(Travelling::Orbit);
  const Vector3 centre(0.0, 1.6, -2.0);
  ASSERT_TRUE(journey.scene().add(ball_target(1, centre, 0.2)));
  ASSERT_TRUE(journey.scene().add(ball_target(2, Vector3(5.0, 0.0, 0.0), 0.2)));
  journey.state().selected = 1;
  journey.input().hands[1].tracked = true;
  journey.hand(0).translation() = Vector3(0.2, 1.2, -0.4);
  journey.hand(1).translation() = Vector3(-0.2, 1.2, -0.4);
  journey.travel(true);
  journey.go();
  EXPECT_TRUE(journey.eye().translation().isApprox(Vector3(0.0, 1.6, 0.0), 1e-12));
  constexpr double kAngle = 0.5;
  for (int i = 1; i <= 50; ++i) {
    for (std::size_t which = 0; which < 2; ++which) {
      const Vector3 from(which == 0 ? 0.2 : -0.2, 0.0, 0.0);
      journey.hand(which) =
          pose_at(Vector3(0.0, 1.2, -0.4) +
                      (1.0 + 0.5 * i / 50.0) * (turn_about(Vector3::UnitY(), kAngle * i / 50.0) * from),
                  turn_about(Vector3::UnitY(), kAngle * i / 50.0));
    }
    journey.go();
  }
  // The world turned with the hands, so the person went round the other way, 1.5 times as far away.
  const Vector3 expected = centre + 1.5 * (turn_about(Vector3::UnitY(), -kAngle) * Vector3(0.0, 0.0, 2.0));
  EXPECT_TRUE(journey.eye().translation().isApprox(expected, 1e-10));
  const Vector3 ahead = -journey.eye().linear().col(2);
  EXPECT_TRUE(ahead.isApprox((centre - expected).normalized(), 1e-10));
  const base::Affine3 room = journey.state().world_from_room;
  journey.travel(false);
  journey.go();
  journey.hand(0).translation() += Vector3(0.3, 0.0, 0.0);
  journey.go();
  EXPECT_EQ(journey.state().world_from_room.matrix(), room.matrix());
  journey.travel(true);
  journey.go();  // and begins again without a jump
  EXPECT_TRUE(journey.state().world_from_room.isApprox(room, 1e-12));
}

TEST(Travelling, ATeleportArrivesExactlyAndTakesTheHandsAlong) {
  Journey journey(Travelling::Teleport);
  journey.hand(0).linear() = turn_about(Vector3::UnitX(), -0.25 * EIGEN_PI);
  journey.travel(true);
  const TechniqueOutcome aimed = journey.go();
  ASSERT_TRUE(aimed.destination);
  // 1.2 m down and as far ahead.
  const Vector3 place(0.2, 1.6, -0.4 - 1.2);
  EXPECT_TRUE(aimed.destination->translation().isApprox(place, 1e-12));
  const Pose hand_from_eye = journey.world_hand().inverse() * journey.eye();
  journey.travel(false);
  journey.go();
  EXPECT_TRUE(journey.state().travel.arriving());
  double way = 0.0, longest = 0.0;
  Vector3 last = journey.eye().translation();
  for (int i = 0; i < 100; ++i) {
    journey.go();
    const double part = (journey.eye().translation() - last).norm();
    way += part;
    longest = std::max(longest, part);
    last = journey.eye().translation();
    EXPECT_TRUE((journey.world_hand().inverse() * journey.eye()).isApprox(hand_from_eye, 1e-12));
  }
  EXPECT_GT(way, 1.5);
  EXPECT_LT(longest, 0.15);  // no jump on the way
  journey.go();
  EXPECT_FALSE(journey.state().travel.arriving());
  EXPECT_TRUE(journey.eye().translation().isApprox(place, 1e-12));
  EXPECT_TRUE(journey.eye().linear().isApprox(base::Matrix3::Identity(), 1e-12));
}

TEST(Travelling, OneTeleportsBeforeThingsAndNotIntoTheSky) {
  const TravelSettings settings;
  const TechniqueScene scene = scene_of({ball_target(1, Vector3(0.0, 1.5, -5.0), 0.5)});
  const auto at_thing = teleport_place(scene, {Vector3(0.0, 1.5, 0.0), -Vector3::UnitZ()}, settings);
  ASSERT_TRUE(at_thing);
  EXPECT_TRUE(at_thing->isApprox(Vector3(0.0, 0.0, -4.5 + settings.stand_off), 1e-12));
  EXPECT_FALSE(teleport_place(scene, {Vector3(0.0, 1.5, 0.0), Vector3::UnitZ()}, settings));
  EXPECT_FALSE(
      teleport_place(scene, {Vector3(0.0, 1.5, 0.0), Vector3(0.0, -0.001, 1.0).normalized()}, settings));
  EXPECT_FALSE(teleport_place(scene, {Vector3(0.0, 1.5, 0.0), Vector3::UnitY()}, settings));
}

TEST(Travelling, TheLikenessInTheMiniatureLeadsTheWay) {
  Journey journey(Travelling::Miniature);
  ASSERT_TRUE(journey.scene().add(ball_target(1, Vector3(-5.0, 1.0, -5.0), 1.0)));
  ASSERT_TRUE(journey.scene().add(ball_target(2, Vector3(5.0, 1.0, 5.0), 1.0)));
  const base::Affine3 copy =
      copy_from_world({}, journey.scene().bounds(), journey.input(), base::Affine3::Identity());
  journey.hand(0) = carried_by(copy, journey.eye());
  journey.go();
  journey.travel(true);
  journey.go();
  const Vector3 goal(3.0, 1.6, 2.0);
  journey.hand(0) = pose_at(copy * goal, turn_about(Vector3::UnitY(), 0.8));
  const TechniqueOutcome moved = journey.go();
  ASSERT_TRUE(moved.destination);
  EXPECT_TRUE(moved.destination->isApprox(pose_at(goal, turn_about(Vector3::UnitY(), 0.8)), 1e-10));
  EXPECT_TRUE(journey.eye().isApprox(journey.input().room_from_head, 1e-12));  // not yet there
  journey.travel(false);
  journey.go();
  EXPECT_LT((journey.eye().translation() - Vector3(0.0, 1.6, 0.0)).norm(), 0.1);
  for (int i = 0; i < 101; ++i) journey.go();
  EXPECT_TRUE(journey.eye().isApprox(pose_at(goal, turn_about(Vector3::UnitY(), 0.8)), 1e-10));
}

}  // namespace
}  // namespace icome::interaction
