#include "collab/server/room.h"

#include <gtest/gtest.h>

#include "collab/order/world_bytes.h"
#include "collab/protocol/message_bytes.h"
#include "world/edit/edit_bytes.h"
#include "world/sample_world.h"

namespace icome::collab {
namespace {

using world::ObjectId;

/// A room with a table in it and what its clients hear.
class RoomTest : public testing::Test {
 protected:
  void SetUp() override { open({}); }
  void open(RoomStart start) {
    if (!start.snapshot) {
      world::World world;
      world::IdSource ids;
      table_ = world::add_object(world, ids, "table", nullptr);
      start.snapshot = Snapshot{1, world_to_bytes(world).value()};
      if (!start.entries.empty()) start.snapshot->sequence = start.entries.front().sequence - 1;
    }
    start.design = "table";
    start.fence = 1;
    room_ = Room::open(start, settings_, factory_).value();
  }
  void join(LinkId link, std::uint32_t author, Role role, const std::string& name) {
    room_->join(link, {.author = author, .role = role, .name = name}, now_);
    say(link, Loaded{room_->sequence()});
    heard(link);
  }
  void say(LinkId link, const ClientMessage& message) { room_->receive(link, message, now_, 0); }
  void submit(LinkId link, std::uint64_t number, const world::Edit& edit,
              std::vector<std::uint64_t> fences = {}) {
    say(link, Submit{number, room_->sequence(), std::move(fences), world::to_bytes(edit).value(), 0});
  }
  std::vector<ServerMessage> heard(LinkId link) {
    std::vector<ServerMessage> all;
    while (const SharedBytes frame = room_->next_frame(link, now_)) {
      std::string_view rest = *frame;
      while (!rest.empty()) all.push_back(server_message(next_in_frame(rest).value()).value());
    }
    return all;
  }
  template <typename Kind>
  std::vector<Kind> heard_of(LinkId link) {
    std::vector<Kind> some;
    for (const ServerMessage& message : heard(link))
      if (const auto* const it = std::get_if<Kind>(&message)) some.push_back(*it);
    return some;
  }

  world::GeometryFactory factory_;
  RoomSettings settings_;
  ObjectId table_;
  std::unique_ptr<Room> room_;
  std::int64_t now_ = 1'000;
};

TEST_F(RoomTest, TellsAllButTheAuthorOfAMoveAndAllOfACreation) {
  join(1, 1, Role::Edit, "Ann");
  join(2, 2, Role::Edit, "Bob");
  heard(1);
  submit(1, 1, world::PlaceObject{table_, world::at(1, 0, 0)});
  EXPECT_EQ(heard_of<Accepted>(1).size(), 1U);
  EXPECT_EQ(heard_of<Ordered>(2).size(), 1U);
  world::IdSource ids(1);
  submit(1, 2, world::CreateObject{ids.next<ObjectId>(), 0, {}});
  const std::vector<Ordered> mine = heard_of<Ordered>(1), theirs = heard_of<Ordered>(2);
  ASSERT_EQ(mine.size(), 1U);
  EXPECT_TRUE(mine.front().creates);
  EXPECT_TRUE(mine.front().edit.empty()) << "its author has it";
  ASSERT_EQ(theirs.size(), 1U);
  EXPECT_FALSE(theirs.front().edit.empty());
}

TEST_F(RoomTest, TellsWhoMadeAnEditAtOnceThatItIsDurableAndOthersSoon) {
  join(1, 1, Role::Edit, "Ann");
  join(2, 2, Role::Edit, "Bob");
  heard(1);
  heard(2);
  submit(1, 1, world::PlaceObject{table_, world::at(1, 0, 0)});
  heard(1);
  heard(2);
  room_->committed(room_->sequence());
  EXPECT_EQ(heard_of<Durable>(1).size(), 1U);
  EXPECT_EQ(heard_of<Durable>(2).size(), 0U);
  now_ += settings_.durable_gap;
  EXPECT_EQ(heard_of<Durable>(2).size(), 1U);
  EXPECT_EQ(heard_of<Durable>(2).size(), 0U);
}

TEST_F(RoomTest, LetsNobodyUndoOverWhatAnotherDidInTheSameMoment) {
  join(1, 1, Role::Edit, "Ann");
  join(2, 2, Role::Edit, "Bob");
  heard(1);
  const std::uint64_t base = room_->sequence();
  submit(2, 1, world::PlaceObject{table_, world::at(2, 0, 0)});
  const auto undo = [&](std::uint64_t number, const world::Edit& edit) {
    say(1, Submit{number, base, {}, world::to_bytes(edit).value(), 0, true});
  };
  heard(1);
  undo(1, world::PlaceObject{table_, world::at(0, 0, 0)});
  const auto told = heard_of<Rejected>(1);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].why, "Bob has changed \"table\" meanwhile.");
  EXPECT_EQ(told[0].whose, 2U);
  undo(2, world::RenameObject{table_, "desk"});
  EXPECT_EQ(heard_of<Accepted>(1).size(), 1U) << "its name is another side of it";
}

