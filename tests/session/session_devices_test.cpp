// Devices that come and go while a session runs.
#include <atomic>
#include <cmath>
#include <mutex>

#include "session/display/workspace_marks.h"
#include "session/sessions.h"

namespace icome::session {
namespace {

using base::Vector3;
using devices::DeviceStatus;

/// What a test sees of a device that a session has.
struct Seen {
  std::mutex mutex;
  std::vector<Vector3> forces;  // N, one for each write
  std::string condition;
  std::atomic<bool> closed = false;
  std::atomic<bool> lost = false;

  void say(const std::string& sentences) {
    const std::lock_guard lock(mutex);
    condition = sentences;
  }

  std::vector<Vector3> so_far() {
    const std::lock_guard lock(mutex);
    return forces;
  }
};

/// A device that rests where it is put and notes the forces on it.
class NotedDevice final : public devices::PointerDevice {
 public:
  NotedDevice(std::shared_ptr<Seen> seen, const Vector3& place,
              std::chrono::milliseconds closes_for = std::chrono::milliseconds(0))
      : seen_(std::move(seen)), place_(place), closes_for_(closes_for) {}
  ~NotedDevice() override {
    std::this_thread::sleep_for(closes_for_);
    seen_->closed = true;
  }
  const devices::DeviceInfo& info() const override { return info_; }
  DeviceStatus read(devices::PointerState& state) override {
    state = {};
    state.position = place_;
    state.buttons = buttons;
    return seen_->lost ? DeviceStatus::Lost : DeviceStatus::Ok;
  }
  DeviceStatus write(const Vector3& force) override {
    const std::lock_guard lock(seen_->mutex);
    seen_->forces.push_back(force);
    return DeviceStatus::Ok;
  }
  std::string condition() const override {
    const std::lock_guard lock(seen_->mutex);
    return seen_->condition;
  }
  std::atomic<std::uint32_t> buttons = 0;

