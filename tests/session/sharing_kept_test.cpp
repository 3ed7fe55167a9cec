// Designs of a server that are kept for offline work: sessions begin without the server and go on with it.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "collab/client/kept_design.h"
#include "collab/server/served_design.h"
#include "files/design_files.h"
#include "own_folder.h"
#include "session/session_sharing.h"
#include "session/sessions.h"

namespace icome::session {
namespace {

namespace fs = std::filesystem;
using collab::ConversationState;
using collab::Role;
using world::ObjectId;

class SharingKept : public testing::Test {
 protected:
  SharingKept() {
    fs::remove_all(folder_);
    link_ = served_.link(Role::Own);
  }
  ~SharingKept() override { fs::remove_all(folder_); }

  /// A session that has opened the link, with the server or without.
  std::unique_ptr<Session> open() {
    auto session = try_to_open();
    EXPECT_TRUE(session->sharing().state()) << text_told();
    return session;
  }
  std::unique_ptr<Session> try_to_open() {
    SessionSettings settings = quiet_settings();
    settings.kept_folder = folder_;
    auto session = start(std::move(settings));
    session->sharing().open(link_);
    told_ = run_until(*session, [&] { return session->sharing().state().has_value() || failed(*session); });
    for (SessionEvent& it : session->update()) told_.push_back(std::move(it));
    return session;
  }
  bool failed(Session& session) { return !session.files().opening().has_value(); }
  void close(std::unique_ptr<Session> session) {
    session->files().close();
    session.reset();  // waits until the copy is written
  }
  testing::AssertionResult was_told(SessionEvent::Kind kind) const {
    if (std::ranges::count(told_, kind, &SessionEvent::kind) > 0) return testing::AssertionSuccess();
    return testing::AssertionFailure() << text_told();
  }
  std::string text_told() const {
    std::string all = "told only:\n";
    for (const SessionEvent& it : told_) all += it.text + "\n";
    return all;
  }
  static void until_sent(Session& session) {
    run_until(session, [&] {
      return session.sharing().state().value().connection == ConversationState::Live &&
             session.sharing().state().value().unsent == 0;
    });
  }
  static std::size_t count_of(const Session& session, const std::string& name) {
    return std::size_t(std::ranges::count_if(session.world().objects(),
                                             [&](const auto& it) { return it.second.name == name; }));
  }

