#include "devices/spacemouse/space_mouse.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <thread>

#include "base/no_threads.h"

namespace icome::devices {
namespace {

enum SaidByDaemon : int { Motion, Press, Release, Device };  // as spacenavd numbers what it says

/// What spacenavd does for a client, on a socket of its own: tells of motions and buttons, eight numbers
/// each.
class FakeSpacenavd {
 public:
  explicit FakeSpacenavd(bool knows_protocol_1 = true) : answers_(knows_protocol_1) {
    setenv("SPNAV_SOCKET", path().c_str(), 1);
    start();
  }
  ~FakeSpacenavd() {
    stop();
    unsetenv("SPNAV_SOCKET");
  }
  static std::string path() { return "/tmp/icome-spnav-" + std::to_string(getpid()); }

  void start() {
    sockaddr_un address = {};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path().c_str(), sizeof(address.sun_path) - 1);
    std::filesystem::remove(path());
    listener_ = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0);
    ASSERT_EQ(bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    ASSERT_EQ(listen(listener_, 8), 0);
    running_ = true;
    thread_ = std::thread([this] { serve(); });
  }
  void stop() {
    running_ = false;
    if (thread_.joinable()) thread_.join();
    for (const int open : {listener_, client_.exchange(-1)}) {
      if (open >= 0) close(open);
    }
    listener_ = -1;
    std::filesystem::remove(path());
  }

  void say(const std::array<int, 8>& numbers) const { say_bytes(numbers.data(), sizeof(numbers)); }
  void say_bytes(const void* bytes, std::size_t count) const {
    while (client_ < 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_EQ(send(client_, bytes, count, MSG_NOSIGNAL), ssize_t(count));
  }
  void move(int x, int y, int z, int rx, int ry, int rz) const { say({Motion, x, y, z, rx, ry, rz, 16}); }

 private:
  /// Who only looks whether somebody listens says nothing and goes.
  void serve() {
    while (running_) {
      const int caller = accept(listener_, nullptr, nullptr);
      if (caller < 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        continue;
      }
      int greeting = 0;
      if (recv(caller, &greeting, sizeof(greeting), 0) != sizeof(greeting)) {
        close(caller);
        continue;
      }
      if (client_ >= 0) close(client_);
      client_ = caller;
      if (answers_) send(caller, &greeting, sizeof(greeting), MSG_NOSIGNAL);
    }
  }

  bool answers_;
  std::atomic<bool> running_ = false;
  std::atomic<int> client_ = -1;
  int listener_ = -1;
  std::thread thread_;
};

/// As one likes it, however slow the machine is.
template <typename Condition>
bool soon(Condition&& condition) {
  for (int i = 0; i < 20'000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

SpaceMouseSettings impatient() {
  SpaceMouseSettings settings;
  settings.retry = 0.005;
  return settings;
}

bool a_real_one_runs() { return std::filesystem::exists("/var/run/spnav.sock"); }

TEST(SpaceMouse, WithoutSpacenavdItSaysWhatToDo) {
  if (a_real_one_runs()) GTEST_SKIP() << "spacenavd runs on this machine";
  const auto mouse = SpaceMouse::create();
  ASSERT_FALSE(mouse);
  EXPECT_NE(mouse.error().message.find("install the package spacenavd"), std::string::npos);
}

TEST(SpaceMouse, PushesAndTurnsInTheFrameOfDevices) {
  FakeSpacenavd daemon;
  auto mouse = SpaceMouse::create();
  ASSERT_TRUE(mouse) << mouse.error().message;
  NavigationState state;
  EXPECT_EQ((*mouse)->read(state), DeviceStatus::Ok);
  EXPECT_TRUE(state.push.isZero(0.0) && state.turn.isZero(0.0));
  daemon.move(350, -180, 350, 350, -350, 180);  // right, down, away
  ASSERT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok && state.push.x() != 0.0; }));
  EXPECT_TRUE(state.push.isApprox(Vector3(1.0, -0.5, -1.0), 1e-12)) << state.push.transpose();
  EXPECT_TRUE(state.turn.isApprox(Vector3(1.0, -1.0, -0.5), 1e-12)) << state.turn.transpose();
  // Trembling about rest is rest, more than all is all, and the newest counts.
  daemon.move(INT_MIN, 0, 0, 0, 0, 0);
  daemon.move(10, -10, 9, INT_MAX, INT_MIN, 11);
  ASSERT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok && state.push.x() == 0.0; }));
  EXPECT_TRUE(state.push.isZero(0.0));
  EXPECT_EQ(state.turn.x(), 1.0);
  EXPECT_EQ(state.turn.y(), -1.0);
  EXPECT_NEAR(state.turn.z(), -1.0 / 340.0, 1e-12);
}

TEST(SpaceMouse, Buttons) {
  FakeSpacenavd daemon;
  auto mouse = SpaceMouse::create();
  ASSERT_TRUE(mouse);
  NavigationState state;
  daemon.say({Press, 0});
  daemon.say({Press, 3});
  daemon.say({Press, 99});
  daemon.say({Press, -1});
  EXPECT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok && state.buttons == 0b1001; }));
  daemon.say({Release, 0});
  EXPECT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok && state.buttons == 0b1000; }));
}

