// Operands of solids that are taken hold of in the air by a device with a button.
#include "session/hands/part_grab.h"

#include "session/hands/one_hand.h"
#include "session/sessions.h"

namespace icome::session {
namespace {

using base::Vector3;

/// A block of 0.4 m with a hole of 0.1 m along z through its middle, selected, and a device in the air.
class PartGrabTest : public OneHandTest {
 protected:
  void SetUp() override {
    start_with_hand();
    geometry::CsgTree tree;
    const auto block = tree.add_leaf(geometry::Box{{0.2, 0.2, 0.1}});
    const auto hole = tree.add_leaf(geometry::Cylinder{0.1, 0.6});
    tree.add(geometry::CsgOperator::Difference, block, hole);
    solid_ = add_shape(*session_, std::make_shared<world::CsgGeometry>(std::move(tree)),
                       world::at(0.0, 0.0, 0.0), "block");
    settle();
  }
  Vector3 hole_at() const {
    return interaction::world_from_part(session_->world(), {solid_, 1})->translation();
  }

  world::ObjectId solid_;
};

TEST_F(PartGrabTest, AHoleGoesAlongWithTheHandAsOneActionAndPullsBack) {
  const std::uint64_t before = hash(session_->world());
  session_->select({solid_});
  put(Vector3(0.0, 0.1, 0.3));  // on the ghost's upper rim, before the block
  grab();
  const Vector3 from = tip();
  aim(Vector3(0.15, 0.1, 0.3));
  run_until(*session_, [&] { return tip().x() > 0.1 && session_->hands().pointer(0).force.x() < -0.1; });
  EXPECT_LT((hole_at() - (tip() - from)).norm(), 5e-3) << "it is where the hand is";
  EXPECT_EQ(session_->history().undo_name(), "Move operand 1 of block");
  let_go();
  session_->settle();
  EXPECT_TRUE(session_->stage().pick({Vector3(-0.05, 0.0, 1.0), -Vector3::UnitZ()})) << "where the hole was";
  const Vector3 left = hole_at();
  put(Vector3(0.0, 0.5, 0.3));
  EXPECT_EQ(hole_at(), left) << "it stays where it was left";
  ASSERT_TRUE(session_->history().undo());
  EXPECT_EQ(hash(session_->world()), before);
}

TEST_F(PartGrabTest, TakesNothingOfWhatIsNotSelectedOrNotNear) {
  const std::uint64_t before = hash(session_->world());
  const auto press_and_go = [&](const Vector3& place) {
    put(place);
    hand_->hold_buttons(1);
    run_until(*session_, [&] { return (session_->hands().pointer(0).buttons & 1U) != 0; });
    put(place + Vector3(0.05, 0.0, 0.0));
    hand_->hold_buttons(0);
    run_until(*session_, [&] { return (session_->hands().pointer(0).buttons & 1U) == 0; });
  };
  press_and_go(Vector3(0.0, 0.1, 0.3));
  session_->select({solid_});
  press_and_go(Vector3(0.0, 0.1, 0.33));
  EXPECT_EQ(hash(session_->world()), before);
}

TEST_F(PartGrabTest, LetsGoWhenSomethingElseChangesTheWorld) {
  session_->select({solid_});
  put(Vector3(0.0, 0.1, 0.3));
  grab();
  aim(Vector3(0.05, 0.1, 0.3));
  run_until(*session_, [&] { return hole_at().x() > 0.01; });
  ASSERT_TRUE(session_->history().undo());
  run_until(*session_, [&] { return !session_->hands().holds(0); });
  for (int i = 0; i < 20; ++i) session_->update();
  EXPECT_EQ(hole_at(), Vector3(Vector3::Zero()));
}

}  // namespace
}  // namespace icome::session
