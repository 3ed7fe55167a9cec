// A session as the desktop, tools and studies drive it.
#include "session/session.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <new>

#include "devices/simulated/simulated_navigation.h"
#include "render/model/views.h"
#include "session/autosave_samples.h"
#include "session/sessions.h"
#include "world/shape/mesh_geometry.h"

namespace icome::session {
namespace {

using base::Vector3;
using world::at;
using Kind = SessionEvent::Kind;

/// Looks at the origin from a metre away: workspaces lie as in the world.
void look_at_origin(Session& session) { session.view().set({}); }

TEST(Session, ShowsAndFeelsWhatIsEdited) {
  const auto session = start();
  session->settle();
  EXPECT_EQ(session->view().drawn()->object_count(), 0U);
  const auto id = add_box(*session, at(0.0, 0.0, -3.0));
  session->settle();
  ASSERT_EQ(session->view().drawn()->object_count(), 1U);
  EXPECT_EQ(session->view().drawn()->bounds().center(), Vector3(0.0, 0.0, -3.0));
  EXPECT_EQ(session->stage().selection_bounds().center(), Vector3(0.0, 0.0, -3.0));
  const auto picked = session->stage().pick({Vector3(0.1, 0.2, 0.0), -Vector3::UnitZ()});
  ASSERT_TRUE(picked);
  EXPECT_EQ(picked->object, id);
  EXPECT_NEAR((picked->place.point - Vector3(0.1, 0.2, -2.5)).norm(), 0.0, 1e-9);
  ASSERT_TRUE(session->history().perform(world::PlaceObject{id, at(2.0, 0.0, 0.0)}, "Move box"));
  session->settle();
  EXPECT_EQ(session->view().drawn()->bounds().center(), Vector3(2.0, 0.0, 0.0));
  EXPECT_FALSE(session->stage().pick({Vector3(0.1, 0.2, 0.0), -Vector3::UnitZ()}));
  ASSERT_TRUE(session->history().undo());
  session->settle();
  EXPECT_EQ(session->view().drawn()->bounds().center(), Vector3(0.0, 0.0, -3.0));
  ASSERT_TRUE(session->history().undo());
  session->settle();
  EXPECT_EQ(session->view().drawn()->object_count(), 0U);
  EXPECT_FALSE(session->history().undo());
  EXPECT_EQ(session->history().redo_name(), "Add box");
}

TEST(Session, KnowsWhetherClosingLosesSomething) {
  const auto session = start();
  EXPECT_FALSE(session->files().modified());
  const auto id = add_box(*session, at(0.0, 0.0, -3.0));
  EXPECT_TRUE(session->files().modified());
  ASSERT_TRUE(session->history().undo());
  EXPECT_FALSE(session->files().modified());
  ASSERT_TRUE(session->history().redo());
  ASSERT_TRUE(session->history().extend(world::PlaceObject{id, at(2.0, 0.0, 0.0)}));
  EXPECT_TRUE(session->files().modified());
  ASSERT_TRUE(session->history().undo());
  EXPECT_FALSE(session->files().modified());
}

TEST(Session, RefusesWhatMakesNoSense) {
  const auto session = start();
  const auto id = add_box(*session, at(0.0, 0.0, -3.0));
  const std::uint64_t before = world::hash(session->world());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(session->history().perform(world::PlaceObject{id, at(nan, 0.0, 0.0)}, "Move box"));
  EXPECT_FALSE(session->history().extend(world::PlaceObject{id, at(nan, 0.0, 0.0)}));
  ASSERT_TRUE(session->history().undo());
  EXPECT_FALSE(session->history().extend(world::PlaceObject{id, at(1.0, 0.0, 0.0)}));
  ASSERT_TRUE(session->history().redo());
  EXPECT_EQ(world::hash(session->world()), before);
  EXPECT_EQ(session->history().undo_name(), "Add box");
  session->hands().aim({nan, 0.0, 0.0});
  session->settle();
  EXPECT_TRUE(session->hands().pointer(0).tip.allFinite());
}

TEST(Session, TellsOnceWhatIsNotSeenOrFeltAsItIs) {
  auto session = start();
  const auto object = add_shape(*session, std::make_shared<world::MeshGeometry>(geometry::TriangleMesh{}),
                                base::Affine3::Identity(), "nothing");
  const auto texture = session->ids().next<world::TextureId>();
  const auto material = session->ids().next<world::MaterialId>();
  const world::Texture broken{"photo.png", "image/png", std::make_shared<const std::string>("no picture")};
  const auto box = add_box(*session, at(3.0, 0.0, 0.0));
  ASSERT_TRUE(session->history().perform(
      world::EditGroup{{world::CreateTexture{texture, broken},
                        world::CreateMaterial{material, {.name = "paper", .texture = texture}},
                        world::ChooseMaterial{box, material}}},
      "Dress"));
  std::string told;
  const auto listen = [&] {
    for (const SessionEvent& event : session->update()) {
      if (event.kind != Kind::NotAsItIs) continue;
      for (const std::string& it : event.details) told += it + "\n";
    }
    return told.find("photo.png is not shown") != std::string::npos &&
           told.find("\"nothing\" is empty") != std::string::npos;
  };
  while (!listen()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const std::string before = told;
  ASSERT_TRUE(session->history().perform(world::PlaceObject{object, at(0.0, 1.0, 0.0)}, "Move"));
  session->settle();
  listen();
  EXPECT_EQ(told, before);
}

TEST(Session, SelectsOnlyWhatIsThere) {
  const auto session = start();
  int heard = 0;
  session->on_selection([&] { ++heard; });
  const auto one = add_box(*session, at(0.0, 0.0, -3.0));
  const auto other = add_box(*session, at(3.0, 0.0, -3.0));
  session->select({other, one, other, {77}});
  EXPECT_EQ(session->selection(), (std::vector<world::ObjectId>{other, one}));
  EXPECT_EQ(heard, 1);
  session->select({other, one});
  EXPECT_EQ(heard, 1);
  ASSERT_TRUE(session->history().perform(delete_subtree(session->world(), other), "Delete"));
  EXPECT_EQ(session->selection(), (std::vector<world::ObjectId>{one}));
  EXPECT_EQ(heard, 2);
  ASSERT_TRUE(session->history().undo());  // it is back, but nobody has selected it
  EXPECT_EQ(session->selection(), (std::vector<world::ObjectId>{one}));
  session->files().make_new();
  EXPECT_TRUE(session->selection().empty());
  EXPECT_EQ(heard, 3);
}

TEST(Session, ShowsOneSceneAndAllAgainWhenItGoes) {
  const auto session = start();
  const auto one = add_box(*session, at(0.0, 0.0, -3.0));
  add_box(*session, at(5.0, 0.0, -3.0));
  const auto scene = session->ids().next<world::SceneId>();
  ASSERT_TRUE(session->history().perform(
      world::EditGroup{{world::CreateScene{scene, "one"}, world::EnterScene{scene, one, 0}}}, "Make scene"));
  session->stage().show_scene(scene);
  session->settle();
  EXPECT_EQ(session->view().drawn()->object_count(), 1U);
  EXPECT_FALSE(session->stage().pick({Vector3(5.0, 0.0, 0.0), -Vector3::UnitZ()}));
  EXPECT_TRUE(session->stage().pick({Vector3(0.0, 0.0, 0.0), -Vector3::UnitZ()}));
  EXPECT_NEAR(session->stage().selection_bounds().max().x(), 0.5, 1e-12);
  ASSERT_TRUE(session->history().undo());
  EXPECT_EQ(session->stage().shown_scene(), world::SceneId{});
  session->settle();
  EXPECT_EQ(session->view().drawn()->object_count(), 2U);
  session->stage().show_scene({12345});  // there is none
  EXPECT_EQ(session->stage().shown_scene(), world::SceneId{});
}

TEST(Session, OpensAndSavesInTheBackground) {
  const ScratchFolder folder;
  const auto session = start();
  add_box(*session, at(0.0, 0.0, -3.0), "kept");
  const std::uint64_t hash = world::hash(session->world());
  session->files().save(folder.path() / "a.icome");
  ASSERT_TRUE(session->history().undo());  // what was saved is what was there
  auto events = run_until(*session, [&] { return !session->files().saving(); });
  EXPECT_EQ(count(events, Kind::Saved) + count(session->update(), Kind::Saved), 1U);
  EXPECT_EQ(session->files().path(), folder.path() / "a.icome");
  EXPECT_TRUE(session->files().modified());
  ASSERT_TRUE(session->history().redo());
  EXPECT_FALSE(session->files().modified());

  session->files().make_new();
  EXPECT_TRUE(session->world().objects().empty());
  session->files().open(folder.path() / "a.icome");
  events = run_until(*session, [&] { return !session->world().objects().empty(); });
  EXPECT_EQ(count(events, Kind::Opened), 1U);
  EXPECT_EQ(world::hash(session->world()), hash);
  EXPECT_FALSE(session->history().undo());  // histories end where a design is opened
  EXPECT_FALSE(session->files().modified());
  add_box(*session, at(0.0, 0.0, 3.0));  // its id is a new one
  session->settle();
  EXPECT_EQ(session->view().drawn()->object_count(), 2U);
}

TEST(Session, ASaveThatLeavesThingsOutCountsAsChanged) {
  const ScratchFolder folder, autosave;
  SessionSettings settings = quiet_settings();
  settings.autosave_folder = autosave.path();
  const auto session = start(std::move(settings));
  add_box(*session, at(0.0, 0.0, -3.0), "kept");
  ASSERT_TRUE(session->history().perform(
      world::CreateMaterial{session->ids().next<world::MaterialId>(), {.name = "oak"}}, "Make material"));
  session->files().save(folder.path() / "a.stl");
  auto events = run_until(*session, [&] { return !session->files().saving(); });
  const auto more = session->update();
  EXPECT_EQ(count(events, Kind::SavedInPart) + count(more, Kind::SavedInPart), 1U);
  EXPECT_TRUE(session->files().modified());
  EXPECT_FALSE(session->files().left_out().empty());
  session->settle();
  EXPECT_FALSE(std::filesystem::is_empty(autosave.path())) << "the work is still kept against a crash";
  session->files().save(folder.path() / "a.wrl");
  events = run_until(*session, [&] { return !session->files().saving(); });
  EXPECT_EQ(count(events, Kind::Saved) + count(session->update(), Kind::Saved), 1U)
      << "nothing is made of oak";
  session->settle();
  EXPECT_FALSE(session->files().modified());
  EXPECT_TRUE(session->files().left_out().empty());
  EXPECT_TRUE(std::filesystem::is_empty(autosave.path()));
}

TEST(Session, AsksBeforeItReplacesADamagedDesign) {
  const ScratchFolder folder;
  const auto session = start();
  add_box(*session, at(0.0, 0.0, -3.0), "kept");
  const auto path = folder.path() / "a.icome";
  ASSERT_TRUE(files::write_journal(path, session->world()));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 30);
  const auto bytes = std::filesystem::file_size(path);
  session->files().save(path);
  const auto events = run_until(*session, [&] { return !session->files().saving(); });
  EXPECT_EQ(count(events, Kind::SaveAsks) + count(session->update(), Kind::SaveAsks), 1U);
  EXPECT_TRUE(session->files().modified());
  EXPECT_EQ(std::filesystem::file_size(path), bytes);
  session->files().save(path, true);
  run_until(*session, [&] { return !session->files().saving(); });
  session->update();
  EXPECT_FALSE(session->files().modified());
  EXPECT_GT(std::filesystem::file_size(path), bytes);
}

TEST(Session, KeepsTheWorldWhenADesignCannotBeOpenedOrSaved) {
  const ScratchFolder folder;
  const auto session = start();
  add_box(*session, at(0.0, 0.0, -3.0));
  const std::uint64_t hash = world::hash(session->world());
  std::ofstream(folder.path() / "broken.glb") << "glTF, or so it says";
  for (const auto& design : {folder.path() / "missing.glb", folder.path() / "broken.glb"}) {
    session->files().open(design);
    session->settle();
    const auto events = session->update();
    EXPECT_EQ(count(events, Kind::OpenFailed), 1U) << design;
    EXPECT_EQ(world::hash(session->world()), hash);
  }
  session->files().save(folder.path() / "no/such/folder/a.icome");
  auto events = run_until(*session, [&] { return !session->files().saving(); });
  EXPECT_EQ(count(events, Kind::SaveFailed) + count(session->update(), Kind::SaveFailed), 1U);
  EXPECT_TRUE(session->files().modified());
  EXPECT_TRUE(session->files().path().empty());
}

TEST(Session, TurnsDesignsWithZUpAndBack) {
  const ScratchFolder folder;
  // One facet that stands at z = 1 ... 2.
  std::ofstream(folder.path() / "up.stl")
      << "solid s\nfacet normal 0 1 0\nouter loop\nvertex 0 0 1\nvertex 0 0 2\n"
         "vertex 1 0 1\nendloop\nendfacet\nendsolid s\n";
  const auto session = start();
  session->files().open(folder.path() / "up.stl");
  run_until(*session, [&] { return !session->world().objects().empty(); });
  EXPECT_EQ(session->stage().selection_bounds().max(), Vector3(1.0, 2.0, 0.0));
  session->files().save(folder.path() / "again.stl");
  session->files().save(folder.path() / "other.glb");
  run_until(*session, [&] { return !session->files().saving(); });
  for (const char* name : {"again.stl", "other.glb"}) {
    session->files().make_new();
    session->files().open(folder.path() / name);
    run_until(*session, [&] { return !session->world().objects().empty(); });
    EXPECT_NEAR((session->stage().selection_bounds().max() - Vector3(1.0, 2.0, 0.0)).norm(), 0.0, 1e-6)
        << name;
  }
}

TEST(Session, TellsOfDevicesThatGoAndComeBack) {
  SessionSettings settings = quiet_settings();
  auto first = hand_at({0.0, 0.0, 0.1});
  auto second = hand_at({0.1, 0.0, 0.1});
  auto *lost_at_start = first.get(), *fine = second.get();
  lost_at_start->inject(devices::SimulatedFailure::Unplugged);
  settings.pointers.push_back(std::move(first));
  settings.pointers.push_back(std::move(second));
  const auto session = start(std::move(settings));
  ASSERT_EQ(session->hands().pointers(), 2U);
  std::size_t lost = 0, back = 0;
  const auto run = [&](std::size_t lost_in_all, std::size_t back_in_all) {
    while (lost < lost_in_all || back < back_in_all) {
      for (const auto& events : {session->update()}) {
        lost += count(events, Kind::DeviceLost);
        back += count(events, Kind::DeviceBack);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(lost, lost_in_all);
    EXPECT_EQ(back, back_in_all);
  };
  run(1, 0);
  lost_at_start->inject(devices::SimulatedFailure::None);
  run(1, 1);
  fine->inject(devices::SimulatedFailure::Unplugged);
  run(2, 1);
  EXPECT_EQ(session->hands().pointer(1).force, Vector3::Zero());
  EXPECT_EQ(session->hands().pointer(0).status, devices::DeviceStatus::Ok);
  fine->inject(devices::SimulatedFailure::None);
  run(2, 2);
}

TEST(Session, SeveralPointersTouchAtOnce) {
  SessionSettings settings = quiet_settings();
  std::vector<devices::SimulatedDevice*> hands;
  for (const double x : {-0.7, 0.7}) {
    auto hand = hand_at({x, 0.0, 0.6});
    hands.push_back(hand.get());
    settings.pointers.push_back(std::move(hand));
  }
  const auto session = start(std::move(settings));
  look_at_origin(*session);
  const auto left = add_box(*session, at(-0.7, 0.0, 0.0));
  const auto right = add_box(*session, at(0.7, 0.0, 0.0));
  session->settle();
  hands[0]->set_target({-0.7, 0.0, 0.49});
  hands[1]->set_target({0.7, 0.0, 0.49});
  run_until(*session, [&] { return session->hands().touched(0) && session->hands().touched(1); });
  EXPECT_EQ(session->hands().touched(0), left);
  EXPECT_EQ(session->hands().touched(1), right);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(session->hands().pointer(i).scp.z(), 0.5, 1e-6);
}

TEST(Session, TheMouseDrivesAHandThatIsHeldBackBySurfaces) {
  const auto session = start();
  look_at_origin(*session);
  const auto id = add_box(*session, at(0.0, 0.0, 0.0));
  session->settle();
  session->hands().aim({0.1, 0.1, 0.49});
  // The hand comes to rest above where the mouse is; on a busy machine it may swing through at first.
  run_until(*session, [&] {
    const auto hand = session->hands().pointer(0);
    return session->hands().touched(0) && hand.force.z() > 0.5 && hand.tip.z() > 0.49;
  });
  EXPECT_EQ(session->hands().touched(0), id);
  EXPECT_NEAR(session->hands().pointer(0).scp.z(), 0.5, 1e-6);
  EXPECT_TRUE(session->hands().servo().running);
  EXPECT_FALSE(session->hands().take_forces().empty());
  // What is touched goes: nothing is touched any more, by no name.
  ASSERT_TRUE(session->history().perform(delete_subtree(session->world(), id), "Delete"));
  run_until(*session,
            [&] { return !session->hands().touched(0) && session->hands().pointer(0).force.norm() == 0.0; });
}

TEST(Session, ParksTheHandAtTheEyeWhateverStandsInTheWay) {
  const auto session = start();
  look_at_origin(*session);
  add_box(*session, at(0.0, 0.0, 0.0));
  session->settle();
  session->hands().aim({0.0, 0.0, 0.49});
  run_until(*session, [&] { return session->hands().touched(0).has_value(); });
  // From behind: the box lies between the hand and the eye.
  interaction::View behind = session->view().now();
  const base::Vector3 eye(0.0, 0.0, -4.0);
  behind.world_from_eye.linear() =
      Eigen::AngleAxisd(3.141592653589793, base::Vector3::UnitY()).toRotationMatrix();
  behind.world_from_eye.translation() = eye;
  session->view().set(behind);
  session->hands().park();
  run_until(*session, [&] { return (session->hands().pointer(0).tip - eye).norm() < 1e-6; });
  EXPECT_EQ(session->hands().pointer(0).scp, session->hands().pointer(0).tip);
  EXPECT_FALSE(session->hands().touched(0));
  // It is also put elsewhere without a way, and from there it meets the side that it comes to.
  session->hands().put({0.0, 0.0, 0.6});
  run_until(*session, [&] { return session->hands().pointer(0).scp.z() > 0.55; });
  EXPECT_FALSE(session->hands().touched(0));
  session->hands().put({0.0, 0.0, -0.6});
  session->hands().aim({0.0, 0.0, 0.49});
  run_until(*session, [&] { return session->hands().touched(0).has_value(); });
  EXPECT_NEAR(session->hands().pointer(0).scp.z(), -0.5, 1e-6);
}

TEST(Session, AHandThatIsParkedWithinASolidFeelsNothing) {
  const auto session = start();
  look_at_origin(*session);
  add_box(*session, at(0.0, 0.0, 0.0));
  session->settle();
  interaction::View inside = session->view().now();
  session->hands().park();
  for (int i = 0; i < 20; ++i) {
    const base::Vector3 eye(0.02 * i, 0.0, 0.4);
    inside.world_from_eye.translation() = eye;
    session->view().set(inside);
    run_until(*session, [&] {
      EXPECT_EQ(session->hands().pointer(0).force, base::Vector3::Zero());
      EXPECT_FALSE(session->hands().touched(0));
      return (session->hands().pointer(0).tip - eye).norm() < 1e-6;
    });
    EXPECT_EQ(session->hands().pointer(0).scp, session->hands().pointer(0).tip);
  }
  for (const ForceSample& sample : session->hands().take_forces()) EXPECT_EQ(sample.force, 0.0F);
  // Aimed again, it is a hand within a solid, which puts it at its surface.
  session->hands().aim({0.38, 0.0, 0.4});
  run_until(*session, [&] { return session->hands().touched(0).has_value(); });
}

TEST(Session, HomeFitsThePictureAsItIsNow) {
  SessionSettings settings = quiet_settings();
  auto device = std::make_unique<devices::SimulatedNavigation>();
  devices::SimulatedNavigation* const navigation = device.get();
  settings.navigation = std::move(device);
  const auto session = start(std::move(settings));
  add_box(*session, at(0.0, 0.0, 0.0));
  add_box(*session, at(9.0, 0.0, 9.0));
  const render::ViewDirection iso = *render::view_direction("iso");
  const auto distance_for = [&](double aspect) {
    return interaction::fitted(session->view().now(), session->stage().selection_bounds(), iso.toward_eye,
                               iso.up, aspect)
        .distance;
  };
  EXPECT_GT(std::abs(distance_for(0.5) - distance_for(3.0)), 0.1 * distance_for(3.0));
  devices::NavigationState home;
  home.buttons = 2;
  session->update();
  for (const double aspect : {3.0, 0.5, 1.0}) {
    session->view().set_aspect(aspect);
    for (const double no_shape : {0.0, -1.0, std::nan(""), HUGE_VAL}) session->view().set_aspect(no_shape);
    const double there = distance_for(aspect);
    navigation->hold(home);
    run_until(*session, [&] { return std::abs(session->view().now().distance - there) < 1e-9 * there; });
    navigation->hold({});
    session->update();
  }
}

/// Finds no memory for any edit.
class NeverFollowing final : public Representation {
 public:
  void open(const world::World&, world::SceneId) override {}
  void show(const world::World&, world::SceneId) override {}
  void follow(const world::World&, const world::Changes&) override { throw std::bad_alloc(); }
};

TEST(Session, TellsWhenARepresentationFallsBehindAndGoesOn) {
  SessionSettings settings = quiet_settings();
  settings.representations.push_back(std::make_unique<NeverFollowing>());
  const auto session = start(std::move(settings));
  session->settle();
  session->update();
  add_box(*session, at(0.0, 0.0, 0.0));
  session->settle();
  const auto events = session->update();
  ASSERT_EQ(count(events, SessionEvent::Kind::Notice), 1U);
  EXPECT_NE(events[0].text.find("has fallen behind"), std::string::npos);
  add_box(*session, at(2.0, 0.0, 0.0));
  session->settle();
  EXPECT_EQ(session->view().drawn()->object_count(), 2U);
}

TEST(Session, CarriesTheHandWithTheView) {
  SessionSettings settings = quiet_settings();
  settings.pointers.push_back(hand_at({0.0, 0.0, 0.0}));
  const auto session = start(std::move(settings));
  look_at_origin(*session);
  run_until(*session, [&] { return session->hands().pointer(0).tip.norm() < 1e-9; });
  interaction::View view;
  view.world_from_eye.translation() = Vector3(1.0, 2.0, 1.0);
  session->view().fly_to(view);
  run_until(*session,
            [&] { return (session->hands().pointer(0).tip - Vector3(1.0, 2.0, 0.0)).norm() < 1e-9; });
  EXPECT_EQ(session->hands().pointer(0).force, Vector3::Zero());
}

TEST(Session, RecoversWorkOfASessionThatWasNotClosed) {
  const ScratchFolder folder;
  SessionSettings settings = quiet_settings();
  settings.autosave_folder = folder.path();
  std::uint64_t hash = 0;
  {
    const auto session = start(std::move(settings));
    add_box(*session, at(0.0, 0.0, -3.0), "precious");
    hash = world::hash(session->world());
  }
  for (const bool keep : {true, false}) {
    SessionSettings again = quiet_settings();
    again.autosave_folder = folder.path();
    const auto session = start(std::move(again));
    const auto work = session->files().recoverable();
    ASSERT_EQ(work.size(), 1U);
    session->files().recover(work.front());
    const auto events = run_until(*session, [&] { return !session->world().objects().empty(); });
    EXPECT_EQ(count(events, Kind::Recovered), 1U);
    EXPECT_EQ(world::hash(session->world()), hash);
    EXPECT_TRUE(session->files().modified());
    session->settle();
    if (!keep) session->files().close();
  }
  SessionSettings last = quiet_settings();
  last.autosave_folder = folder.path();
  EXPECT_TRUE(start(std::move(last))->files().recoverable().empty());
}

TEST(Session, WhatWasSavedInTheEndIsNotRecovered) {
  const ScratchFolder folder;
  SessionSettings settings = quiet_settings();
  settings.autosave_folder = folder.path() / "autosave";
  {
    const auto session = start(std::move(settings));
    add_box(*session, at(0.0, 0.0, -3.0));
    session->files().save(folder.path() / "a.icome");
  }
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "a.icome"));
  EXPECT_TRUE(find_recoverable_work(folder.path() / "autosave").empty());
}

TEST(Session, RefusesARateThatNoLoopHas) {
  SessionSettings settings = quiet_settings();
  settings.servo.rate_hz = 3.0;
  EXPECT_FALSE(Session::create(std::move(settings)));
}

}  // namespace
}  // namespace icome::session
