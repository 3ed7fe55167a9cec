#include "devices/vrpn/served_client.h"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace icome::devices::vrpn {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;  // ns

/// A served client and the program at the other end of its connection, by a clock that the test moves.
class VrpnClientTest : public testing::Test {
 protected:
  void SetUp() override {
    std::array<int, 2> ends = {};
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    program_ = Socket(ends[1]);
    client_ = std::make_unique<ServedClient>(Socket(ends[0]), Place(), false, names_, 1, now_);
    words_.put_cookie();
    words_.describe(kSenderDescription, 7, "Pointer0");
    words_.describe_kinds();
  }
  void say(Kind kind, const Payload& payload = {}) { words_.put(7, kind, payload.bytes()); }
  void say_floor(double spring = 0.5) {
    Plane plane;
    plane.normal = {0, 1, 0};
    plane.spring = spring;
    say(Kind::Plane, pack(plane));
  }
  /// Lets the program take all that it was told; the number of pings among it.
  int pings() {
    int count = 0;
    std::size_t received = 0;
    while (receive(program_, decoder_.room(), received) == Flow::Some) {
      decoder_.received(received);
      Message message;
      while (decoder_.next(message) == Decoder::Step::Message) {
        names_told_.learn(message);
        if (message.type >= 0 && names_told_.kind(message.type) == Kind::Ping) ++count;
      }
    }
    return count;
  }
  /// Passes a time in steps of 0.1 s, in which the program takes all, and answers if it does that. False once
  /// the client is to be dropped.
  bool pass(double seconds, bool answers) {
    for (const std::int64_t end = now_ + static_cast<std::int64_t>(seconds * kSecond); now_ < end;
         now_ += kSecond / 10) {
      std::size_t sent = 0;
      send(program_, words_.waiting(), sent);
      words_.sent(sent);
      if (!client_->serve(now_)) return false;
      const int asked = pings();
      pinged_ += asked;
      for (int i = 0; answers && i < asked; ++i) say(Kind::Pong);
    }
    return true;
  }
  bool forces_last() const { return !client_->wanted(0).planes[0].plane.normal.isZero(); }

  const std::vector<std::string> names_ = {"Pointer0"};
  std::int64_t now_ = 100 * kSecond;
  Socket program_;
  std::unique_ptr<ServedClient> client_;
  Outbox words_;
  Decoder decoder_;
  PeerNames names_told_;
  int pinged_ = 0;
};

TEST_F(VrpnClientTest, ForcesOfOneThatAnswersLast) {
  say_floor();
  EXPECT_TRUE(pass(30, true));
  EXPECT_TRUE(forces_last());
  EXPECT_NEAR(pinged_, 30, 3) << "one a second";
}

TEST_F(VrpnClientTest, OneThatHangsLosesItsForcesAndThenItsConnection) {
  say_floor();
  EXPECT_TRUE(pass(3, true));
  EXPECT_TRUE(pass(2.5, false));
  EXPECT_TRUE(forces_last());
  static_cast<void>(client_->wishes_changed());
  EXPECT_TRUE(pass(2, false));
  EXPECT_FALSE(forces_last());
  EXPECT_TRUE(client_->wishes_changed());
  EXPECT_TRUE(pass(4, false)) << "its connection stays a while";
  EXPECT_FALSE(pass(4, false));
}

TEST_F(VrpnClientTest, OneThatComesBackStaysAndMayAskAnew) {
  say_floor();
  EXPECT_TRUE(pass(3, true));
  EXPECT_TRUE(pass(6, false));
  EXPECT_FALSE(forces_last());
  say(Kind::Pong);
  EXPECT_TRUE(pass(20, true));
  EXPECT_FALSE(forces_last()) << "what was dropped does not come back by itself";
  say_floor();
  EXPECT_TRUE(pass(20, true));
  EXPECT_TRUE(forces_last());
}

TEST_F(VrpnClientTest, AStockClientThatAnswersNoPingMayBeSilent) {
  say_floor();
  EXPECT_TRUE(pass(60, false));
  EXPECT_TRUE(forces_last());
}

TEST_F(VrpnClientTest, OneWithoutForcesIsNotAsked) {
  EXPECT_TRUE(pass(60, true));
  say_floor();
  EXPECT_TRUE(pass(5, true));
  say(Kind::Plane, pack(Plane()));
  EXPECT_TRUE(pass(2, true));
  const int pinged = pinged_;
  EXPECT_TRUE(pass(60, false)) << "it took its plane away";
  EXPECT_EQ(pinged_, pinged);
}

TEST_F(VrpnClientTest, AServerThatStoodStillBlamesNoClient) {
  say_floor();
  EXPECT_TRUE(pass(3, true));
  now_ += 30 * kSecond;
  EXPECT_TRUE(pass(5, true));
  EXPECT_TRUE(forces_last());
}

}  // namespace
}  // namespace icome::devices::vrpn
