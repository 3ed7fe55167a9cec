// Nobody waits for anybody (thesis 5.6.1): shown by what goes on while others are held up.
#include <fmt/format.h>

#include <atomic>

#include "devices/simulated/simulated_device.h"
#include "render/live_renderer.h"
#include "session/autosave_samples.h"
#include "session/held_shape.h"
#include "session/sessions.h"

namespace icome::session {
namespace {

using base::Vector3;
using world::at;

#if defined(ICOME_ADDRESS_SANITIZER) || defined(ICOME_THREAD_SANITIZER)
constexpr int kFrequency = 71;  // 100,820 triangles: work takes ten times as long
#else
constexpr int kFrequency = 230;  // 1,058,000 triangles
#endif

/// A display thread with a picture of its own, as a window has. Needs an OpenGL driver.
class Eye {
 public:
  explicit Eye(DisplayFeed& feed) : feed_(feed), thread_([this] { run(); }) {}
  ~Eye() {
    stop_.store(true);
    thread_.join();
  }
  /// Waits until so many frames more have been drawn.
  void wait_for_frames(std::uint64_t more) const {
    const std::uint64_t until = feed_.frames() + more;
    while (feed_.frames() < until) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  /// Of the newest version that was drawn.
  std::size_t objects() const { return objects_.load(); }

 private:
  void run() {
    render::LiveRenderer live(64, 48);
    while (!stop_.load()) {
      feed_.is_due();
      const auto drawn = feed_.draw(live.renderer(), live.target());
      EXPECT_TRUE(drawn) << (drawn ? "" : drawn.error().message);
      objects_.store(feed_.scene()->object_count());
    }
  }

  DisplayFeed& feed_;
  std::atomic<bool> stop_ = false;
  std::atomic<std::size_t> objects_ = 0;
  std::thread thread_;
};

bool can_draw() { return render::Offscreen::create().has_value(); }

/// Presses a tip onto the box there.
std::unique_ptr<Session> pressing_session(world::ObjectId* box) {
  auto session = start();
  session->view().set({});
  *box = add_box(*session, at(0.0, 0.0, 0.0));
  session->settle();
  session->hands().aim({0.0, 0.0, 0.49});
  run_until(*session,
            [&] { return session->hands().touched(0) && session->hands().pointer(0).force.z() > 0.5; });
  return session;
}

void wait_for_ticks(const Session& session, std::uint64_t more) {
  const std::uint64_t until = session.hands().servo().summary.ticks + more;
  while (session.hands().servo().summary.ticks < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

TEST(SessionThreads, AnEditInFlightHoldsUpNeitherHandNorEyeNorOtherEdits) {
  if (!can_draw()) GTEST_SKIP() << "there is no OpenGL without a window here";
  world::ObjectId box;
  const auto session = pressing_session(&box);
  session->settle();
  const Eye eye(session->view().display());
  eye.wait_for_frames(2);
  const auto big = std::make_shared<HeldShape>(geometry::bumpy_geodesic_sphere(kFrequency, 0.3, 0.1, 9));
  add_shape(*session, big, at(5.0, 0.0, 0.0), "big");
  // Both representations are in the middle of it.
  while (big->at_work() < 2) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  // That the rest goes on at all shows that nobody waits for them.
  const auto before = session->view().drawn();
  for (int i = 1; i <= 100; ++i)
    ASSERT_TRUE(session->history().perform(world::PlaceObject{box, at(0.0, 0.0, -1e-5 * i)}, "Move box"));
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(session->history().undo());
  add_box(*session, at(-5.0, 0.0, 0.0));
  wait_for_ticks(*session, 200);
  eye.wait_for_frames(5);
  session->update();
  EXPECT_EQ(session->view().drawn(), before);
  EXPECT_EQ(eye.objects(), 1U);  // the last version that was published
  EXPECT_EQ(session->hands().touched(0), box);
  EXPECT_NEAR(session->hands().pointer(0).scp.z(), 0.5, 1e-6);
  EXPECT_GT(session->hands().pointer(0).force.z(), 0.5);
  big->let_go();
  // Now it takes as long as it takes, while hand and eye go on.
  run_until(*session, [&] { return session->view().drawn() != before; });
  session->settle();
  eye.wait_for_frames(2);
  EXPECT_EQ(session->view().drawn()->object_count(), 3U);
  EXPECT_EQ(eye.objects(), 3U);
  EXPECT_TRUE(session->stage().pick({Vector3(5.0, 0.0, 2.0), -Vector3::UnitZ()}));
  EXPECT_EQ(session->hands().touched(0), box);
}

/// Work that a test holds up.
class Held final : public Representation {
 public:
  struct Gate {
    std::atomic<int> entered = 0;
    std::atomic<bool> shut = true;
  };
  explicit Held(Gate& gate) : gate_(gate) {}
  void open(const world::World&, world::SceneId) override {}
  void show(const world::World&, world::SceneId) override {}
  void follow(const world::World&, const world::Changes&) override {
    ++gate_.entered;
    gate_.entered.notify_all();
    gate_.shut.wait(true);
  }

 private:
  Gate& gate_;
};

TEST(SessionThreads, ARepresentationOfOnesOwnMayLagBehindForAsLongAsItLikes) {
  Held::Gate gate;
  SessionSettings settings = quiet_settings();
  settings.representations.push_back(std::make_unique<Held>(gate));
  const auto session = start(std::move(settings));
  session->settle();  // its world has been opened: what comes now is followed
  const auto box = add_box(*session, at(0.0, 0.0, -3.0));
  gate.entered.wait(0);
  for (int i = 1; i <= 3000; ++i)  // more than its pipe holds
    ASSERT_TRUE(session->history().perform(world::PlaceObject{box, at(0.001 * i, 0.0, -3.0)}, "Move box"));
  run_until(*session, [&] { return session->view().drawn()->bounds().center().x() > 2.9999; });
  EXPECT_EQ(gate.entered.load(), 1);
  gate.shut.store(false);
  gate.shut.notify_all();
  session->settle();
  EXPECT_LT(gate.entered.load(), 20);  // all in few rounds
}

/// A plate of 320,000 triangles: reading takes longer than it takes to begin with something else.
std::filesystem::path write_large_obj(const std::filesystem::path& file) {
  constexpr int kSide = 400;
  std::string text;
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x)
      text += fmt::format("v {} {} {}\n", 0.001 * x, 0.001 * y, 1e-4 * (x % 7));
  for (int y = 0; y < kSide; ++y) {
    for (int x = 1; x <= kSide; ++x) {
      const int a = y * (kSide + 1) + x, b = a + kSide + 1;
      text += fmt::format("f {} {} {}\nf {} {} {}\n", a, a + 1, b, a + 1, b + 1, b);
    }
  }
  std::ofstream(file) << text;
  return file;
}

void wait_until_reading(const Session& session) {
  wait_until([&] { return session.files().opening().value() > 0.0; });
}

TEST(SessionThreads, EndWhileALargeDesignIsReadAndLoseNothing) {
  for (const bool saves : {false, true}) {
    const ScratchFolder folder;
    const auto large = write_large_obj(folder.path() / "large.obj");
    const auto saved = folder.path() / "saved.icome";
    SessionSettings settings = quiet_settings();
    settings.autosave_folder = folder.path() / "autosave";
    auto session = start(std::move(settings));
    for (int i = 0; i < 20; ++i) add_box(*session, at(2.0 * i, 0.0, -3.0));
    const auto work = hash(session->world());
    session->files().open(large);
    wait_until_reading(*session);
    if (saves) session->files().save(saved);
    session.reset();
    // One of them at least has the work, and what there is is whole.
    const auto journals = journals_in(folder.path() / "autosave");
    if (!saves) {
      EXPECT_EQ(journals.size(), 1U);
    }
    bool kept = false;
    for (const auto& journal : journals) {
      EXPECT_EQ(hash(world_in(journal)), work);
      kept = true;
    }
    if (std::filesystem::exists(saved)) {
      EXPECT_EQ(hash(world_in(saved)), work);
      kept = true;
    }
    EXPECT_TRUE(kept);
  }
}

TEST(SessionThreads, EndWhateverIsUnderWay) {
  const ScratchFolder folder;
  const auto large = write_large_obj(folder.path() / "large.obj");
  for (int moment = 0; moment < 6; ++moment) {
    const auto big = std::make_shared<HeldShape>(geometry::bumpy_geodesic_sphere(20, 0.3, 0.1, 9));
    auto session = start();
    if (moment >= 1) add_box(*session, at(0.0, 0.0, -3.0));
    if (moment >= 2) add_shape(*session, big, at(5.0, 0.0, 0.0));
    if (moment >= 3) {
      session->files().open(large);
      wait_until_reading(*session);
    }
    if (moment >= 4) {
      while (big->at_work() < 2) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      session->files().save(folder.path() / "end.icome");  // of a shape that cannot be written
    }
    std::thread helper;
    if (moment >= 5) {
      helper = std::thread([&] { big->let_go(); });
    } else {
      big->let_go();
    }
    session.reset();
    if (helper.joinable()) helper.join();
  }
}

TEST(SessionThreads, AreAllBusyAtOnce) {
  const ScratchFolder folder;  // goes after the session, the threads of which write there
  SessionSettings settings = quiet_settings();
  settings.autosave_folder = folder.path() / "autosave";
  std::vector<devices::SimulatedDevice*> hands;
  for (int i = 0; i < 2; ++i) {
    auto hand = std::make_unique<devices::SimulatedDevice>();
    hands.push_back(hand.get());
    settings.pointers.push_back(std::move(hand));
  }
  const auto session = start(std::move(settings));
  std::optional<Eye> eye;
  if (can_draw()) eye.emplace(session->view().display());
  base::Random random(99);
  std::vector<world::ObjectId> boxes;
  for (int i = 0; i < 20; ++i)
    boxes.push_back(add_box(*session, at(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), 0.0)));
  const auto scene = session->ids().next<world::SceneId>();
  ASSERT_TRUE(session->history().perform(
      world::EditGroup{{world::CreateScene{scene, "some"}, world::EnterScene{scene, boxes[0], 0},
                        world::EnterScene{scene, boxes[1], 1}}},
      "Make scene"));
  const auto mesh = add_shape(
      *session, std::make_shared<world::MeshGeometry>(geometry::bumpy_geodesic_sphere(30, 0.5, 0.1, 5)),
      at(0.0, 0.0, -2.0), "mesh");
  const auto shape = session->world().find(mesh)->geometry;
  for (int round = 0; round < 150; ++round) {
    ASSERT_TRUE(session->history().perform(
        world::PlaceObject{boxes[random.index(boxes.size())], at(random.uniform(-3.0, 3.0), 0.0, 0.0)},
        "Move"));
    if (round % 3 == 0) {
      const world::MoveVertices pull{shape, {std::uint32_t(random.index(9000))}, {random.direction()}};
      ASSERT_TRUE(session->history().perform(pull, "Pull"));
    }
    if (round % 4 == 0) {
      ASSERT_TRUE(session->history().undo());
    }
    if (round % 10 == 0) session->stage().show_scene(round % 20 == 0 ? scene : world::SceneId{});
    if (round % 30 == 7) session->files().save(folder.path() / "busy.icome");
    if (round == 100) session->files().open(folder.path() / "busy.icome");
    if (round == 101) session->files().cancel_open();
    if (round % 25 == 5) hands[0]->inject(devices::SimulatedFailure::Unplugged);
    if (round % 25 == 8) hands[0]->inject(devices::SimulatedFailure::None);
    for (devices::SimulatedDevice* hand : hands) hand->set_target(0.5 * random.direction());
    session->select({boxes[random.index(boxes.size())]});
    if (round % 20 == 0) session->view().fly_to(interaction::orbited(session->view().now(), 0.3, 0.1));
    session->update();
    (void)session->stage().pick({Vector3(0.0, 0.0, 5.0), -Vector3::UnitZ()});
    (void)session->hands().servo();
  }
  session->settle();
  EXPECT_EQ(session->view().drawn()->object_count(), session->stage().shown_scene() ? 2U : 21U);
  if (eye) eye->wait_for_frames(1);
  eye.reset();
  session->files().close();
}

}  // namespace
}  // namespace icome::session
