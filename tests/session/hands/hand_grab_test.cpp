// Things that are taken hold of by a device with a button, and what the hand feels of them.
#include "session/hands/hand_grab.h"

#include "session/hands/one_hand.h"
#include "session/sessions.h"

namespace icome::session {
namespace {

using base::Vector3;

/// A session with one device, the tip of which rests on top of a box of 1 m, pressing a little.
class HandGrabTest : public OneHandTest {
 protected:
  void SetUp() override {
    start_with_hand();
    box_ = add_box(*session_, world::at(0.0, 0.0, 0.0));
    settle();
    hand_->put(Vector3(0.0, 0.6, 0.0) - offset_);
    aim(Vector3(0.0, 0.498, 0.0));
    run_until(*session_, [&] { return session_->hands().touched(0) == box_; });
  }

  Vector3 box_place() const { return session_->world().find(box_)->parent_from_object.translation(); }

  world::ObjectId box_;
};

TEST_F(HandGrabTest, WhatIsHeldGoesAlongAsOneAction) {
  grab();
  EXPECT_EQ(session_->selection(), std::vector{box_});
  EXPECT_EQ(session_->history().undo_name(), "Add box") << "to press is to select";
  const Vector3 from = session_->hands().pointer(0).tip;
  aim(Vector3(0.3, 0.7, 0.1));
  tip_at_rest(*session_);  // a hand under way would be elsewhere by the time it is asked
  session_->update();
  EXPECT_EQ(session_->history().undo_name(), "Move box");
  EXPECT_FALSE(session_->hands().pointer(0).touching) << "what is held is not touched";
  let_go();
  const Vector3 place = box_place();
  EXPECT_GT(place.x(), 0.19);
  EXPECT_NEAR((place - (session_->hands().pointer(0).tip - from)).norm(), 0.0, 0.01);
  aim(Vector3(0.0, 2.0, 0.0));
  run_until(*session_, [&] { return session_->hands().pointer(0).tip.y() > 1.5; });
  EXPECT_EQ(box_place(), place) << "it stays where it was left";
  ASSERT_TRUE(session_->history().undo());
  EXPECT_EQ(box_place(), Vector3::Zero());
  EXPECT_EQ(session_->history().undo_name(), "Add box");
}

TEST_F(HandGrabTest, IsFeltToPullBackAndToWeigh) {
  session_->hands().set_grab({.pull_back = true, .weight = 0.8});
  grab();
  const Vector3 from = session_->hands().pointer(0).tip;
  aim(from + Vector3(0.1, 0.0, 0.0));
  run_until(*session_, [&] { return session_->hands().pointer(0).tip.x() > from.x() + 0.09; });
  run_until(*session_, [&] { return std::abs(session_->hands().pointer(0).force.y() + 0.8) < 0.15; });
  const Vector3 force = session_->hands().pointer(0).force;
  EXPECT_LT(force.x(), -0.7) << "0.2 + 0.8 (1 - exp(-2)) N";
  EXPECT_GT(force.x(), -1.1);
  let_go();
  run_until(*session_,
            [&] { return session_->hands().touched(0) || session_->hands().pointer(0).force.norm() < 0.05; });
}

TEST_F(HandGrabTest, LetsGoWhenTheWorldIsChangedByOthers) {
  grab();
  aim(Vector3(0.2, 0.6, 0.0));
  run_until(*session_, [&] { return box_place().x() > 0.1; });
  ASSERT_TRUE(session_->history().undo());
  run_until(*session_, [&] { return !session_->hands().holds(0); });
  EXPECT_EQ(box_place(), Vector3::Zero());
  for (int i = 0; i < 20; ++i) session_->update();
  EXPECT_EQ(box_place(), Vector3::Zero()) << "the button is still down, but nothing is held";
}

TEST_F(HandGrabTest, LetsGoWhenTheDeviceIsLost) {
  grab();
  hand_->inject(devices::SimulatedFailure::Unplugged);
  run_until(*session_, [&] { return !session_->hands().holds(0); });
  const Vector3 left = box_place();
  aim(Vector3(0.3, 0.7, 0.0));
  for (int i = 0; i < 20; ++i) session_->update();
  EXPECT_FALSE(session_->hands().holds(0));
  EXPECT_EQ(box_place(), left) << "a hand that is lost moves nothing";
  hand_->inject(devices::SimulatedFailure::None);
}

TEST_F(HandGrabTest, TakesTheRestOfTheSelectionAlong) {
  const auto other = add_box(*session_, world::at(5.0, 0.0, 0.0), "other");
  session_->select({other, box_});
  session_->settle();
  grab();
  aim(Vector3(0.3, 0.7, 0.0));
  run_until(*session_, [&] { return box_place().x() > 0.1; });
  const Vector3 offset = box_place();
  EXPECT_EQ(session_->history().undo_name(), "Move 2 objects");
  const Vector3 moved = session_->world().find(other)->parent_from_object.translation() - Vector3(5, 0, 0);
  EXPECT_NEAR((moved - offset).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace icome::session