TEST(SpaceMouse, GoesAndComesBackWithSpacenavd) {
  FakeSpacenavd daemon;
  auto mouse = SpaceMouse::create(impatient());
  ASSERT_TRUE(mouse);
  NavigationState state;
  daemon.move(350, 0, 0, 0, 0, 0);
  ASSERT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok && state.push.x() == 1.0; }));
  daemon.stop();
  if (!a_real_one_runs()) {
    EXPECT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Lost; }));
    EXPECT_EQ(state.push.x(), 1.0);  // unchanged unless Ok
  }
  daemon.start();
  EXPECT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok; }));
  EXPECT_EQ(state.push.x(), 0.0);  // nobody knows what it does now
  daemon.move(0, 350, 0, 0, 0, 0);
  EXPECT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok && state.push.y() == 1.0; }));
}

TEST(SpaceMouse, IsLostWhileItIsUnplugged) {
  FakeSpacenavd daemon;
  auto mouse = SpaceMouse::create();
  ASSERT_TRUE(mouse);
  NavigationState state;
  daemon.move(350, 0, 0, 0, 0, 0);
  daemon.say({Device, 1, 7});
  EXPECT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Lost; }));
  daemon.say({Device, 0, 7});
  EXPECT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok; }));
  EXPECT_TRUE(state.push.isZero(0.0));
}

TEST(SpaceMouse, WaitsForOneThatIsToCome) {
  if (a_real_one_runs()) GTEST_SKIP() << "spacenavd runs on this machine";
  SpaceMouseSettings settings = impatient();
  settings.wait = true;
  auto mouse = SpaceMouse::create(settings);
  ASSERT_TRUE(mouse);
  NavigationState state;
  for (int i = 0; i < 10; ++i) EXPECT_EQ((*mouse)->read(state), DeviceStatus::Lost);
  FakeSpacenavd daemon;
  EXPECT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok; }));
}

TEST(SpaceMouse, AnOldSpacenavdThatDoesNotAnswerWillDo) {
  FakeSpacenavd daemon(false);
  auto mouse = SpaceMouse::create();
  ASSERT_TRUE(mouse);
  NavigationState state;
  daemon.move(0, 0, -350, 0, 0, 0);
  EXPECT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok && state.push.z() == 1.0; }));
}

TEST(SpaceMouse, RubbishAndHalfEventsDoNoHarm) {
  FakeSpacenavd daemon;
  auto mouse = SpaceMouse::create();
  ASSERT_TRUE(mouse);
  NavigationState state;
  daemon.say({77, 1, 2, 3, 4, 5, 6, 7});
  daemon.say({-1, 1, 2, 3, 4, 5, 6, 7});
  const std::array<int, 8> motion = {Motion, 350, 0, 0, 0, 0, 0, 16};
  daemon.say_bytes(motion.data(), 10);
  for (int i = 0; i < 20; ++i) EXPECT_EQ((*mouse)->read(state), DeviceStatus::Ok);  // and does not wait
  EXPECT_TRUE(state.push.isZero(0.0));
  daemon.say_bytes(reinterpret_cast<const char*>(motion.data()) + 10, sizeof(motion) - 10);
  EXPECT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok && state.push.x() == 1.0; }));
}

TEST(SpaceMouse, MuchRubbishDoesNotHideWhatFollows) {
  FakeSpacenavd daemon;
  auto mouse = SpaceMouse::create();
  ASSERT_TRUE(mouse);
  NavigationState state;
  for (int i = 0; i < 200; ++i) daemon.say({77, 1, 2, 3, 4, 5, 6, 7});
  daemon.move(350, 0, 0, 0, 0, 0);
  EXPECT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok && state.push.x() == 1.0; }));
}

TEST(SpaceMouse, IsLookedForAgainWhereTheSystemHadNoThread) {
  FakeSpacenavd daemon;
  SpaceMouseSettings settings = impatient();
  settings.wait = true;
  NavigationState state;
  base::Result<std::unique_ptr<SpaceMouse>> mouse;
  {
    const base::NoThreads none;
    mouse = SpaceMouse::create(settings);
    ASSERT_TRUE(mouse);
    for (int i = 0; i < 20; ++i) {
      EXPECT_EQ((*mouse)->read(state), DeviceStatus::Lost);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  EXPECT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok; }));
}

TEST(SpaceMouse, AnAnswerThatComesLateIsNoEvent) {
  FakeSpacenavd daemon(false);
  auto mouse = SpaceMouse::create();
  ASSERT_TRUE(mouse);
  NavigationState state;
  const int answer = 0x7faa5501;
  daemon.say_bytes(&answer, sizeof(answer));
  daemon.move(350, 0, 0, 0, 0, 0);
  EXPECT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok && state.push.x() == 1.0; }));
  // The rest of an event that was taken for the answer, and then the answer.
  daemon.say({0, 350, 350, 350, 350, 350, 350, answer});
  daemon.say({Press, 2});
  EXPECT_TRUE(soon([&] { return (*mouse)->read(state) == DeviceStatus::Ok && state.buttons == 0b100; }));
  EXPECT_EQ(state.push.y(), 0.0);
}

TEST(SpaceMouse, ThereIsOneInAProgram) {
  FakeSpacenavd daemon;
  {
    const auto mouse = SpaceMouse::create();
    ASSERT_TRUE(mouse);
    EXPECT_FALSE(SpaceMouse::create());
  }
  EXPECT_TRUE(SpaceMouse::create());
  SpaceMouseSettings wrong;
  wrong.dead = wrong.range;
  EXPECT_FALSE(SpaceMouse::create(wrong));
}

}  // namespace
}  // namespace icome::devices
