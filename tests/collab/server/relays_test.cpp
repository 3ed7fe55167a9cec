#include "collab/server/relays.h"

#include <gtest/gtest.h>

#include <deque>
#include <functional>

#include "base/random.h"

namespace icome::collab {
namespace {

/// A server at the bus that writes down what its relays ask for.
struct Station final : RelayEvents {
  explicit Station(const std::string& id, std::deque<std::pair<std::string, std::string>>& its_bus,
                   const std::string& key = "the key of the store")
      : bus(its_bus), relays({id, key}, *this) {}

  void publish(const std::string& server, std::string bytes) override {
    bus.emplace_back(server, std::move(bytes));
  }
  void guest_opened(LinkId guest, const std::string&) override { guests.push_back(guest); }
  void guest_received(LinkId, std::string_view frame) override { from_guest.emplace_back(frame); }
  void guest_sent(LinkId) override { ++sent; }
  void guest_closed(LinkId) override { ++closed; }
  void client_frame(LinkId, SharedBytes frame) override { to_client.push_back(*frame); }
  void client_ends(LinkId, const std::string& why) override { ends.push_back(why); }

  std::deque<std::pair<std::string, std::string>>& bus;
  Relays relays;
  std::vector<LinkId> guests;
  std::vector<std::string> from_guest, to_client, ends;
  int sent = 0, closed = 0;
};

/// Two servers and the bus between them.
class RelaysTest : public testing::Test {
 protected:
  RelaysTest() { pass_time(Relays::kHeartbeat); }

  /// All that is on the bus goes to where it goes; `drops` says what is lost.
  void deliver(const std::function<bool()>& drops = [] { return false; }) {
    while (!bus_.empty()) {
      const auto [to, bytes] = bus_.front();
      bus_.pop_front();
      if (drops()) continue;
      for (Station* it : {&door_, &home_})
        if (it->relays.id() == to || to.empty()) it->relays.heard(bytes, now_);
    }
  }
  void pass_time(std::int64_t milliseconds) {
    for (const std::int64_t end = now_ + milliseconds; now_ < end;) {
      now_ += 100;
      if (door_lives_) door_.relays.tick(now_);
      if (home_lives_) home_.relays.tick(now_);
      deliver();
    }
  }
  void begin() {
    ASSERT_TRUE(door_.relays.pass_on(7, "home", "hello", now_));
    deliver();
    ASSERT_EQ(home_.guests.size(), 1U);
  }