 private:
  std::shared_ptr<Seen> seen_;
  Vector3 place_;
  std::chrono::milliseconds closes_for_;
  devices::DeviceInfo info_ = {.name = "noted", .continuous_force = 2.0};
};

PointerConnection connection(std::unique_ptr<devices::PointerDevice> device,
                             const devices::DeviceMapping& mapping = {},
                             const std::string& address = "test:1") {
  return {address, std::move(device), mapping};
}

/// Pushes every hand to the right with a newton.
void add_wind(Session& session) {
  world::PhysicalObject object{.name = "wind"};
  object.fixture = std::make_shared<const world::Fixture>(world::ForceEffect{"constant:1,0,0", true});
  const auto done = session.history().perform(
      world::CreateObject{session.ids().next<world::ObjectId>(), 0, object}, "Add wind");
  ASSERT_TRUE(done) << done.error().message;
  session.settle();
}

/// The largest change of a force from one write to the next, N.
double largest_step(const std::vector<Vector3>& forces, std::size_t from) {
  double largest = 0.0;
  for (std::size_t i = std::max<std::size_t>(from, 1); i < forces.size(); ++i)
    largest = std::max(largest, (forces[i] - forces[i - 1]).norm());
  return largest;
}

TEST(SessionDevices, ADeviceThatComesBeginsSoftlyAndFeelsTheDesignThatIsThere) {
  const auto session = start();
  add_wind(*session);
  const auto seen = std::make_shared<Seen>();
  const auto index =
      session->hands().connect(connection(std::make_unique<NotedDevice>(seen, Vector3::Zero())));
  ASSERT_TRUE(index);
  EXPECT_EQ(*index, 0U);
  ASSERT_EQ(session->hands().pointers(), 2U);
  EXPECT_EQ(session->hands().mouse(), 1U);
  EXPECT_FALSE(session->hands().is_mouse_driven());
  EXPECT_EQ(session->hands().use(0).address, "test:1");
  EXPECT_EQ(session->hands().pointer_info(0).name, "noted");
  run_until(*session, [&] { return session->hands().pointer(0).force.norm() > 0.99; });
  const auto forces = seen->so_far();
  EXPECT_LT(forces.front().norm(), 0.021);
  // A ramp of half a second takes a newton up by 2 mN a tick; a tick that is late counts as up to ten.
  EXPECT_LT(largest_step(forces, 0), 0.021);
  EXPECT_FALSE(session->world().objects().empty());
}

TEST(SessionDevices, ADeviceThatGoesIsWithoutForceBeforeItIsClosedAndTheOtherFeelsNothingOfIt) {
  const auto session = start();
  add_wind(*session);
  const auto stays = std::make_shared<Seen>(), goes = std::make_shared<Seen>();
  ASSERT_TRUE(session->hands().connect(connection(std::make_unique<NotedDevice>(goes, Vector3::Zero()))));
  ASSERT_TRUE(session->hands().connect(
      connection(std::make_unique<NotedDevice>(stays, Vector3::Zero()), {}, "test:2")));
  ASSERT_EQ(session->hands().pointers(), 3U);
  run_until(*session, [&] {
    return session->hands().pointer(0).force.norm() > 0.99 && session->hands().pointer(1).force.norm() > 0.99;
  });
  const std::size_t before = stays->so_far().size();
  ASSERT_TRUE(session->hands().disconnect(0));
  EXPECT_EQ(session->hands().pointers(), 2U);
  EXPECT_EQ(session->hands().use(0).address, "test:2");
  run_until(*session, [&] { return goes->closed.load(); });
  EXPECT_EQ(goes->so_far().back(), Vector3::Zero());
  const auto forces = goes->so_far();
  EXPECT_LT(largest_step(forces, 0), 1.7);  // as fast as the limiter lets it: full force within 2 ms
  const std::size_t ticks = stays->so_far().size();
  run_until(*session, [&] { return stays->so_far().size() > ticks + 50; });
  EXPECT_LT(largest_step(stays->so_far(), before), 0.021);
  EXPECT_GT(stays->so_far().back().norm(), 0.98);
}

TEST(SessionDevices, NobodyWaitsForADeviceThatIsSlowToClose) {
  const auto session = start();
  const auto seen = std::make_shared<Seen>();
  ASSERT_TRUE(session->hands().connect(
      connection(std::make_unique<NotedDevice>(seen, Vector3::Zero(), std::chrono::milliseconds(300)))));
  run_until(*session, [&] { return session->hands().pointer(0).time != 0; });
  ASSERT_TRUE(session->hands().disconnect(0));
  EXPECT_TRUE(session->hands().is_closing("test:1"));
  int updates = 0;
  run_until(*session, [&] {
    updates += seen->closed.load() ? 0 : 1;
    return !session->hands().is_closing("test:1");
  });
  EXPECT_TRUE(seen->closed);
  EXPECT_GT(updates, 20);
}

TEST(SessionDevices, TheLastPointerMakesPlaceForTheMouse) {
  SessionSettings settings = quiet_settings();
  settings.pointers.push_back(hand_at({0.0, 0.0, 0.1}));
  const auto session = start(std::move(settings));
  EXPECT_EQ(session->hands().mouse(), std::nullopt);
  EXPECT_FALSE(session->hands().use(0).mapping);
  EXPECT_FALSE(session->hands().set_mapping(0, {}));
  ASSERT_TRUE(session->hands().disconnect(0));
  EXPECT_TRUE(session->hands().is_mouse_driven());
  EXPECT_FALSE(session->hands().disconnect(0));
  session->hands().put({0.1, 0.2, 0.3});
  session->hands().aim({0.1, 0.2, 0.3});
  run_until(*session,
            [&] { return (session->hands().pointer(0).tip - Vector3(0.1, 0.2, 0.3)).norm() < 1e-3; });
}

TEST(SessionDevices, TheMouseTouchesBesideADevice) {
  const auto session = start();
  interaction::View view;
  view.world_from_eye = base::Pose(Eigen::Translation3d(0.0, 0.0, 2.0));
  view.distance = 2.0;
  session->view().set(view);
  const auto id = add_box(*session, base::Affine3::Identity());
  auto device = hand_at({0.3, 0.0, 0.6});
  auto* const hand = device.get();
  ASSERT_TRUE(session->hands().connect(connection(std::move(device))));
  session->settle();
  hand->set_target({0.3, 0.0, 0.49});
  session->hands().put({-0.3, 0.0, 0.6});
  session->hands().aim({-0.3, 0.0, 0.49});
  run_until(*session, [&] { return session->hands().touched(0) && session->hands().touched(1); });
  EXPECT_EQ(session->hands().touched(0), id);
  EXPECT_EQ(session->hands().touched(1), id);
  EXPECT_NEAR(session->hands().pointer(0).scp.x(), 0.3, 0.05);
  EXPECT_NEAR(session->hands().pointer(1).scp.x(), -0.3, 0.05);
}

TEST(SessionDevices, AnotherMappingKeepsThePlaceOfThePointerAndBeginsSoftly) {
  const auto session = start();
  add_wind(*session);
  const auto seen = std::make_shared<Seen>();
  const Vector3 place(0.01, 0.02, 0.03);
  ASSERT_TRUE(session->hands().connect(connection(std::make_unique<NotedDevice>(seen, place))));
  run_until(*session, [&] { return session->hands().pointer(0).force.norm() > 0.99; });
  devices::DeviceMapping mapping;
  mapping.scale = 3.0;
  mapping.max_force = 0.5;
  const std::size_t before = seen->so_far().size();
  ASSERT_TRUE(session->hands().set_mapping(0, mapping));
  EXPECT_EQ(session->hands().use(0).mapping->scale, 3.0);
  const auto there = [&] {
    return (session->hands().pointer(0).device_from_stylus.translation() - 3.0 * place).norm() < 1e-9;
  };
  run_until(*session, [&] { return there() && session->hands().pointer(0).force.norm() > 0.49; });
  EXPECT_EQ(session->hands().pointer_info(0).max_force, 0.5);
  EXPECT_DOUBLE_EQ(session->hands().pointer_info(0).workspace_radius, 0.3);
  EXPECT_DOUBLE_EQ(session->hands().use(0).own_radius, 0.1);
  const auto forces = seen->so_far();
  const auto none =
      std::find(forces.begin() + std::ptrdiff_t(before), forces.end(), Vector3(Vector3::Zero()));
  ASSERT_NE(none, forces.end());
  EXPECT_LT(largest_step(forces, std::size_t(none - forces.begin()) + 1), 0.021);
  EXPECT_LE(forces.back().norm(), 0.5 + 1e-9);
  mapping.scale = 0.0;
  EXPECT_FALSE(session->hands().set_mapping(0, mapping));
  EXPECT_EQ(session->hands().use(0).mapping->scale, 3.0);
  EXPECT_FALSE(seen->closed);
}

TEST(SessionDevices, AWorkspaceThatFollowsTheViewSpansWhatIsSeen) {
  const auto session = start();
  interaction::View view;
  view.distance = 4.0;
  view.field = 0.6;
  session->view().set(view);
  devices::DeviceMapping mapping;
  mapping.scale_follows_view = true;
  ASSERT_TRUE(session->hands().connect(connection(hand_at(Vector3::Zero()), mapping)));
  EXPECT_NEAR(session->hands().pointer_info(0).workspace_radius, 4.0 * std::sin(0.3), 1e-9);
  view.distance = 0.5;
  session->view().set(view);
  run_until(*session, [&] {
    return std::abs(session->hands().pointer_info(0).workspace_radius - 0.5 * std::sin(0.3)) < 1e-9;
  });
  EXPECT_TRUE(session->hands().use(0).mapping->scale_follows_view);
  mapping.scale_follows_view = false;
  mapping.scale = 2.0;
  ASSERT_TRUE(session->hands().set_mapping(0, mapping));
  view.distance = 3.0;
  session->view().set(view);
  for (int i = 0; i < 60; ++i) run_until(*session, [] { return true; });
  run_until(*session, [&] { return session->hands().pointer_info(0).workspace_radius == 0.2; });
}

TEST(SessionDevices, AButtonThatIsDownAsADeviceComesTakesHoldOfNothing) {
  const auto session = start();
  interaction::View view;
  view.world_from_eye = base::Pose(Eigen::Translation3d(0.0, 0.0, 2.0));
  view.distance = 2.0;
  session->view().set(view);
  add_box(*session, base::Affine3::Identity());
  session->settle();
  auto device = hand_at({0.0, 0.0, 0.6});
  auto* const hand = device.get();
  hand->hold_buttons(1);
  ASSERT_TRUE(session->hands().connect(connection(std::move(device))));
  hand->set_target({0.0, 0.0, 0.48});
  run_until(*session, [&] { return session->hands().touched(0).has_value(); });
  for (int i = 0; i < 30; ++i) run_until(*session, [] { return true; });
  EXPECT_FALSE(session->hands().holds(0));
  hand->hold_buttons(0);
  run_until(*session, [&] { return session->hands().pointer(0).buttons == 0; });
  hand->hold_buttons(1);
  run_until(*session, [&] { return session->hands().holds(0); });
  ASSERT_TRUE(session->hands().disconnect(0));
  EXPECT_FALSE(session->hands().holds(0));
}

TEST(SessionDevices, ManyComeAndGoWhileTheDesignChanges) {
  SessionSettings settings = quiet_settings();
  settings.connections.push_back(connection(hand_at(Vector3::Zero()), {}, "first"));
  const auto session = start(std::move(settings));
  ASSERT_EQ(session->hands().pointers(), 2U);
  for (int round = 0; round < 12; ++round) {
    while (session->hands().connect(connection(hand_at({0.0, 0.01 * round, 0.0})))) {
      add_box(*session, base::Affine3(Eigen::Translation3d(round, 0.0, 0.0)));
      run_until(*session, [] { return true; });
    }
    devices::DeviceMapping mapping;
    mapping.scale = 1.0 + round;
    EXPECT_TRUE(session->hands().set_mapping(1, mapping));
    if (round % 2 == 0) run_until(*session, [] { return true; });
    while (session->hands().pointers() > 2) ASSERT_TRUE(session->hands().disconnect(1));
    run_until(*session, [&] { return !session->hands().is_closing("test:1"); });
  }
  EXPECT_EQ(session->hands().use(0).address, "first");
  run_until(*session, [&] { return session->hands().pointer(0).status == DeviceStatus::Ok; });
}

TEST(WorkspaceMarks, AreThreeCirclesAboutTheMiddleWithinTheSphere) {
  const Vector3 middle(1.0, 2.0, 3.0);
  const auto overlay = workspace_marks({{middle, base::Matrix3::Identity(), 0.5}}, {});
  std::size_t on_the_sphere = 0;
  for (const auto& line : overlay.lines) {
    for (const Vector3& point : line.points) {
      EXPECT_LT((point - middle).norm(), 0.5 + 1e-9);
      on_the_sphere += (point - middle).norm() > 0.5 - 1e-9 ? 1 : 0;
    }
  }
  EXPECT_GT(on_the_sphere, 100U);
  EXPECT_TRUE(workspace_marks({}, {}).lines.empty());
}

TEST(WorkspaceMarks, EndsThatAreTooNearToTheEyeAreLeftOut) {
  interaction::View view;
  view.world_from_eye = base::Pose(Eigen::Translation3d(0.0, 0.0, 2.0));
  view.distance = 2.0;
  const WorkspaceMark small{Vector3::Zero(), base::Matrix3::Identity(), 0.5};
  const WorkspaceMark large{Vector3::Zero(), base::Matrix3::Identity(), 5.0};
  const auto ends = workspace_ends({small, large}, view);
  ASSERT_EQ(ends.size(), 3U);
  EXPECT_NEAR(ends[0].z(), -0.5, 1e-12);
  EXPECT_NEAR(ends[1].z(), 0.5, 1e-12);
  EXPECT_NEAR(ends[2].z(), -5.0, 1e-12);
}

/// The texts of the events about devices until nothing has come for some turns, with bars between them.
std::string device_news(Session& session) {
  std::string all;
  for (int quiet = 0; quiet < 100; ++quiet) {
    for (const SessionEvent& event : session.update()) {
      if (event.device.empty()) continue;
      EXPECT_EQ(event.device, "noted");
      all += (all.empty() ? "" : "|") + event.text;
      quiet = 0;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return all;
}

TEST(SessionDevices, EachSentenceOfADeviceIsToldOnceWhileItLasts) {
  const auto session = start(quiet_settings());
  const auto seen = std::make_shared<Seen>();
  ASSERT_TRUE(session->hands().connect(connection(std::make_unique<NotedDevice>(seen, Vector3::Zero()))));
  EXPECT_EQ(device_news(*session), "");
  seen->say("No force: it has no power");
  EXPECT_EQ(device_news(*session), "noted: No force: it has no power.");
  seen->say("No force: it has no power\nIt is hot");
  EXPECT_EQ(device_news(*session), "noted: It is hot.");
  seen->say("It gives forces again\nIt is hot");
  EXPECT_EQ(device_news(*session), "noted: It gives forces again.");
  // The reason of a loss is told with the loss alone.
  seen->say("it was unplugged");
  seen->lost = true;
  EXPECT_EQ(device_news(*session),
            "The device \"noted\" is lost: it was unplugged. It is used again as soon as it answers.");
  seen->say("");
  seen->lost = false;
  EXPECT_EQ(device_news(*session), "The device \"noted\" is back.");
}

TEST(SessionDevices, ADeviceOnItsWayOutIsKnownByItsIdentity) {
  const auto session = start(quiet_settings());
  auto slow = std::make_unique<NotedDevice>(std::make_shared<Seen>(), Vector3::Zero(),
                                            std::chrono::milliseconds(500));
  PointerConnection one = connection(std::move(slow), {}, "test");
  one.identity = "test#1";
  ASSERT_TRUE(session->hands().connect(std::move(one)));
  EXPECT_EQ(session->hands().use(0).identity, "test#1");
  ASSERT_TRUE(session->hands().disconnect(0));
  EXPECT_TRUE(session->hands().is_closing("test"));
  EXPECT_TRUE(session->hands().is_closing("test:1", "test#1"));
  EXPECT_FALSE(session->hands().is_closing("test:1"));
}

}  // namespace
}  // namespace icome::session