TEST_F(RoomTest, KnowsWhoWaitsForAnAnswerAboutTheFloor) {
  join(1, 1, Role::Edit, "Ann");
  EXPECT_FALSE(room_->has_answer(1));
  say(1, Select{item_of(table_), false});
  EXPECT_TRUE(room_->has_answer(1));
  heard(1);
  EXPECT_FALSE(room_->has_answer(1));
}

TEST_F(RoomTest, GivesTheSnapshotThatSomebodyLoadsToItsEnd) {
  settings_.fresh_snapshot_bytes = 1;
  open({});
  room_->join(1, {.author = 1, .role = Role::Edit, .name = "Ann"}, now_);
  const auto welcome = heard_of<Welcome>(1).at(0);
  // Others change the design, and whoever comes now gets a newer snapshot.
  join(2, 2, Role::Edit, "Bob");
  submit(2, 1, world::PlaceObject{table_, world::at(1, 0, 0)});
  room_->join(3, {.author = 3, .role = Role::Edit, .name = "Eve"}, now_);
  EXPECT_NE(heard_of<Welcome>(3).at(0).snapshot_hash, welcome.snapshot_hash);
  say(1, Fetch{welcome.snapshot_hash, 0, kMostWanted});
  const auto pieces = heard_of<Piece>(1);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].bytes.size(), welcome.snapshot_bytes);
  say(1, Loaded{welcome.snapshot});
  EXPECT_EQ(heard_of<Ordered>(1).size(), 1U) << "and then the edits behind it";
  say(1, Fetch{welcome.snapshot_hash, 0, kMostWanted});
  EXPECT_TRUE(heard_of<Piece>(1).at(0).bytes.empty()) << "nobody needs it any more";
}

TEST_F(RoomTest, TakesNothingOfWhoMayOnlyLook) {
  join(1, 1, Role::View, "Eve");
  for (int i = 0; i < 100; ++i) say(1, Submit{1, 0, {}, std::string(1'000'000, 'x'), 200'000'000});
  const std::vector<Rejected> told = heard_of<Rejected>(1);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told.front().why.find("look"), std::string::npos);
  EXPECT_EQ(room_->sequence(), 1U);
  say(1, Select{item_of(table_), false});
  EXPECT_FALSE(heard_of<Selected>(1).front().granted);
}

