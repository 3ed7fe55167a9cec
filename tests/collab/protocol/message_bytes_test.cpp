#include "collab/protocol/message_bytes.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "collab/mutations.h"

namespace icome::collab {
namespace {

const Item kLeg{ItemKind::Object, 0x10000000001};

std::vector<ClientMessage> client_messages() {
  Hello hello{.token = "token", .design = "table", .client_key = "key", .name = "Ann", .colour = 0x102030};
  hello.program = "icome";
  hello.has_world = true;
  hello.have = 7;
  hello.history = 9;
  hello.first_pending = 3;
  hello.only_reads = true;
  const SharedPose pose{{1.0, 2.0, 3.0}, base::Quaternion(0.5, 0.5, 0.5, 0.5)};
  return {hello,
          Fetch{std::string("\0hash", 5), 5, 6},
          Loaded{4},
          Submit{8, 7, {1, 2, 3}, std::string("\0edit", 5), 99, true},
          Select{kLeg, true},
          Deselect{kLeg},
          TakeAway{kLeg},
          Present{{pose, std::nullopt, pose}},
          Say{"hello \xc3\xa4"},
          Alive{11},
          Bye{}};
}

std::vector<ServerMessage> server_messages() {
  return {Welcome{1, 2, 3, Role::Own, 4, 5, true, 6, 7, 8, 9, {10, 11}, 12, 13, "hash"},
          Refused{"no", Parting::NotAllowed},
          Piece{"hash", 2, "bytes"},
          Ordered{5, 5, 2, 1, "edit", true},
          Ordered{5, 9, 0, 0, "edits", false},
          Ordered{5, 5, 2, 1, "outline", true, true},
          Ordered{5, 5, 2, 1, "outline", false, true},
          Accepted{1, 2},
          Rejected{1, "why", 3},
          Durable{4},
          Selected{kLeg, false, 0, 3, {ItemKind::Material, 4}, "why", true},
          FloorChanged{kLeg, 2, 3, 4},
          FloorState{{{kLeg, 2, 3, 0}}},
          People{{{1, "Ann", 0xff, Role::Edit, true}, {2, "", 0, Role::View, false}}},
          Presence{2, {}},
          Said{2, "text"},
          Living{3},
          Goodbye{"bye", Parting::TooSlow}};
}

TEST(MessageBytes, ReadsEachMessageAsItWasWritten) {
  // A message that is read and written again gives the same bytes, and kinds stay what they are.
  for (const ClientMessage& message : client_messages()) {
    const auto read = client_message(to_bytes(message));
    ASSERT_TRUE(read) << message.index() << ": " << read.error().message;
    EXPECT_EQ(read->index(), message.index());
    EXPECT_EQ(to_bytes(*read), to_bytes(message)) << message.index();
  }
  for (const ServerMessage& message : server_messages()) {
    const auto read = server_message(to_bytes(message));
    ASSERT_TRUE(read) << message.index() << ": " << read.error().message;
    EXPECT_EQ(read->index(), message.index());
    EXPECT_EQ(to_bytes(*read), to_bytes(message)) << message.index();
  }
}

TEST(MessageBytes, KeepsTheFieldsApart) {
  const auto submit = client_message(to_bytes(ClientMessage(Submit{8, 7, {1, 2}, "edit", 99}))).value();
  const auto& it = std::get<Submit>(submit);
  EXPECT_EQ(it.number, 8U);
  EXPECT_EQ(it.base, 7U);
  EXPECT_EQ(it.fences, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(it.edit, "edit");
  EXPECT_EQ(it.total, 99U);
  const auto welcome = server_message(to_bytes(server_messages().front())).value();
  const auto& at = std::get<Welcome>(welcome);
  EXPECT_EQ(at.author, 2U);
  EXPECT_EQ(at.role, Role::Own);
  EXPECT_TRUE(at.loads);
  EXPECT_EQ(at.snapshot_bytes, 7U);
  EXPECT_EQ(at.history, 9U);
  EXPECT_EQ(at.accepted, (std::vector<std::uint64_t>{10, 11}));
  EXPECT_EQ(at.accepted_from, 12U);
  const auto hello = client_message(to_bytes(client_messages().front())).value();
  EXPECT_TRUE(std::get<Hello>(hello).only_reads);
  EXPECT_EQ(std::get<Hello>(hello).first_pending, 3U);
}

TEST(MessageBytes, RefusesWhatTheOtherSideSays) {
  EXPECT_FALSE(server_message(to_bytes(client_messages().front())));
  EXPECT_FALSE(client_message(to_bytes(server_messages().front())));
}

TEST(MessageBytes, RefusesPosesThatAreNotFinite) {
  SharedPose pose;
  pose.position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(client_message(to_bytes(ClientMessage(Present{{pose, {}, {}}}))));
}

TEST(MessageBytes, ReadsSeveralInAFrame) {
  std::string frame;
  for (const ServerMessage& message : server_messages()) add_to_frame(frame, to_bytes(message));
  EXPECT_EQ(frame.size() % 8, 0U);
  std::string_view rest = frame;
  for (const ServerMessage& message : server_messages()) {
    const auto next = next_in_frame(rest);
    ASSERT_TRUE(next);
    EXPECT_EQ(*next, to_bytes(message));
  }
  EXPECT_TRUE(rest.empty());
}

TEST(MessageBytes, SurvivesEveryMutation) {
  base::Random random(5);
  std::vector<std::string> frames;
  for (const ClientMessage& message : client_messages())
    add_to_frame(frames.emplace_back(), to_bytes(message));
  for (const ServerMessage& message : server_messages())
    add_to_frame(frames.emplace_back(), to_bytes(message));
  int good = 0, bad = 0;
  for (int i = 0; i < mutations(1'000'000); ++i) {
    const std::string bytes = mutated(frames[random.index(frames.size())], random);
    std::string_view rest = bytes;
    while (!rest.empty()) {
      const auto next = next_in_frame(rest);
      if (!next) break;
      const bool reads = client_message(*next).has_value() || server_message(*next).has_value();
      ++(reads ? good : bad);
    }
  }
  EXPECT_GT(good, 0);
  EXPECT_GT(bad, 0);
}

}  // namespace
}  // namespace icome::collab
