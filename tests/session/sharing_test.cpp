// Sessions that work on one design, by a server on the loopback.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "collab/server/served_design.h"
#include "drawing/shape/drawing_shape.h"
#include "own_folder.h"
#include "session/session_sharing.h"
#include "session/sessions.h"

namespace icome::session {
namespace {

using collab::ConversationState;
using collab::Role;
using world::ObjectId;

bool has(const std::vector<SessionEvent>& events, SessionEvent::Kind kind) {
  return std::ranges::any_of(events, [kind](const SessionEvent& it) { return it.kind == kind; });
}

std::string text_of(const std::vector<SessionEvent>& events, SessionEvent::Kind kind) {
  const auto found = std::ranges::find(events, kind, &SessionEvent::kind);
  return found == events.end() ? "" : found->text;
}

double x_of(const Session& session, ObjectId id) {
  return session.world().find(id)->parent_from_object.translation().x();
}

/// Two people at one design.
class Sharing : public testing::Test {
 protected:
  Sharing() : ann_(join("Ann", Role::Edit)), bob_(join("Bob", Role::Own)) {}

  std::unique_ptr<Session> join(const std::string& name, Role role) {
    setenv("ICOME_NAME", name.c_str(), 1);
    auto session = start();
    session->sharing().open(served_.link(role));
    const auto events = run_until(*session, [&] { return session->sharing().state().has_value(); });
    EXPECT_TRUE(has(events, SessionEvent::Kind::Opened) ||
                has(session->update(), SessionEvent::Kind::Opened));
    unsetenv("ICOME_NAME");
    return session;
  }
  /// Both go on until that is so; what they are told is kept.
  void until(const std::function<bool()>& is_so) {
    while (!is_so()) {
      for (SessionEvent& it : ann_->update()) told_ann_.push_back(std::move(it));
      for (SessionEvent& it : bob_->update()) told_bob_.push_back(std::move(it));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  void until_same() {
    until([&] {
      return ann_->sharing().state().value().unsent == 0 && bob_->sharing().state().value().unsent == 0 &&
             hash(ann_->world()) == hash(bob_->world());
    });
  }

  collab::ServedDesign served_;
  std::unique_ptr<Session> ann_, bob_;
  std::vector<SessionEvent> told_ann_, told_bob_;
};

TEST_F(Sharing, ShowsToOthersWhatOneDoesAndUndoesOnesOwnOnly) {
  const ObjectId leg = add_box(*ann_, world::at(0, 0, 0), "leg");
  until_same();
  const ObjectId lamp = add_box(*bob_, world::at(1, 0, 0), "lamp");
  until_same();
  EXPECT_EQ(ann_->history().undo_name(), "Add leg");
  ASSERT_TRUE(ann_->history().undo());
  until_same();
  EXPECT_FALSE(bob_->world().find(leg));
  EXPECT_TRUE(bob_->world().find(lamp));
  EXPECT_FALSE(ann_->history().can_undo()) << "Bob's action is Bob's to take back";
  ASSERT_TRUE(ann_->history().redo());
  until_same();
  EXPECT_TRUE(bob_->world().find(leg));
  EXPECT_FALSE(ann_->files().modified()) << "the server has it";
}

/// A drawing of one layer, number 1, without a stroke.
world::GeometryPointer empty_drawing() {
  drawing::Drawing page;
  page.layers.push_back({.id = page.next_layer_id(), .name = "Layer 1", .strokes = {}});
  return *drawing::DrawingShape::create(std::move(page), {});
}

world::Edit stroke_edit(world::GeometryId id, std::uint64_t number) {
  auto stroke = std::make_shared<drawing::Stroke>();
  stroke->id = drawing::StrokeId{number};
  stroke->curve.segments = {drawing::CubicBezier::line({0.01, 0.01 * double(number)}, {0.1, 0.05})};
  stroke->curve.widths = {{0.0, 0.001, 1.0, 0.002}};
  return world::AmendGeometry{
      id, drawing::edit_bytes(drawing::edit_of(drawing::PutStroke{drawing::LayerId{1}, 0, stroke}))};
}

TEST_F(Sharing, SendsStrokesOfADrawingToAllAndTakesThemBack) {
  const auto id = ann_->ids().next<world::GeometryId>();
  const auto object = ann_->ids().next<ObjectId>();
  world::EditGroup group;
  group.edits.push_back(world::CreateGeometry{id, empty_drawing()});
  group.edits.push_back(world::CreateObject{object, 0, {.name = "paper", .geometry = id}});
  ASSERT_TRUE(ann_->history().perform(world::Edit(std::move(group)), "Add paper"));
  until_same();
  const auto strokes = [&](const Session& session) {
    return drawing::drawing_in(*session.world().find(id)->shape)->drawing().stroke_count();
  };
  ASSERT_TRUE(ann_->history().perform(stroke_edit(id, 2), "Draw"));
  until_same();
  EXPECT_EQ(strokes(*bob_), 1U);
  EXPECT_FALSE(bob_->history().perform(stroke_edit(id, 3), "Draw")) << "Ann holds what she draws on";
  ann_->select({object});
  ann_->select({});  // and lets go of it
  until([&] { return bob_->history().perform(stroke_edit(id, 3), "Draw").has_value(); });
  until_same();
  EXPECT_EQ(strokes(*ann_), 2U);
  EXPECT_FALSE(ann_->history().undo()) << "an undo never goes over what another did to the same drawing";
  ASSERT_TRUE(bob_->history().undo());
  until_same();
  EXPECT_EQ(strokes(*ann_), 1U);
}

TEST_F(Sharing, HoldsWhatIsSelected) {
  const ObjectId leg = add_box(*ann_, world::at(0, 0, 0), "leg");
  until_same();
  ann_->select({leg});
  until([&] { return bob_->sharing().holder_of(leg).has_value(); });
  EXPECT_EQ(bob_->sharing().holder_of(leg)->name, "Ann");
  const auto moved = bob_->history().perform(world::PlaceObject{leg, world::at(3, 0, 0)}, "Move leg");
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().message, "Ann holds \"leg\".");
  EXPECT_EQ(bob_->sharing().people()[1].holds, std::vector<ObjectId>{leg});
  bob_->sharing().wait_for(leg);
  until([&] { return has(told_bob_, SessionEvent::Kind::Floor); });
  told_bob_.clear();
  ann_->select({});
  until([&] { return has(told_bob_, SessionEvent::Kind::Floor); });
  EXPECT_EQ(text_of(told_bob_, SessionEvent::Kind::Floor), "You have \"leg\" now.");
  until([&] { return ann_->sharing().holder_of(leg).has_value(); });
}

TEST_F(Sharing, DeletesAndGroupsWhatIsHeldAlthoughItIsSelectedNoMore) {
  for (int turn = 0; turn < 10; ++turn) {
    const ObjectId leg = add_box(*ann_, world::at(0, 0, 0), "leg");
    ann_->select({leg});
    until([&] { return bob_->world().find(leg) && bob_->sharing().holder_of(leg).has_value(); });
    ASSERT_TRUE(ann_->history().perform(world::DeleteObject{leg}, "Delete leg"));
    until_same();
    EXPECT_FALSE(bob_->world().find(leg));
  }
  EXPECT_FALSE(has(told_ann_, SessionEvent::Kind::Dropped));
}

TEST_F(Sharing, AnOwnerTakesAwayAndTheOtherIsTold) {
  const ObjectId leg = add_box(*ann_, world::at(0, 0, 0), "leg");
  ann_->select({leg});
  until([&] { return bob_->world().find(leg) && bob_->sharing().holder_of(leg).has_value(); });
  bob_->select({leg});
  ASSERT_TRUE(ann_->history().perform(world::PlaceObject{leg, world::at(1, 0, 0)}, "Move leg"));
  EXPECT_FALSE(ann_->sharing().take_away(leg));
  ASSERT_TRUE(bob_->sharing().take_away(leg));
  until([&] {
    return has(told_ann_, SessionEvent::Kind::Floor) && ann_->sharing().holder_of(leg).has_value();
  });
  EXPECT_EQ(text_of(told_ann_, SessionEvent::Kind::Floor), "Bob took \"leg\" away from you.");
  EXPECT_EQ(ann_->sharing().holder_of(leg)->name, "Bob") << "who has it selected gets it";
  EXPECT_FALSE(has(told_bob_, SessionEvent::Kind::Floor));
  EXPECT_FALSE(ann_->history().extend(world::PlaceObject{leg, world::at(2, 0, 0)})) << "the drag ends";
}

TEST_F(Sharing, GetsWhatIsSelectedOnceItIsFree) {
  const ObjectId leg = add_box(*ann_, world::at(0, 0, 0), "leg");
  ann_->select({leg});
  until([&] { return bob_->world().find(leg) && bob_->sharing().holder_of(leg).has_value(); });
  bob_->select({leg});
  ann_->select({});
  until([&] { return ann_->sharing().holder_of(leg).has_value(); });
}

TEST_F(Sharing, HoldsAShapeThatOneChangesForAllItsUsers) {
  const ObjectId leg = add_box(*ann_, world::at(0, 0, 0), "leg");
  until_same();
  const world::GeometryId shape = ann_->world().find(leg)->geometry;
  ASSERT_TRUE(ann_->history().perform(world::ReplaceGeometry{shape, world::box(2.0)}, "Change size"));
  until([&] {
    return !bob_->history().try_out(world::ReplaceGeometry{shape, world::box(3.0)}, "Change size") ||
           !bob_->history().take_back();
  });
  const auto changed = bob_->history().perform(world::ReplaceGeometry{shape, world::box(3.0)}, "Change size");
  ASSERT_FALSE(changed);
  EXPECT_TRUE(changed.error().message.starts_with("Ann holds"));
  ann_->select({leg});
  until([&] {
    return bob_->history().perform(world::ReplaceGeometry{shape, world::box(3.0)}, "Change").has_value();
  });
}

TEST_F(Sharing, ADragOfManyStepsIsOneActionAlsoWhileOthersWork) {
  const ObjectId leg = add_box(*ann_, world::at(0, 0, 0), "leg");
  const ObjectId lamp = add_box(*bob_, world::at(1, 0, 0), "lamp");
  until_same();
  for (int step = 1; step <= 30; ++step) {
    const world::Edit edit = world::PlaceObject{leg, world::at(0.1 * step, 0, 0)};
    ASSERT_TRUE(step == 1 ? ann_->history().perform(edit, "Move leg") : ann_->history().extend(edit));
    if (step % 5 == 0) {
      ASSERT_TRUE(
          bob_->history().perform(world::PlaceObject{lamp, world::at(1.0 + step, 0, 0)}, "Move lamp"));
      until_same();
    }
  }
  until_same();
  EXPECT_NEAR(x_of(*bob_, leg), 3.0, 1e-12);
  ASSERT_TRUE(ann_->history().undo());
  until_same();
  EXPECT_EQ(x_of(*bob_, leg), 0.0);
  EXPECT_EQ(ann_->history().undo_name(), "Add leg");
}

TEST_F(Sharing, WhatIsTriedOutIsSeenHereAloneAndStaysOnTopOfOthersEdits) {
  const ObjectId leg = add_box(*ann_, world::at(0, 0, 0), "leg");
  const ObjectId lamp = add_box(*bob_, world::at(1, 0, 0), "lamp");
  until_same();
  ASSERT_TRUE(ann_->history().try_out(world::PlaceObject{leg, world::at(5, 0, 0)}, "Move leg"));
  ASSERT_TRUE(bob_->history().perform(world::PlaceObject{lamp, world::at(2, 0, 0)}, "Move lamp"));
  until([&] { return x_of(*ann_, lamp) == 2.0; });
  EXPECT_TRUE(ann_->history().trying());
  EXPECT_EQ(x_of(*ann_, leg), 5.0);
  EXPECT_EQ(x_of(*bob_, leg), 0.0);
  ASSERT_TRUE(ann_->history().take_back());
  until_same();
  EXPECT_EQ(x_of(*bob_, leg), 0.0);
  ASSERT_TRUE(ann_->history().try_out(world::PlaceObject{leg, world::at(6, 0, 0)}, "Move leg"));
  ann_->history().keep_tried();
  until_same();
  EXPECT_EQ(x_of(*bob_, leg), 6.0);
  ASSERT_TRUE(ann_->history().undo());
  until_same();
  EXPECT_EQ(x_of(*bob_, leg), 0.0);
}

TEST_F(Sharing, GoesOnWithoutTheServerAndSendsWhatWasDoneWhenItIsBack) {
  const ObjectId leg = add_box(*ann_, world::at(0, 0, 0), "leg");
  until_same();
  served_.stop();
  until([&] { return has(told_ann_, SessionEvent::Kind::ServerLost); });
  ASSERT_TRUE(ann_->history().perform(world::PlaceObject{leg, world::at(4, 0, 0)}, "Move leg"));
  EXPECT_TRUE(ann_->files().modified()) << "the server has not got it";
  served_.start();
  until([&] { return has(told_ann_, SessionEvent::Kind::ServerBack); });
  until_same();
  EXPECT_EQ(x_of(*bob_, leg), 4.0);
  EXPECT_FALSE(ann_->files().modified());
}

/// Ann's connection is cut off alone: she is not asked to go on while Bob works.
TEST_F(Sharing, LetsOneChooseWhereOthersChangedTheSameWhileThereWasNoConnection) {
  const ObjectId leg = add_box(*ann_, world::at(0, 0, 0), "leg"),
                 lamp = add_box(*ann_, world::at(1, 0, 0), "lamp"),
                 vase = add_box(*ann_, world::at(2, 0, 0), "vase"),
                 dish = add_box(*ann_, world::at(3, 0, 0), "dish");
  until_same();
  served_.stop();
  until([&] {
    return has(told_ann_, SessionEvent::Kind::ServerLost) && has(told_bob_, SessionEvent::Kind::ServerLost);
  });
  const auto move = [](Session& who, ObjectId id, double y) {
    ASSERT_TRUE(who.history().perform(world::PlaceObject{id, world::at(0, y, 0)}, "Move"));
  };
  for (const ObjectId id : {leg, lamp, vase, dish}) move(*ann_, id, 1.0);
  for (const ObjectId id : {leg, lamp}) move(*bob_, id, 2.0);
  ASSERT_TRUE(bob_->history().perform(world::DeleteObject{vase}, "Delete vase"));
  served_.start();
  run_until(*bob_, [&] { return bob_->sharing().state().value().unsent == 0; });
  until([&] { return has(told_ann_, SessionEvent::Kind::Conflicts); });
  const auto conflicts = ann_->sharing().conflicts();
  ASSERT_EQ(conflicts.size(), 3U);
  EXPECT_EQ(conflicts[0].what, "\"leg\"");
  EXPECT_TRUE(conflicts[2].is_gone);
  for (const auto& it : conflicts) EXPECT_EQ(it.whose, "Bob");
  EXPECT_FALSE(ann_->sharing().resolve({collab::Choice::Mine}));
  ASSERT_TRUE(ann_->sharing().resolve({collab::Choice::Mine, collab::Choice::Both, collab::Choice::Both}));
  until_same();
  const auto y_of = [&](ObjectId id) { return bob_->world().find(id)->parent_from_object.translation().y(); };
  EXPECT_EQ(y_of(leg), 1.0);
  EXPECT_EQ(y_of(lamp), 2.0);
  EXPECT_EQ(y_of(dish), 1.0) << "nobody else touched it";
  ASSERT_EQ(bob_->world().roots().size(), 5U);
  EXPECT_EQ(bob_->world().find(bob_->world().roots()[3])->name, "lamp (copy)");
  EXPECT_EQ(bob_->world().find(bob_->world().roots()[4])->name, "vase (copy)");
  ASSERT_TRUE(ann_->history().undo()) << "all of it at once";
  until_same();
  EXPECT_EQ(bob_->world().roots().size(), 3U);
  EXPECT_EQ(y_of(leg), 2.0);
  EXPECT_EQ(y_of(dish), 0.0);
}

/// The server refuses it, and says so, as somebody is at work on it.
TEST_F(Sharing, DeletesNothingWithoutAConnectionThatAnotherHoldsMeanwhile) {
  const ObjectId leg = add_box(*ann_, world::at(0, 0, 0), "leg");
  until_same();
  served_.stop();
  until([&] {
    return has(told_ann_, SessionEvent::Kind::ServerLost) && has(told_bob_, SessionEvent::Kind::ServerLost);
  });
  ASSERT_TRUE(ann_->history().perform(world::DeleteObject{leg}, "Delete leg"));
  served_.start();
  const auto is_live = [&] { return bob_->sharing().state().value().connection == ConversationState::Live; };
  run_until(*bob_, is_live);
  bob_->select({leg});
  run_until(*bob_, [&] {
    const auto people = bob_->sharing().people();
    return std::ranges::any_of(people, [&](const auto& it) { return std::ranges::count(it.holds, leg) > 0; });
  });
  until([&] { return has(told_ann_, SessionEvent::Kind::Dropped); });
  until_same();
  EXPECT_TRUE(ann_->world().find(leg));
}

/// Whoever puts a choice off and ends the program finds it again in the next one.
TEST_F(Sharing, KeepsAChoiceThatWasPutOffForTheNextProgram) {
  const std::filesystem::path folder = own_folder("kept");
  const auto open_kept = [&] {
    SessionSettings settings = quiet_settings();
    settings.kept_folder = folder;
    ann_ = start(std::move(settings));
    ann_->sharing().open(served_.link(Role::Edit), "Ann");
    run_until(*ann_, [&] { return ann_->sharing().state().has_value(); });
    told_ann_.clear();
  };
  open_kept();
  ann_->sharing().keep(true);
  const ObjectId leg = add_box(*ann_, world::at(0, 0, 0), "leg"),
                 lamp = add_box(*ann_, world::at(1, 0, 0), "lamp");
  until_same();
  served_.stop();
  until([&] {
    return has(told_ann_, SessionEvent::Kind::ServerLost) && has(told_bob_, SessionEvent::Kind::ServerLost);
  });
  ASSERT_TRUE(ann_->history().perform(world::PlaceObject{leg, world::at(0, 1, 0)}, "Move"));
  ASSERT_TRUE(ann_->history().perform(world::DeleteObject{lamp}, "Delete"));
  for (const ObjectId id : {leg, lamp})
    ASSERT_TRUE(bob_->history().perform(world::PlaceObject{id, world::at(0, 2, 0)}, "Move"));
  served_.start();
  run_until(*bob_, [&] { return bob_->sharing().state().value().unsent == 0; });
  until([&] { return has(told_ann_, SessionEvent::Kind::Conflicts); });
  for (int program = 0; program < 2; ++program) {
    const auto conflicts = ann_->sharing().conflicts();
    ASSERT_EQ(conflicts.size(), 2U);
    EXPECT_EQ(conflicts[0].what, "\"leg\"");
    EXPECT_EQ(conflicts[1].what, "\"lamp\"") << "as it was called";
    ann_->files().close();  // which writes the copy
    ann_.reset();
    open_kept();
    until([&] { return !ann_->sharing().conflicts().empty(); });
    EXPECT_TRUE(bob_->world().find(lamp)) << "nothing is sent until somebody chooses";
  }
  ASSERT_TRUE(ann_->sharing().resolve({collab::Choice::Mine, collab::Choice::Theirs}));
  until_same();
  EXPECT_EQ(bob_->world().find(leg)->parent_from_object.translation().y(), 1.0);
  EXPECT_EQ(bob_->world().find(lamp)->parent_from_object.translation().y(), 2.0);
  std::filesystem::remove_all(folder);
}

/// The journal keeps what the server has not got, and nothing once it has.
TEST_F(Sharing, KeepsWorkWithoutAServerAgainstCrashes) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "icome_sharing_autosave";
  std::filesystem::remove_all(folder);
  SessionSettings settings = quiet_settings();
  settings.autosave_folder = folder;
  auto eve = start(std::move(settings));
  eve->sharing().open(served_.link(Role::Edit));
  run_until(*eve, [&] { return eve->sharing().state().has_value(); });
  add_box(*eve, world::at(0, 0, 0), "kept by the server");
  run_until(*eve, [&] { return eve->sharing().state().value().unsent == 0; });
  eve->settle();
  EXPECT_TRUE(find_recoverable_work(folder).empty());
  EXPECT_TRUE(!std::filesystem::exists(folder) || std::filesystem::is_empty(folder));
  served_.stop();
  run_until(*eve, [&] { return eve->sharing().state().value().connection == ConversationState::Away; });
  const ObjectId mine = add_box(*eve, world::at(1, 0, 0), "mine");
  eve->settle();
  eve.reset();  // as a crash does, it tells nobody
  const auto works = find_recoverable_work(folder);
  ASSERT_EQ(works.size(), 1U);
  auto again = start([&] {
    SessionSettings its = quiet_settings();
    its.autosave_folder = folder;
    return its;
  }());
  again->files().recover(works[0]);
  run_until(*again, [&] { return again->world().find(mine) != nullptr; });
  EXPECT_EQ(again->world().objects().size(), 2U);
  again->files().close();
  again.reset();
  served_.start();
}

TEST_F(Sharing, WhoMayOnlyLookChangesNothing) {
  const ObjectId leg = add_box(*ann_, world::at(0, 0, 0), "leg");
  until_same();
  const auto eve = join("Eve", Role::View);
  run_until(*eve, [&] { return eve->world().find(leg) != nullptr; });
  const auto moved = eve->history().perform(world::PlaceObject{leg, world::at(1, 0, 0)}, "Move leg");
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().message, "You may look at this design, but not change it.");
  EXPECT_EQ(x_of(*eve, leg), 0.0);
}

TEST_F(Sharing, PeopleAreSeenAndHeard) {
  interaction::View view = bob_->view().now();
  view.world_from_eye.translation() = base::Vector3(1, 2, 3);
  bob_->view().set(view);
  const auto author_of_bob = [&] { return bob_->sharing().people().front().author; };
  until([&] {
    const auto people = ann_->sharing().people();
    return people.size() == 2 && people[1].has_view;
  });
  ann_->sharing().follow(author_of_bob());
  until([&] { return ann_->view().now().world_from_eye.translation() == base::Vector3(1, 2, 3); });
  bob_->sharing().say("Hello\nAnn");
  until([&] { return !ann_->sharing().lines().empty() && ann_->sharing().lines().back().is_said; });
  EXPECT_EQ(ann_->sharing().lines().back().name, "Bob");
  EXPECT_EQ(ann_->sharing().lines().back().text, "Hello Ann");
  bob_->files().make_new();
  until([&] { return ann_->sharing().people().size() == 1; });
  EXPECT_FALSE(bob_->sharing().state());
  EXPECT_EQ(ann_->sharing().lines().back().text, "has left");
}

TEST_F(Sharing, IntegratesADesignThatWasMadeAlone) {
  const ObjectId table = add_box(*ann_, world::at(0, 0, 0), "table");
  until_same();
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "icome_made_alone.wrl";
  std::ofstream(file) << "#VRML V2.0 utf8\nDEF leg Transform { children Shape { geometry Box {} } }\n";
  ann_->files().integrate(file, table);
  until([&] { return has(told_ann_, SessionEvent::Kind::Integrated); });
  until_same();
  ASSERT_EQ(bob_->world().find(table)->children.size(), 1U);
  EXPECT_EQ(bob_->world().find(bob_->world().find(table)->children[0])->name, "leg");
  ASSERT_TRUE(ann_->history().undo());
  until_same();
  EXPECT_TRUE(bob_->world().find(table)->children.empty());
  ann_->files().integrate(file / "missing.wrl", table);
  until([&] { return has(told_ann_, SessionEvent::Kind::IntegrateFailed); });
  std::filesystem::remove(file);
}

TEST_F(Sharing, TellsWhyADesignCannotBeJoined) {
  for (const std::string& link : {std::string("icome://127.0.0.1:1/table#token=x"), std::string("icome://"),
                                  served_.link(Role::Edit) + "0"}) {
    bob_->sharing().open(link);
    until([&] { return has(told_bob_, SessionEvent::Kind::OpenFailed); });
    EXPECT_EQ(text_of(told_bob_, SessionEvent::Kind::OpenFailed)
                  .find(served_.address(Role::Edit).token.substr(0, 20)),
              std::string::npos);
    EXPECT_TRUE(bob_->sharing().state()) << "the design that was open stays";
    told_bob_.clear();
  }
}

}  // namespace
}  // namespace icome::session