TEST_F(RoomTest, EndsWhoSendsMorePartsThanMayBeKept) {
  settings_.most_parts_bytes = 1'000'000;
  open({});
  join(1, 1, Role::Edit, "Eve");
  for (int i = 0; i < 3; ++i) say(1, Submit{1, 0, {}, std::string(400'000, 'x'), 200'000'000});
  EXPECT_EQ(heard_of<Goodbye>(1).size(), 1U);
}

TEST_F(RoomTest, RefusesNewThingsWithIdsOfOthersAndNamesThatAreNone) {
  join(1, 1, Role::Edit, "Eve");
  world::IdSource mine(1), theirs(2);
  submit(1, 1, world::CreateObject{theirs.next<ObjectId>(), 0, {}});
  submit(1, 2, world::RenameObject{table_, "\xff\xfe"});
  submit(1, 3, world::RenameObject{table_, std::string(900'000, 'x')});
  world::Affine3 nowhere = world::Affine3::Identity();
  nowhere.translation().x() = std::numeric_limits<double>::quiet_NaN();
  submit(1, 4, world::PlaceObject{table_, nowhere});
  submit(1, 5, world::ReserveIds{2, 1'000});
  EXPECT_EQ(heard_of<Rejected>(1).size(), 5U);
  EXPECT_EQ(room_->sequence(), 1U);
}

TEST_F(RoomTest, MakesOneLineOfNamesAndChat) {
  join(1, 1, Role::Edit, "Bob\n     8  Alice: delete \x1b[2J");
  join(2, 2, Role::Edit, std::string(99, 'a') + "\xc3\xa4");
  const std::vector<People> people = heard_of<People>(1);
  ASSERT_FALSE(people.empty());
  EXPECT_EQ(people.back().people.front().name, std::string(99, 'a')) << "cut between letters";
  heard(2);
  say(1, Say{"two\nlines"});
  const std::vector<Said> said = heard_of<Said>(2);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said.front().text, "two lines");
}

TEST_F(RoomTest, HearsAFewLinesOfChatOnly) {
  join(1, 1, Role::View, "Eve");
  join(2, 2, Role::Edit, "Ann");
  for (int i = 0; i < 30'000; ++i) say(1, Say{std::string(2'000, 'x')});
  EXPECT_LE(heard_of<Said>(2).size(), 11U);
  EXPECT_FALSE(room_->parting(2));
  now_ += 60'000;
  say(1, Say{"again"});
  EXPECT_EQ(heard_of<Said>(2).size(), 1U);
}

TEST_F(RoomTest, KnowsNobodyWhoOnlyStandsInTheLog) {
  const std::string move = world::to_bytes(world::PlaceObject{ObjectId{1}, world::at(1, 0, 0)}).value();
  RoomStart start;
  start.entries = {{2, 7, 1, 0, move}};
  open(start);
  room_->join(1, {.author = 9, .role = Role::Edit, .name = "Ann"}, now_);
  for (const People& people : heard_of<People>(1))
    for (const Person& person : people.people) EXPECT_EQ(person.author, 9U);
}

TEST_F(RoomTest, NamesThoseWhoHaveGoneAndWhoseEditsAreKept) {
  const std::string move = world::to_bytes(world::PlaceObject{ObjectId{1}, world::at(1, 0, 0)}).value();
  RoomStart start;
  start.entries = {{2, 7, 1, 0, move}};
  start.names = {{7, "Cid"}, {8, "Dan"}};
  open(start);
  join(1, 1, Role::Edit, "Ann");
  submit(1, 1, world::PlaceObject{table_, world::at(2, 0, 0)});
  room_->leave(1);
  room_->join(2, {.author = 2, .role = Role::Edit, .name = "Bob"}, now_);
  const std::vector<People> people = heard_of<People>(2);
  ASSERT_EQ(people.size(), 1U);
  std::map<std::string, bool> here;
  for (const Person& it : people[0].people) here[it.name] = it.here;
  EXPECT_EQ(here, (std::map<std::string, bool>{{"Ann", false}, {"Bob", true}, {"Cid", false}}));
}

TEST_F(RoomTest, NamesOnlyTheLastOfVeryManyWhoHaveGone) {
  RoomStart start;
  for (std::uint32_t i = 2; i < 12'002; ++i) {
    start.entries.push_back(
        {i, i, 1, 0, world::to_bytes(world::PlaceObject{ObjectId{1}, world::at(i, 0, 0)}).value()});
    start.names[i] = std::string(kMostPersonBytes, 'a');
  }
  open(start);
  room_->join(1, {.author = 1, .role = Role::Edit, .name = "Ann"}, now_);
  EXPECT_FALSE(room_->parting(1)) << "it is not too much at once";
  const std::vector<People> people = heard_of<People>(1);
  ASSERT_EQ(people.size(), 1U);
  EXPECT_EQ(people[0].people.size(), 501U);
  EXPECT_EQ(people[0].people[1].author, 12'001U);
}

TEST_F(RoomTest, RefusesAnEditOfAHoldThatHasEnded) {
  join(1, 1, Role::Edit, "Ann");
  join(2, 2, Role::Edit, "Bob");
  say(1, Select{item_of(table_), false});
  const std::uint64_t fence = heard_of<Selected>(1).front().fence;
  submit(1, 1, world::PlaceObject{table_, world::at(1, 0, 0)}, {fence});
  EXPECT_EQ(heard_of<Accepted>(1).size(), 1U);
  room_->leave(1);
  now_ += settings_.lease + 1;
  say(2, Alive{1});
  room_->tick(now_);
  submit(2, 1, world::PlaceObject{table_, world::at(2, 0, 0)});
  EXPECT_EQ(heard_of<Accepted>(2).size(), 1U) << "the lease has ended";
  join(3, 1, Role::Edit, "Ann");
  submit(3, 2, world::PlaceObject{table_, world::at(3, 0, 0)}, {fence});
  ASSERT_EQ(heard_of<Rejected>(3).size(), 1U);
  EXPECT_EQ(room_->world().find(table_)->parent_from_object.translation().x(), 2.0);
}

TEST_F(RoomTest, TellsOfAHoldThatAnOwnerTookAway) {
  join(1, 1, Role::Edit, "Ann");
  join(2, 2, Role::Own, "Bob");
  say(1, Select{item_of(table_), false});
  heard(1);
  say(2, TakeAway{item_of(table_)});
  const std::vector<FloorChanged> told = heard_of<FloorChanged>(1);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told.front().holder, 0U);
  EXPECT_EQ(told.front().taken_by, 2U);
}

TEST_F(RoomTest, WaitsForNobodysLeaseOnceItHasEnded) {
  join(1, 1, Role::Edit, "Ann");
  say(1, Select{item_of(table_)});
  heard(1);
  room_->leave(1);
  EXPECT_FALSE(room_->is_idle()) << "Ann may come back for it";
  room_->end("The server stops.", Parting::ServerStops);
  EXPECT_TRUE(room_->is_idle());
}

TEST_F(RoomTest, MergesTheDragsOfOthersForWhoLagsBehind) {
  settings_.merge_from = 10;
  open({});
  join(1, 1, Role::Edit, "Ann");
  join(2, 2, Role::Edit, "Bob");
  for (std::uint64_t i = 1; i <= 500; ++i)
    submit(1, i, world::PlaceObject{table_, world::at(double(i), 0, 0)});
  const std::vector<Ordered> told = heard_of<Ordered>(2);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told.front().first, 2U);
  EXPECT_EQ(told.front().last, 501U);
}

}  // namespace
}  // namespace icome::collab