  std::int64_t now_ = 1'000;
  bool door_lives_ = true, home_lives_ = true;
  std::deque<std::pair<std::string, std::string>> bus_;
  Station door_{"door", bus_}, home_{"home", bus_};
};

TEST_F(RelaysTest, BringsFramesBothWaysInOrder) {
  begin();
  EXPECT_EQ(home_.from_guest, std::vector<std::string>{"hello"});
  EXPECT_TRUE(Relays::is_guest(home_.guests[0]));
  EXPECT_FALSE(Relays::is_guest(7));
  EXPECT_TRUE(door_.relays.passes_on(7));
  const std::string large(3U << 20U, 'x');
  door_.relays.from_client(7, "one");
  door_.relays.from_client(7, large);
  home_.relays.to_guest(home_.guests[0], large);
  deliver();
  EXPECT_EQ(home_.from_guest, (std::vector<std::string>{"hello", "one", large}));
  EXPECT_EQ(door_.to_client, std::vector<std::string>{large});
  EXPECT_EQ(home_.sent, 0);
  door_.relays.client_sent(7);
  deliver();
  EXPECT_EQ(home_.sent, 1);
}

TEST_F(RelaysTest, EndsAtBothEndsWhoeverEndsIt) {
  begin();
  home_.relays.end_guest(home_.guests[0], "The server stops.");
  deliver();
  EXPECT_EQ(door_.ends, std::vector<std::string>{"The server stops."});
  EXPECT_FALSE(door_.relays.passes_on(7));
  ASSERT_TRUE(door_.relays.pass_on(7, "home", "hello", now_)) << "the client comes again";
  deliver();
  EXPECT_EQ(home_.guests.size(), 2U);
}

TEST_F(RelaysTest, EndsWithItsClient) {
  begin();
  door_.relays.client_closed(7);
  deliver();
  EXPECT_EQ(home_.closed, 1);
  EXPECT_TRUE(door_.ends.empty());
}

TEST_F(RelaysTest, EndsWhereAServerIsSilent) {
  begin();
  home_lives_ = false;
  pass_time(Relays::kSilence + 300);
  EXPECT_EQ(door_.ends.size(), 1U);
  EXPECT_FALSE(door_.relays.pass_on(8, "home", "hello", now_)) << "nobody is there";
  EXPECT_FALSE(door_.relays.pass_on(8, "nowhere", "hello", now_));
}

TEST_F(RelaysTest, EndsWhereTheServerOfTheClientIsSilent) {
  begin();
  door_lives_ = false;
  pass_time(Relays::kSilence + 300);
  EXPECT_EQ(home_.closed, 1);
}

/// Whatever is lost on the bus, no frame comes twice, late or out of order: a relay with a gap ends.
TEST_F(RelaysTest, LosesNothingUnnoticed) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    base::Random random(seed);
    door_.to_client.clear();
    door_.ends.clear();
    home_.from_guest.clear();
    home_.closed = 0;
    const LinkId client = 100 + seed;
    ASSERT_TRUE(door_.relays.pass_on(client, "home", "hello", now_));
    deliver();
    const LinkId guest = home_.guests.back();
    std::size_t up = 1, down = 0;
    for (int step = 0; step < 20; ++step) {
      door_.relays.from_client(client, "up " + std::to_string(up++));
      home_.relays.to_guest(guest, "down " + std::to_string(down++));
      deliver([&] { return random.index(60) == 0; });
    }
    for (std::size_t i = 1; i < home_.from_guest.size(); ++i)
      EXPECT_EQ(home_.from_guest[i], "up " + std::to_string(i));
    for (std::size_t i = 0; i < door_.to_client.size(); ++i)
      EXPECT_EQ(door_.to_client[i], "down " + std::to_string(i));
    const bool is_whole = home_.from_guest.size() == up && door_.to_client.size() == down;
    if (!is_whole) {
      // The next thing that is said, or a silence of what was lost last, is noticed.
      door_.relays.from_client(client, "last");
      deliver();
      home_.relays.to_guest(guest, "last");
      deliver();
      EXPECT_TRUE(!door_.ends.empty() || home_.closed > 0) << "seed " << seed;
    }
    door_.relays.client_closed(client);
    deliver();
  }
}

TEST_F(RelaysTest, HearsNobodyWhoDoesNotKnowTheKey) {
  begin();
  Station stranger("door", bus_, "another key");
  stranger.relays.pass_on(7, "home", "x", now_);
  base::Random random(1);
  door_.relays.from_client(7, "genuine");
  const std::string genuine = bus_.back().second;
  bus_.clear();
  for (int i = 0; i < 20'000; ++i) {
    std::string forged = genuine;
    const auto cut = random.index(4) == 0 ? random.index(forged.size()) : forged.size();
    forged.resize(cut);
    for (std::size_t n = 1 + random.index(3); n > 0 && !forged.empty(); --n)
      forged[random.index(forged.size())] = char(random.index(256));
    if (forged != genuine) home_.relays.heard(forged, now_);
  }
  home_.relays.heard(genuine.substr(0, 3), now_);
  home_.relays.heard("", now_);
  EXPECT_EQ(home_.from_guest.size(), 1U);
  home_.relays.heard(genuine, now_);
  EXPECT_EQ(home_.from_guest.size(), 2U);
}

}  // namespace
}  // namespace icome::collab
