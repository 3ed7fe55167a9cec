// What is only tried out, such as a preview: it is as good as done, and leaves no trace when it is taken
// back.
#include <vector>

#include "session/sessions.h"

namespace icome::session {
namespace {

using base::Vector3;
using world::at;
using world::PlaceObject;

TEST(TryOut, IsSeenAndFeltAndLeavesNoTrace) {
  const auto session = start();
  const auto box = add_box(*session, at(0.0, 0.0, -3.0));
  ASSERT_TRUE(session->history().perform(PlaceObject{box, at(1.0, 0.0, -3.0)}, "Move box"));
  ASSERT_TRUE(session->history().undo());
  const std::uint64_t before = world::hash(session->world());
  ASSERT_TRUE(session->history().try_out(PlaceObject{box, at(0.0, 2.0, -3.0)}, "Try box"));
  EXPECT_TRUE(session->files().modified());
  session->settle();
  EXPECT_EQ(session->view().drawn()->bounds().center(), Vector3(0.0, 2.0, -3.0));
  EXPECT_TRUE(session->stage().pick({Vector3(0.1, 2.2, 0.0), -Vector3::UnitZ()}));
  EXPECT_EQ(session->history().undo_name(), "Try box");
  EXPECT_FALSE(session->history().can_redo());
  ASSERT_TRUE(session->history().take_back());
  session->settle();
  EXPECT_EQ(world::hash(session->world()), before);
  EXPECT_EQ(session->view().drawn()->bounds().center(), Vector3(0.0, 0.0, -3.0));
  EXPECT_EQ(session->history().undo_name(), "Add box");
  EXPECT_EQ(session->history().redo_name(), "Move box");
  EXPECT_FALSE(session->history().take_back());
  ASSERT_TRUE(session->history().redo());
  EXPECT_EQ(world::world_from_object(session->world(), box).translation(), Vector3(1.0, 0.0, -3.0));
}

TEST(TryOut, AnotherTakesItsPlaceInOneMoment) {
  const auto session = start();
  const auto box = add_box(*session, at(0.0, 0.0, -3.0));
  ASSERT_TRUE(session->history().undo());
  ASSERT_TRUE(session->history().redo());
  std::vector<Vector3> places;
  session->on_change([&](const world::Changes*) {
    places.emplace_back(world::world_from_object(session->world(), box).translation());
  });
  ASSERT_TRUE(session->history().try_out(PlaceObject{box, at(0.0, 1.0, -3.0)}, "Try box"));
  ASSERT_TRUE(session->history().try_out(PlaceObject{box, at(0.0, 2.0, -3.0)}, "Try box"));
  EXPECT_EQ(places, (std::vector{Vector3(0.0, 1.0, -3.0), Vector3(0.0, 2.0, -3.0)}));
  session->settle();
  EXPECT_EQ(session->view().drawn()->bounds().center(), Vector3(0.0, 2.0, -3.0));
  ASSERT_TRUE(session->history().take_back());
  EXPECT_EQ(places.back(), Vector3(0.0, 0.0, -3.0));
  EXPECT_EQ(session->history().undo_name(), "Add box");
}

TEST(TryOut, WhatIsRefusedLeavesNothingTried) {
  const auto session = start();
  const auto box = add_box(*session, at(0.0, 0.0, -3.0));
  const std::uint64_t before = world::hash(session->world());
  ASSERT_TRUE(session->history().try_out(PlaceObject{box, at(0.0, 1.0, -3.0)}, "Try box"));
  EXPECT_FALSE(
      session->history().try_out(PlaceObject{world::ObjectId{999}, at(0.0, 1.0, -3.0)}, "Try a ghost"));
  EXPECT_EQ(world::hash(session->world()), before);
  session->settle();
  EXPECT_EQ(session->view().drawn()->bounds().center(), Vector3(0.0, 0.0, -3.0));
  EXPECT_FALSE(session->history().trying());
  EXPECT_EQ(session->history().undo_name(), "Add box");
}

TEST(TryOut, WhatIsDoneAfterItKeepsIt) {
  const auto session = start();
  const auto box = add_box(*session, at(0.0, 0.0, -3.0));
  const auto tried = [&] {
    ASSERT_TRUE(session->history().try_out(PlaceObject{box, at(0.0, 1.0, -3.0)}, "Try box"));
  };
  tried();
  ASSERT_TRUE(session->history().perform(world::RenameObject{box, "crate"}, "Rename box"));
  EXPECT_FALSE(session->history().take_back());
  ASSERT_TRUE(session->history().undo());
  EXPECT_EQ(session->history().undo_name(), "Try box");
  tried();
  ASSERT_TRUE(session->history().extend(PlaceObject{box, at(0.0, 3.0, -3.0)}));
  EXPECT_FALSE(session->history().trying());
  tried();
  ASSERT_TRUE(session->history().undo());
  EXPECT_FALSE(session->history().trying());
  EXPECT_EQ(session->history().redo_name(), "Try box");
  tried();
  session->history().keep_tried();
  EXPECT_FALSE(session->history().take_back());
  EXPECT_EQ(session->history().undo_name(), "Try box");
  tried();
  session->files().make_new();
  EXPECT_FALSE(session->history().take_back());
}

TEST(TryOut, IsNoChangeOfWhatWasSaved) {
  const auto session = start();
  const auto box = add_box(*session, at(0.0, 0.0, -3.0));
  ASSERT_TRUE(session->history().undo());
  ASSERT_FALSE(session->files().modified());
  const auto crate = session->ids().next<world::ObjectId>();
  ASSERT_TRUE(session->history().try_out(world::CreateObject{crate, 0, {.name = "crate"}}, "Create"));
  EXPECT_TRUE(session->files().modified());
  ASSERT_TRUE(session->history().take_back());
  EXPECT_FALSE(session->files().modified());
  ASSERT_TRUE(session->history().redo());
  EXPECT_TRUE(session->world().find(box));
  ASSERT_TRUE(session->history().undo());
  EXPECT_FALSE(session->files().modified());
}

}  // namespace
}  // namespace icome::session