  fs::path folder_ = own_folder("kept");
  collab::ServedDesign served_;
  std::string link_;
  std::vector<SessionEvent> told_;
};

TEST_F(SharingKept, OpensWithoutTheServerAndSendsWhatWasDone) {
  auto ann = open();
  EXPECT_FALSE(ann->sharing().is_kept());
  const ObjectId leg = add_box(*ann, world::at(0, 0, 0), "leg");
  ann->sharing().keep(true);
  EXPECT_TRUE(ann->sharing().is_kept());
  until_sent(*ann);
  close(std::move(ann));
  served_.stop();

  for (int day = 0; day < 2; ++day) {  // the second goes on with what the first did
    ann = open();
    EXPECT_TRUE(was_told(SessionEvent::Kind::ServerLost));
    ASSERT_TRUE(ann->sharing().state());
    EXPECT_EQ(ann->sharing().state().value().connection, ConversationState::Away);
    ASSERT_TRUE(ann->world().find(leg));
    add_box(*ann, world::at(1 + day, 0, 0), "lamp");
    ASSERT_TRUE(ann->history().perform(world::PlaceObject{leg, world::at(0, 1 + day, 0)}, "Move leg"));
    EXPECT_FALSE(ann->files().modified()) << "leaving loses nothing";
    close(std::move(ann));
  }
  served_.start();
  ann = open();
  until_sent(*ann);
  EXPECT_EQ(count_of(*ann, "lamp"), 2U);
  fs::path other_folder = folder_;
  std::swap(folder_, other_folder);
  folder_ += "_other";
  const auto bob = open();
  EXPECT_EQ(hash(bob->world()), hash(ann->world()));
  EXPECT_EQ(count_of(*bob, "lamp"), 2U) << "each once";
  EXPECT_EQ(bob->world().find(leg)->parent_from_object.translation().y(), 2.0);
  std::swap(folder_, other_folder);
}

TEST_F(SharingKept, AsksForChoicesWhereOthersWorkedMeanwhile) {
  auto ann = open();
  const ObjectId leg = add_box(*ann, world::at(0, 0, 0), "leg");
  ann->sharing().keep(true);
  until_sent(*ann);
  close(std::move(ann));
  served_.stop();
  ann = open();
  ASSERT_TRUE(ann->history().perform(world::PlaceObject{leg, world::at(0, 1, 0)}, "Move leg"));
  add_box(*ann, world::at(5, 0, 0), "lamp");
  close(std::move(ann));
  served_.start();
  {
    auto bob = start();
    bob->sharing().open(link_);
    run_until(*bob, [&] { return bob->sharing().state().has_value(); });
    ASSERT_TRUE(bob->history().perform(world::PlaceObject{leg, world::at(0, 2, 0)}, "Move leg"));
    until_sent(*bob);
  }
  ann = open();
  EXPECT_TRUE(was_told(SessionEvent::Kind::Conflicts));
  ASSERT_EQ(ann->sharing().conflicts().size(), 1U);
  EXPECT_EQ(ann->sharing().conflicts()[0].object, leg);
  ASSERT_TRUE(ann->sharing().resolve({collab::Choice::Mine}));
  until_sent(*ann);
  EXPECT_EQ(ann->world().find(leg)->parent_from_object.translation().y(), 1.0);
  EXPECT_EQ(count_of(*ann, "lamp"), 1U);
  ASSERT_TRUE(ann->history().undo()) << "all of it at once";
  EXPECT_EQ(count_of(*ann, "lamp"), 0U);
  EXPECT_EQ(ann->world().find(leg)->parent_from_object.translation().y(), 2.0);
}

TEST_F(SharingKept, NewThingsNeverGetNumbersThatAnOlderLifeHasGiven) {
  auto ann = open();
  add_box(*ann, world::at(0, 0, 0), "kept");
  until_sent(*ann);
  ann->sharing().keep(true);
  run_until(*ann, [&] { return !collab::KeptDesign::all(folder_).empty(); });
  // What comes behind the copy is lost with the program, but the server has it.
  for (int i = 0; i < 20; ++i) add_box(*ann, world::at(i, 0, 0), "after");
  until_sent(*ann);
  ann.reset();  // as a crash does, it keeps nothing more
  served_.stop();
  ann = open();
  ASSERT_TRUE(ann->sharing().state());
  for (int i = 0; i < 20; ++i) add_box(*ann, world::at(i, 1, 0), "offline");
  served_.start();
  until_sent(*ann);
  EXPECT_EQ(count_of(*ann, "after"), 20U);
  EXPECT_EQ(count_of(*ann, "offline"), 20U);
}

TEST_F(SharingKept, ADamagedCopyKeepsNobodyFromTheServer) {
  auto ann = open();
  add_box(*ann, world::at(0, 0, 0), "leg");
  ann->sharing().keep(true);
  until_sent(*ann);
  close(std::move(ann));
  const fs::path copy = collab::KeptDesign::all(folder_).at(0) / "copy";
  fs::resize_file(copy, fs::file_size(copy) - 100);
  ann = open();
  EXPECT_TRUE(was_told(SessionEvent::Kind::Notice)) << "the damage";
  EXPECT_EQ(count_of(*ann, "leg"), 1U);
  EXPECT_EQ(ann->sharing().state().value().connection, ConversationState::Live);
  EXPECT_TRUE(fs::exists(copy.string() + ".former")) << "somebody may save something of it";
  run_until(*ann, [&] { return fs::exists(copy); });
}

// What was not sent when the copy had to give way can be opened, however often that happens.
TEST_F(SharingKept, WhatIsPutAsideCanBeOpenedAndIsNeverReplaced) {
  auto ann = open();
  add_box(*ann, world::at(0, 0, 0), "leg");
  ann->sharing().keep(true);
  until_sent(*ann);
  close(std::move(ann));
  served_.stop();
  ann = open();
  add_box(*ann, world::at(1, 0, 0), "unsent");
  close(std::move(ann));
  const fs::path copy = collab::KeptDesign::all(folder_).at(0) / "copy", again = folder_ / "again";
  fs::copy_file(copy, again);
  const auto kept = collab::KeptDesign::make(folder_, collab::design_address(link_).value());
  ASSERT_TRUE(kept) << kept.error().message;
  std::vector<fs::path> aside;
  for (int i = 0; i < 3; ++i) {
    const auto put = kept->put_aside();
    ASSERT_TRUE(put) << put.error().message;
    EXPECT_EQ(std::ranges::count(aside, *put), 0);
    aside.push_back(*put);
    fs::copy_file(again, copy);
  }
  for (const fs::path& path : aside) {
    const auto design = files::read_design(path);
    ASSERT_TRUE(design) << design.error().message;
    std::vector<std::string> names;
    for (const auto& [id, object] : design->world.objects()) names.push_back(object.name);
    EXPECT_EQ(std::ranges::count(names, "leg"), 1);
    EXPECT_EQ(std::ranges::count(names, "unsent"), 1);
  }
  std::ofstream(copy) << "damaged";
  const auto damaged = kept->put_aside();
  ASSERT_TRUE(damaged);
  EXPECT_EQ(fs::file_size(*damaged), 7U);
}

TEST_F(SharingKept, IsAnotherProgramsOnlyOnce) {
  auto ann = open();
  ann->sharing().keep(true);
  auto bob = start([&] {
    SessionSettings settings = quiet_settings();
    settings.kept_folder = folder_;
    return settings;
  }());
  bob->sharing().open(link_);
  run_until(*bob, [&] { return bob->sharing().state().has_value(); });
  EXPECT_FALSE(bob->sharing().is_kept());
  EXPECT_EQ(ann->sharing().state().value().connection, ConversationState::Live) << "they are two people";
  bob->sharing().keep(true);
  EXPECT_FALSE(bob->sharing().is_kept());
}

TEST_F(SharingKept, WhatIsNotKeptDoesNotOpenWithoutItsServer) {
  served_.stop();
  const auto ann = try_to_open();
  EXPECT_FALSE(ann->sharing().state());
  EXPECT_TRUE(was_told(SessionEvent::Kind::OpenFailed));
  served_.start();
}

}  // namespace
}  // namespace icome::session
