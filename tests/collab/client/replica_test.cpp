#include "collab/client/replica.h"

#include <gtest/gtest.h>

#include "world/edit/edit_bytes.h"
#include "world/sample_world.h"

namespace icome::collab {
namespace {

using world::at;
using world::ObjectId;

constexpr std::uint32_t kMyself = 1, kAnnElsewhere = 2;

Ordered ordered(std::uint64_t sequence, std::uint32_t author, const world::Edit& edit) {
  return {sequence, sequence, author, 0, world::to_bytes(edit).value(), false};
}

/// A replica of a design with a leg and a lamp, as it was after edit 10.
struct Copy {
  Copy() {
    leg = world::add_object(start, ids, "leg", world::box(0.1));
    lamp = world::add_object(start, ids, "lamp", world::box(0.2));
    replica.set_author(kMyself, 0);
    EXPECT_TRUE(replica.begin(start, 10, {}));
    (void)replica.durable({10});
  }
  double x(ObjectId id) const { return replica.world().find(id)->parent_from_object.translation().x(); }

  world::World start;
  world::IdSource ids;
  ObjectId leg, lamp;
  Replica replica;
};

TEST(Replica, ShowsOnesOwnEditAtOnceAndKeepsItOnTopOfOthers) {
  Copy it;
  const std::uint64_t number =
      it.replica.perform(world::PlaceObject{it.leg, at(1, 0, 0)}, "Move leg").value();
  EXPECT_EQ(it.x(it.leg), 1.0);
  ASSERT_TRUE(it.replica.ordered(ordered(11, kAnnElsewhere, world::PlaceObject{it.leg, at(2, 0, 0)})));
  EXPECT_EQ(it.x(it.leg), 1.0) << "the own edit comes after Ann's";
  ASSERT_TRUE(it.replica.accepted({number, 12}));
  EXPECT_EQ(it.x(it.leg), 1.0);
  EXPECT_EQ(it.replica.unacknowledged(), 1U) << "ordered, but not on the disk";
  EXPECT_EQ(it.replica.durable({12}), std::vector<std::uint64_t>{number});
  EXPECT_EQ(it.replica.unacknowledged(), 0U);
}

TEST(Replica, DropsWhatTheServerRefusesAndSaysWhatAndWhy) {
  Copy it;
  const std::uint64_t first = it.replica.perform(world::PlaceObject{it.leg, at(1, 0, 0)}, "Move leg").value();
  ASSERT_TRUE(it.replica.perform(world::PlaceObject{it.lamp, at(3, 0, 0)}, "Move lamp"));
  const auto dropped = it.replica.rejected({first, "Ann holds \"leg\".", kAnnElsewhere}).value();
  ASSERT_TRUE(dropped);
  EXPECT_EQ(dropped->name, "Move leg");
  EXPECT_EQ(dropped->why, "Ann holds \"leg\".");
  EXPECT_EQ(dropped->whose, kAnnElsewhere);
  EXPECT_EQ(it.x(it.leg), 0.0);
  EXPECT_EQ(it.x(it.lamp), 3.0) << "the edit behind it stays";
}

TEST(Replica, UndoesItsOwnEditsOnly) {
  Copy it;
  const std::uint64_t mine = it.replica.perform(world::PlaceObject{it.leg, at(1, 0, 0)}, "Move leg").value();
  ASSERT_TRUE(it.replica.accepted({mine, 11}));
  ASSERT_TRUE(it.replica.ordered(ordered(12, kAnnElsewhere, world::PlaceObject{it.lamp, at(5, 0, 0)})));
  ASSERT_TRUE(it.replica.undo());
  EXPECT_EQ(it.x(it.leg), 0.0);
  EXPECT_EQ(it.x(it.lamp), 5.0);
  EXPECT_FALSE(it.replica.undo());
  ASSERT_TRUE(it.replica.redo());
  EXPECT_EQ(it.x(it.leg), 1.0);
}

TEST(Replica, UndoGoesBackToWhatOthersDidBefore) {
  Copy it;
  const std::uint64_t mine = it.replica.perform(world::PlaceObject{it.leg, at(1, 0, 0)}, "Move leg").value();
  ASSERT_TRUE(it.replica.ordered(ordered(11, kAnnElsewhere, world::PlaceObject{it.leg, at(2, 0, 0)})));
  ASSERT_TRUE(it.replica.accepted({mine, 12}));
  ASSERT_TRUE(it.replica.undo());
  EXPECT_EQ(it.x(it.leg), 2.0) << "Ann's place, not the one that was there when the edit was made";
}

TEST(Replica, SaysThatALaterEditOfAnotherIsInTheWayOfUndo) {
  Copy it;
  const std::uint64_t mine = it.replica.perform(world::PlaceObject{it.leg, at(1, 0, 0)}, "Move leg").value();
  ASSERT_TRUE(it.replica.accepted({mine, 11}));
  ASSERT_TRUE(it.replica.ordered(ordered(12, kAnnElsewhere, world::RenameObject{it.leg, "leg of Ann"})));
  ASSERT_TRUE(it.replica.ordered(ordered(13, kAnnElsewhere, world::PlaceObject{it.leg, at(2, 0, 0)})));
  std::uint32_t whose = 0;
  const auto undone = it.replica.undo({}, &whose);
  ASSERT_FALSE(undone);
  EXPECT_EQ(whose, kAnnElsewhere);
  EXPECT_NE(undone.error().message.find("Move leg"), std::string::npos);
  EXPECT_EQ(it.x(it.leg), 2.0);
}

TEST(Replica, ARenameOfAnotherIsNotInTheWayOfUndoingAMove) {
  Copy it;
  const std::uint64_t mine = it.replica.perform(world::PlaceObject{it.leg, at(1, 0, 0)}, "Move leg").value();
  ASSERT_TRUE(it.replica.accepted({mine, 11}));
  ASSERT_TRUE(it.replica.ordered(ordered(12, kAnnElsewhere, world::RenameObject{it.leg, "leg of Ann"})));
  EXPECT_TRUE(it.replica.undo());
  EXPECT_EQ(it.replica.world().find(it.leg)->name, "leg of Ann");
}

TEST(Replica, MergesTheStepsOfADragThatWereNotSentYet) {
  Copy it;
  ASSERT_TRUE(it.replica.perform(world::PlaceObject{it.leg, at(1, 0, 0)}, "Move leg", {}, true));
  ASSERT_TRUE(it.replica.perform(world::PlaceObject{it.leg, at(2, 0, 0)}, "Move leg", {}, true));
  EXPECT_EQ(it.replica.pending(), 1U);
  EXPECT_TRUE(it.replica.next_to_send());
  ASSERT_TRUE(it.replica.perform(world::PlaceObject{it.leg, at(3, 0, 0)}, "Move leg", {}, true));
  EXPECT_EQ(it.replica.pending(), 2U) << "what was sent stays as it is";
  ASSERT_TRUE(it.replica.undo());
  EXPECT_EQ(it.x(it.leg), 0.0) << "one drag, one action";
}

TEST(Replica, UndoesADragWhoseStepsWereOrderedMeanwhileAtOnce) {
  Copy it;
  for (std::uint64_t step = 0; step < 3; ++step) {
    const world::EditGroup both{{world::PlaceObject{it.leg, at(1.0 + double(step), 0, 0)},
                                 world::PlaceObject{it.lamp, at(2.0 + double(step), 0, 0)}}};
    const std::uint64_t number = it.replica.perform(both, "Move two", {}, step > 0).value();
    EXPECT_TRUE(it.replica.next_to_send());
    ASSERT_TRUE(it.replica.accepted({number, 11 + step}));
    (void)it.replica.durable({11 + step});
  }
  ASSERT_TRUE(it.replica.undo());
  EXPECT_EQ(it.x(it.leg), 0.0);
  EXPECT_EQ(it.x(it.lamp), 0.0);
  EXPECT_FALSE(it.replica.can_undo()) << "one drag, one action";
  ASSERT_TRUE(it.replica.redo());
  EXPECT_EQ(it.x(it.leg), 3.0);
}

TEST(Replica, MergesTheStepsOfADragOfManyThings) {
  Copy it;
  for (const double x : {1.0, 2.0}) {
    const world::EditGroup both{
        {world::PlaceObject{it.leg, at(x, 0, 0)}, world::PlaceObject{it.lamp, at(x, 0, 0)}}};
    ASSERT_TRUE(it.replica.perform(both, "Move two", {}, x > 1.0));
  }
  EXPECT_EQ(it.replica.pending(), 1U);
}

TEST(Replica, UndoesTheRestOfADragWhoseFirstStepWasRefused) {
  Copy it;
  const std::uint64_t first = it.replica.perform(world::PlaceObject{it.leg, at(1, 0, 0)}, "Move leg").value();
  EXPECT_TRUE(it.replica.next_to_send());
  const std::uint64_t then =
      it.replica.perform(world::PlaceObject{it.leg, at(2, 0, 0)}, "Move leg", {}, true).value();
  EXPECT_NE(first, then);
  ASSERT_TRUE(it.replica.rejected({first, "Ann holds leg.", kAnnElsewhere}));
  EXPECT_EQ(it.x(it.leg), 2.0);
  ASSERT_TRUE(it.replica.undo());
  EXPECT_EQ(it.x(it.leg), 0.0);
}

TEST(Replica, TellsOfAllThatItsWorldGoesThrough) {
  Copy it;
  world::World copy = it.replica.world();
  it.replica.on_change([&](const world::Edit* edit) {
    if (edit == nullptr) {
      copy = it.replica.world();
    } else {
      ASSERT_TRUE(world::apply(copy, *edit));
    }
  });
  const auto expect_same = [&] { EXPECT_EQ(hash(copy), hash(it.replica.world())); };
  ASSERT_TRUE(it.replica.perform(world::PlaceObject{it.leg, at(1, 0, 0)}, "Move leg"));
  expect_same();
  ASSERT_TRUE(it.replica.ordered(ordered(11, kAnnElsewhere, world::PlaceObject{it.leg, at(2, 0, 0)})));
  expect_same();
  EXPECT_EQ(copy.find(it.leg)->parent_from_object.translation().x(), 1.0);
  ASSERT_TRUE(it.replica.rewind());
  expect_same();
  ASSERT_TRUE(it.replica.begin(it.start, 12, {}));
  expect_same();
  ASSERT_TRUE(it.replica.undo());
  expect_same();
}

TEST(Replica, GoesBackToWhatIsDurableWhenTheConnectionIsLost) {
  Copy it;
  const std::uint64_t mine = it.replica.perform(world::PlaceObject{it.leg, at(1, 0, 0)}, "Move leg").value();
  EXPECT_TRUE(it.replica.next_to_send());
  ASSERT_TRUE(it.replica.ordered(ordered(11, kAnnElsewhere, world::PlaceObject{it.lamp, at(5, 0, 0)})));
  ASSERT_TRUE(it.replica.accepted({mine, 12}));
  ASSERT_TRUE(it.replica.rewind());
  EXPECT_EQ(it.replica.sequence(), 10U);
  EXPECT_EQ(it.x(it.lamp), 0.0) << "Ann's edit may be lost with the server";
  EXPECT_EQ(it.x(it.leg), 1.0) << "the own one is kept and sent again";
  EXPECT_EQ(it.replica.next_to_send()->number, mine);
}

TEST(Replica, KnowsOwnEditsThatASnapshotHolds) {
  Copy it;
  const std::uint64_t mine = it.replica.perform(world::PlaceObject{it.leg, at(1, 0, 0)}, "Move leg").value();
  world::World later = it.start;
  ASSERT_TRUE(world::apply(later, world::PlaceObject{it.leg, at(1, 0, 0)}));
  ASSERT_TRUE(it.replica.begin(later, 12, {mine}));
  EXPECT_EQ(it.replica.pending(), 0U);
  EXPECT_EQ(it.replica.unacknowledged(), 1U);
  EXPECT_EQ(it.replica.durable({12}), std::vector<std::uint64_t>{mine});
}

TEST(Replica, TakesNothingOfAnotherHistoryForDurable) {
  Copy it;
  it.replica.begin_history();
  ASSERT_TRUE(it.replica.begin(it.start, 2, {}));
  EXPECT_FALSE(it.replica.can_resume());
  const std::uint64_t mine = it.replica.perform(world::PlaceObject{it.leg, at(1, 0, 0)}, "Move leg").value();
  ASSERT_TRUE(it.replica.accepted({mine, 3}));
  EXPECT_TRUE(it.replica.durable({2}).empty()) << "10 was durable in the old history";
  EXPECT_EQ(it.replica.durable({3}), std::vector<std::uint64_t>{mine});
}

TEST(Replica, RefusesAnOrderThatCannotBeTheServers) {
  Copy it;
  EXPECT_FALSE(it.replica.ordered(ordered(12, kAnnElsewhere, world::PlaceObject{it.leg, at(2, 0, 0)})))
      << "11 is missing";
  EXPECT_FALSE(it.replica.ordered(ordered(11, kAnnElsewhere, world::PlaceObject{ObjectId{99}, at(2, 0, 0)})));
  EXPECT_TRUE(it.replica.ordered(ordered(10, kAnnElsewhere, world::PlaceObject{it.leg, at(2, 0, 0)})))
      << "told before";
  EXPECT_EQ(it.x(it.leg), 0.0);
}

}  // namespace
}  // namespace icome::collab
