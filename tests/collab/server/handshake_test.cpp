// Who gets in: whatever the first message is, only who has a good token for the design.
#include <gtest/gtest.h>

#include "collab/mutations.h"
#include "collab/protocol/message_bytes.h"
#include "collab/server/hub.h"
#include "collab/storage/memory_op_log.h"

namespace icome::collab {
namespace {

constexpr std::int64_t kWall = 1'700'000'000'000;

class Handshake : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(log_.create("table") && log_.create("other")); }

  std::string token_for(const std::string& design, std::int64_t expires = kWall + 1'000'000'000) const {
    return signer_.sign({make_invitation_id().value(), design, Role::Edit, expires}).value();
  }
  Hello hello_with(const std::string& token, const std::string& design = "table") const {
    Hello hello;
    hello.token = token;
    hello.design = design;
    hello.client_key = "key";
    hello.name = "Ann";
    hello.program = "test";
    return hello;
  }
  static std::string frame_of(const ClientMessage& message) {
    std::string frame;
    add_to_frame(frame, to_bytes(message));
    return frame;
  }
  void work() {
    while (const StorageWork work = hub_.next_work()) work(log_)();
  }
  /// All that a client hears who begins with this frame, until it is sent away or in.
  std::vector<ServerMessage> answers_to(std::string_view frame) {
    const LinkId link = ++last_link_;
    hub_.opened(link, "10.0.0.1:1", 0);
    hub_.received(link, frame, 0, kWall);
    work();
    std::vector<ServerMessage> heard;
    while (const SharedBytes bytes = hub_.next_frame(link, 0))
      for (std::string_view rest = *bytes; !rest.empty();)
        heard.push_back(server_message(next_in_frame(rest).value()).value());
    is_parted_ = hub_.parting(link).has_value();
    hub_.closed(link, 0);
    work();
    return heard;
  }
  bool lets_in(std::string_view frame) {
    const auto heard = answers_to(frame);
    return std::ranges::any_of(heard,
                               [](const ServerMessage& it) { return std::holds_alternative<Welcome>(it); });
  }

  TokenSigner signer_{std::string(TokenSigner::kKeyBytes, 'k')};
  world::GeometryFactory factory_;
  MemoryOpLog log_{[] { return kWall; }};
  Hub hub_{{.holder = "test"}, signer_, factory_};
  LinkId last_link_ = 0;
  bool is_parted_ = false;
};

TEST_F(Handshake, LetsInWhoHasATokenForTheDesign) {
  EXPECT_TRUE(lets_in(frame_of(hello_with(token_for("table")))));
  EXPECT_FALSE(lets_in(frame_of(hello_with(token_for("other")))));
  EXPECT_FALSE(lets_in(frame_of(hello_with(token_for("table"), "other"))));
  EXPECT_FALSE(lets_in(frame_of(hello_with(token_for("table", kWall - 1)))));
  EXPECT_FALSE(lets_in(frame_of(hello_with("none"))));
  EXPECT_FALSE(lets_in(frame_of(hello_with(""))));
  const TokenSigner other(std::string(TokenSigner::kKeyBytes, 'x'));
  EXPECT_FALSE(lets_in(frame_of(
      hello_with(other.sign({make_invitation_id().value(), "table", Role::Own, kWall + 1'000}).value()))));
}

TEST_F(Handshake, RefusesAnOlderProtocolWithASentence) {
  Hello hello = hello_with(token_for("table"));
  hello.least_version = hello.most_version = kProtocolVersion - 1;
  const auto heard = answers_to(frame_of(hello));
  ASSERT_EQ(heard.size(), 1U);
  const auto* const refused = std::get_if<Refused>(&heard.front());
  ASSERT_NE(refused, nullptr);
  EXPECT_EQ(refused->code, Parting::Version);
  EXPECT_TRUE(is_parted_);
}

TEST_F(Handshake, TakesNothingBeforeAHello) {
  for (const ClientMessage& message :
       {ClientMessage(Submit{1, 0, {}, "edit", 0}), ClientMessage(Select{}),
        ClientMessage(Fetch{"hash", 0, 9}), ClientMessage(Say{"hello"}), ClientMessage(Bye{})}) {
    EXPECT_FALSE(lets_in(frame_of(message) + frame_of(hello_with(token_for("table")))));
    EXPECT_TRUE(is_parted_);
  }
}

TEST_F(Handshake, EndsWhoSaysNothingAndLetsWhoHasAGoodHelloWaitForASlowDisk) {
  hub_.opened(1, "10.0.0.1:1", 0);
  hub_.opened(2, "10.0.0.1:2", 0);
  hub_.received(2, frame_of(hello_with(token_for("table"))), 0, kWall);
  hub_.tick(60'000, kWall + 60'000);
  EXPECT_TRUE(hub_.next_frame(1, 60'000));
  EXPECT_TRUE(hub_.parting(1));
  EXPECT_FALSE(hub_.parting(2));
  work();
  EXPECT_TRUE(hub_.next_frame(2, 60'000));
  EXPECT_FALSE(hub_.parting(2));
}

// ICOME_MUTATIONS=1000000 tries as many, under sanitizers, too.
TEST_F(Handshake, LetsNobodyInByChance) {
  base::Random random(9);
  const std::string token = token_for("table"), good = frame_of(hello_with(token));
  int in = 0, out = 0;
  for (int i = 0; i < mutations(200'000); ++i) {
    const std::string frame = mutated(good, random);
    if (!lets_in(frame)) {
      ++out;
      EXPECT_TRUE(is_parted_ || frame.empty());
      continue;
    }
    ++in;
    std::string_view rest = frame;
    const auto message = client_message(next_in_frame(rest).value()).value();
    const auto& hello = std::get<Hello>(message);
    ASSERT_EQ(hello.token, token);
    ASSERT_EQ(hello.design, "table");
  }
  EXPECT_GT(in, 0) << "changes of the name and such do no harm";
  EXPECT_GT(out, in);
}

TEST_F(Handshake, BelievesNoTokenThatIsNotItsOwn) {
  base::Random random(10);
  const std::string token = token_for("table");
  for (int i = 0; i < mutations(200'000); ++i) {
    const std::string forged = mutated(token, random);
    ASSERT_EQ(signer_.check(forged, "table", kWall).has_value(), forged == token) << forged;
  }
}

}  // namespace
}  // namespace icome::collab
