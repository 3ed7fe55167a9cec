#include "devices/vrpn/vrpn_server.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "base/clock.h"
#include "devices/fakes/plain_vrpn_client.h"
#include "realtime/guard/guard.h"
#include "repeats.h"

namespace icome::devices {
namespace {

using fakes::loopback;
using fakes::PlainClient;
using vrpn::Kind;

bool happens(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

class VrpnServing : public testing::Test {
 protected:
  void SetUp() override {
    VrpnServerSettings settings;
    settings.port = 0;
    settings.names = {"Pointer0", "Pointer1"};
    auto server = VrpnServer::create(settings);
    ASSERT_TRUE(server) << server.error().message;
    server_ = std::move(*server);
    port_ = std::stoi(server_->listening().substr(server_->listening().find(':') + 1));
    feeder_ = std::thread([this] {
      while (!stop_) {
        state_.position.x() = 0.001 * ++fed_;
        server_->feed(state_, {0, 0, 0.5});
        PointerState other;
        other.position.z() = -1.0;
        server_->feed(other, Vector3::Zero(), 1);
        force_y_ = server_->wanted_force(PointerState(), base::steady_nanoseconds()).y();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
  }
  void TearDown() override {
    stop_ = true;
    if (feeder_.joinable()) feeder_.join();
  }

  /// A floor 1 mm above the middle: 0.5 N at 500 N/m.
  static vrpn::Payload floor() {
    vrpn::Plane plane;
    plane.normal = {0, 1, 0};
    plane.offset = -0.001;
    plane.spring = 0.5;
    plane.recovery = 1;
    return vrpn::pack(plane);
  }
  bool floor_is_felt() {
    return happens([this] { return std::abs(force_y_ - 0.5) < 1e-6; });
  }
  bool nothing_is_felt() {
    return happens([this] { return force_y_ == 0.0; });
  }

  std::unique_ptr<VrpnServer> server_;
  int port_ = 0;
  PointerState state_;
  int fed_ = 0;
  std::atomic<double> force_y_ = 0.0;
  std::atomic<bool> stop_ = false;
  std::thread feeder_;
};

TEST_F(VrpnServing, TwoClientsGetPosesOfBothDevices) {
  PlainClient one(port_);
  PlainClient two(port_);
  for (PlainClient* client : {&one, &two}) {
    client->greet();
    EXPECT_TRUE(client->hears(Kind::ButtonStates));
    EXPECT_TRUE(client->hears(Kind::PosQuat, [](std::string_view payload) {
      return vrpn::read_pos_quat(payload)->position.x() > 0.0;
    }));
    EXPECT_TRUE(client->hears(Kind::Force, [](std::string_view payload) {
      return payload == vrpn::Payload().put(Vector3(0, 0, 0.5)).bytes();
    }));
    EXPECT_TRUE(client->hears(
        Kind::PosQuat,
        [](std::string_view payload) { return vrpn::read_pos_quat(payload)->position.z() == -1.0; },
        "Pointer1"));
  }
}

TEST_F(VrpnServing, AnswersPings) {
  PlainClient client(port_);
  client.greet();
  client.say(Kind::Ping, vrpn::Payload());
  EXPECT_TRUE(client.hears(Kind::Pong));
}

TEST_F(VrpnServing, RendersPlanesUntilTheClientLeaves) {
  {
    PlainClient client(port_);
    client.greet();
    client.say(Kind::Plane, floor());
    EXPECT_TRUE(floor_is_felt());
  }
  EXPECT_TRUE(nothing_is_felt());
  PlainClient client(port_);
  client.greet();
  client.say(Kind::Plane, floor());
  EXPECT_TRUE(floor_is_felt());
  client.say(Kind::Plane, vrpn::pack(vrpn::Plane()));
  EXPECT_TRUE(nothing_is_felt());
}

TEST_F(VrpnServing, ForcesOfADeviceThatIsNotSharedGoNowhere) {
  PlainClient client(port_);
  client.greet("Other");
  client.say(Kind::Plane, floor());
  PlainClient other(port_);
  other.greet();
  EXPECT_TRUE(other.hears(Kind::PosQuat));
  EXPECT_EQ(force_y_, 0.0);
}

/// Asks by UDP to be called at a port; the text says which computer is meant.
void ask_to_be_called(int server, const std::string& computer, int port) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  const sockaddr_in address = loopback(server);
  const std::string text = computer + " " + std::to_string(port);
  sendto(socket, text.c_str(), text.size() + 1, 0, reinterpret_cast<const sockaddr*>(&address),
         sizeof(address));
  close(socket);
}

TEST_F(VrpnServing, CallsBackWhoAsksByUdpAndNobodyElse) {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address = loopback(0);
  socklen_t size = sizeof(address);
  ASSERT_EQ(bind(listener, reinterpret_cast<const sockaddr*>(&address), size), 0);
  ASSERT_EQ(listen(listener, 4), 0);
  ASSERT_EQ(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
  // Another computer's address: the sender itself is called, never a third.
  ask_to_be_called(port_, "192.0.2.1", ntohs(address.sin_port));
  PlainClient client = PlainClient::called_at(listener);
  client.greet();
  EXPECT_TRUE(client.hears(Kind::PosQuat));
  for (const char* nonsense : {"", "127.0.0.1", " 80", "127.0.0.1 0", "127.0.0.1 99999", "127.0.0.1 -1"})
    ask_to_be_called(port_, nonsense, 70000);
  EXPECT_TRUE(client.hears(Kind::Velocity));
  close(listener);
}

TEST_F(VrpnServing, GarbageAndFloodsDisturbNobody) {
  PlainClient good(port_);
  good.greet();
  ASSERT_TRUE(good.hears(Kind::PosQuat));
  PlainClient garbage(port_);
  garbage.say("GET / HTTP/1.1\r\nHost: nobody\r\n\r\n");
  EXPECT_TRUE(garbage.is_closed());
  PlainClient broken(port_);
  broken.greet();
  broken.say(std::string("\0\0\0\1", 4) + std::string(20, 'x'));
  EXPECT_TRUE(broken.is_closed());
  // A client that sends without end, and one that never reads.
  std::atomic<bool> enough = false;
  std::thread flood([&] {
    PlainClient client(port_);
    client.greet();
    std::string pings;
    vrpn::Outbox outbox;
    for (int i = 0; i < 1000; ++i) outbox.put(7, Kind::Plane, floor().bytes());
    pings = outbox.waiting();
    while (!enough)
      static_cast<void>(send(client.socket(), pings.data(), pings.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
  });
  PlainClient silent(port_);
  silent.greet();
  for (int i = 0; i < repeats(400); ++i) EXPECT_TRUE(good.hears(Kind::PosQuat));
  enough = true;
  flood.join();
}

TEST_F(VrpnServing, OneWhoTakesNothingIsDroppedAndItsForcesEnd) {
  PlainClient slow(port_);
  slow.greet();
  slow.say(Kind::Plane, floor());
  EXPECT_TRUE(floor_is_felt());
  const int small = 4096;
  setsockopt(slow.socket(), SOL_SOCKET, SO_RCVBUF, &small, sizeof(small));
  EXPECT_TRUE(nothing_is_felt()) << "it never reads";
}

TEST_F(VrpnServing, MoreThanSixteenAreTurnedAway) {
  std::vector<PlainClient> clients;
  for (int i = 0; i < 16; ++i) {
    clients.emplace_back(port_);
    clients.back().greet();
    ASSERT_TRUE(clients.back().hears(Kind::PosQuat));
  }
  PlainClient late(port_);
  EXPECT_TRUE(late.is_closed());
  clients.pop_back();
  EXPECT_TRUE(happens([&] {
    PlainClient next(port_);
    next.greet();
    return next.hears(Kind::PosQuat);
  }));
}

TEST_F(VrpnServing, StoppedItClosesAndFeelsNothing) {
  PlainClient client(port_);
  client.greet();
  client.say(Kind::Plane, floor());
  EXPECT_TRUE(floor_is_felt());
  server_->stop();
  EXPECT_TRUE(client.is_closed());
  EXPECT_TRUE(nothing_is_felt());
  server_->stop();
  VrpnServerSettings settings;
  settings.port = port_;
  EXPECT_TRUE(VrpnServer::create(settings)) << "the port is free again";
}

TEST_F(VrpnServing, TheServosPartTakesNoMemoryAndNoLock) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "sanitizers have the allocator";
  stop_ = true;
  feeder_.join();
  realtime::RealtimeGuard guard;
  for (int i = 0; i < 100; ++i) {
    server_->feed(state_, Vector3::Zero());
    server_->wanted_force(state_, base::steady_nanoseconds());
  }
  guard.stop();
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_EQ(guard.locks(), 0U);
}

TEST(VrpnServer, WhatCannotBeIsToldInASentence) {
  VrpnServerSettings settings;
  settings.port = 0;
  auto first = VrpnServer::create(settings);
  ASSERT_TRUE(first);
  settings.port = std::stoi((*first)->listening().substr((*first)->listening().find(':') + 1));
  const auto taken = VrpnServer::create(settings);
  ASSERT_FALSE(taken);
  EXPECT_NE(taken.error().message.find("cannot listen at 127.0.0.1:"), std::string::npos);
  EXPECT_NE(taken.error().message.find("another program does"), std::string::npos);
  settings.port = 70000;
  EXPECT_FALSE(VrpnServer::create(settings));
  settings.port = 0;
  settings.names = {"A", "A"};
  EXPECT_FALSE(VrpnServer::create(settings));
  settings.names = {"A@B"};
  EXPECT_FALSE(VrpnServer::create(settings));
  settings.names = {};
  EXPECT_FALSE(VrpnServer::create(settings));
}

TEST(VrpnServer, APlaceThatCannotBeListenedAtIsToldWithWhatToDo) {
  const auto told = [](const std::string& host, int port) {
    VrpnServerSettings settings;
    settings.host = host;
    settings.port = port;
    const auto server = VrpnServer::create(settings);
    return server ? std::string() : server.error().message;
  };
  EXPECT_NE(told("192.0.2.1", 0).find("this computer has no such address"), std::string::npos);
  EXPECT_NE(told("::1", 0).find("IPv6"), std::string::npos);
  EXPECT_NE(told("no.such.computer.invalid", 0).find("no computer is known"), std::string::npos);
  if (geteuid() != 0) {
    EXPECT_NE(told("127.0.0.1", 80).find("below 1024"), std::string::npos);
  }
}

/// The processor time that this program has used, s.
double processor_time() {
  timespec time = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

TEST(VrpnServer, WithoutRoomForAnotherConnectionItRests) {
  VrpnServerSettings settings;
  settings.port = 0;
  const auto server = VrpnServer::create(settings);
  ASSERT_TRUE(server) << server.error().message;
  const int port = std::stoi((*server)->listening().substr((*server)->listening().find(':') + 1));
  const int waiting = socket(AF_INET, SOCK_STREAM, 0);
  rlimit limit = {};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
  // The number of the next file would be the limit, or above it.
  const int next = dup(waiting);
  close(next);
  const rlimit full = {static_cast<rlim_t>(next), limit.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &full), 0);
  const sockaddr_in address = loopback(port);
  EXPECT_EQ(connect(waiting, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  const double before = processor_time();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_LT(processor_time() - before, 0.05) << "of half a second";
  setrlimit(RLIMIT_NOFILE, &limit);
  close(waiting);
  // What waits is let in once there is room.
  PlainClient client(port);
  client.greet();
  client.say(Kind::Ping, vrpn::Payload());
  EXPECT_TRUE(client.hears(Kind::Pong));
}

}  // namespace
}  // namespace icome::devices
