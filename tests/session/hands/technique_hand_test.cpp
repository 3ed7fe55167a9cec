// Techniques at work in a session, with devices that a test moves.
#include "session/hands/technique_hand.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/clock.h"
#include "files/design_files.h"
#include "session/sessions.h"
#include "session/storage/recording_files.h"
#include "world/shape/solid_geometry.h"

namespace icome::session {
namespace {

using base::Affine3;
using base::Pose;
using base::Vector3;
using interaction::Holding;
using interaction::Selecting;
using interaction::Technique;
using interaction::Travelling;

/// A session with two devices whose frames are the stage's: the eye is at (0, 0, 0.6) and looks at the
/// origin.
class TechniqueHandTest : public ::testing::Test {
 protected:
  void SetUp() override {
    SessionSettings settings = quiet_settings();
    for (devices::SimulatedDevice*& hand : hands_) {
      auto device = hand_at(Vector3::Zero());
      hand = device.get();
      settings.pointers.push_back(std::move(device));
    }
    session_ = start(std::move(settings));
    look_from(Vector3(0.0, 0.0, 0.6));
  }

  void look_from(const Vector3& eye) {
    interaction::View view;
    view.world_from_eye = Pose(Eigen::Translation3d(eye));
    view.distance = 0.6;
    session_->view().set(view);
  }
  world::ObjectId add(const Vector3& place, double size, const std::string& name = "box") {
    const auto id = add_shape(*session_, world::box(size), world::at(place.x(), place.y(), place.z()), name);
    session_->settle();
    return id;
  }
  void choose(const Technique& technique) {
    const auto chosen = session_->techniques().set(technique);
    ASSERT_TRUE(chosen) << chosen.error().message;
    session_->update();
  }
  void choose(Selecting selecting, Holding holding, Travelling travelling = Travelling::None) {
    choose(desk_technique(selecting, holding, travelling, 0.1, 0.6));
  }
  /// In the device's frame; goes on until the technique has seen it there.
  void put(std::size_t hand, const Vector3& place) {
    hands_[hand]->set_target(place);
    hands_[hand]->put(place);
    run_until(*session_, [&] {
      return (session_->hands().pointer(hand).device_from_stylus.translation() - place).norm() < 1e-6;
    });
  }
  void turn(std::size_t hand, const Vector3& axis, double angle) {
    const base::Quaternion turned(Eigen::AngleAxisd(angle, axis));
    hands_[hand]->turn(turned);
    run_until(*session_, [&] {
      return base::Quaternion(session_->hands().pointer(hand).device_from_stylus.linear())
                 .angularDistance(turned) < 1e-6;
    });
  }
  void press(std::size_t hand, std::uint32_t buttons) {
    hands_[hand]->hold_buttons(buttons);
    run_until(*session_, [&] { return session_->hands().pointer(hand).buttons == buttons; });
  }
  const Affine3& place_of(world::ObjectId id) const { return session_->world().find(id)->parent_from_object; }
  Vector3 where(world::ObjectId id) const { return place_of(id).translation(); }
  Vector3 eye() const { return session_->view().now().world_from_eye.translation(); }

  std::array<devices::SimulatedDevice*, 2> hands_ = {};
  std::unique_ptr<Session> session_;
};

TEST_F(TechniqueHandTest, ARaySelectsAtADistanceWhatItMeetsFirst) {
  const auto far = add({0.0, 0.0, -3.0}, 0.1, "far");
  const auto behind = add({0.0, 0.0, -4.0}, 0.5, "behind");
  const auto aside = add({1.0, 0.0, -3.0}, 0.2, "aside");
  choose(Selecting::RayPointer, Holding::AlongRay);
  put(0, {0.0, 0.0, 0.1});
  EXPECT_EQ(session_->techniques().current()->outcome().pointed.id, far.value);
  EXPECT_NEAR((session_->techniques().current()->outcome().pointed.point - Vector3(0.0, 0.0, -2.95)).norm(),
              0.0, 1e-6);
  EXPECT_TRUE(session_->selection().empty()) << "to point is not to select";
  press(0, 1);
  EXPECT_EQ(session_->selection(), std::vector{far});
  EXPECT_TRUE(session_->hands().holds(0));
  press(0, 0);
  EXPECT_EQ(session_->history().undo_name(), "Add aside") << "a press without a way moves nothing";
  turn(0, Vector3::UnitY(), -std::atan2(1.0, 3.1));
  press(0, 1);
  EXPECT_EQ(session_->selection(), std::vector{aside});
  press(0, 0);
  turn(0, Vector3::UnitY(), 1.5);
  press(0, 1);
  EXPECT_TRUE(session_->selection().empty()) << "it meets nothing there";
  press(0, 0);
  EXPECT_NE(session_->world().find(behind), nullptr);
}

// Made on main, a solid of many operands would hold up the window for seconds.
TEST_F(TechniqueHandTest, SolidsAreGotReadyBesideTheWindow) {
  geometry::CsgTree tree;
  const auto ball = tree.add_leaf(geometry::Primitive(geometry::Sphere{0.2}));
  const auto hole =
      tree.add_leaf(geometry::Primitive(geometry::Box{Vector3::Constant(0.1)}), world::at(0.2, 0.0, 0.0));
  tree.set_root(tree.add(geometry::CsgOperator::Difference, ball, hole));
  const auto solid =
      add_shape(*session_, std::make_shared<world::CsgGeometry>(tree), world::at(0.0, 0.0, -3.0), "solid");
  session_->settle();
  hands_[0]->hold_buttons(1);
  choose(Selecting::RayPointer, Holding::AlongRay);
  EXPECT_TRUE(session_->techniques().current()->is_getting_ready());
  run_until(*session_, [&] { return !session_->techniques().current()->is_getting_ready(); });
  EXPECT_FALSE(session_->hands().holds(0)) << "a button that was down all the time presses nothing";
  press(0, 0);
  put(0, {0.0, 0.0, 0.1});
  EXPECT_EQ(session_->techniques().current()->outcome().pointed.id, solid.value);
  press(0, 1);
  EXPECT_TRUE(session_->hands().holds(0));
}

TEST_F(TechniqueHandTest, WhatHangsOnARayIsMovedAsOneAction) {
  const auto box = add({0.0, 0.0, -3.0}, 0.1);
  choose(Selecting::RayPointer, Holding::AlongRay);
  put(0, {0.0, 0.0, 0.1});
  press(0, 1);
  put(0, {0.02, 0.0, 0.1});
  put(0, {0.05, 0.03, 0.1});
  EXPECT_NEAR((where(box) - Vector3(0.05, 0.03, -3.0)).norm(), 0.0, 1e-5);
  press(0, 5);  // reeled away
  run_until(*session_, [&] { return where(box).z() < -3.2; });
  press(0, 0);
  EXPECT_FALSE(session_->hands().holds(0));
  EXPECT_EQ(session_->history().undo_name(), "Move box");
  ASSERT_TRUE(session_->history().undo());
  EXPECT_EQ(where(box), Vector3(0.0, 0.0, -3.0));
  EXPECT_EQ(session_->history().undo_name(), "Add box");
}

TEST_F(TechniqueHandTest, GoGoReachesWhatTheArmDoesNot) {
  const auto box = add({0.0, 0.0, -0.45}, 0.1);
  choose(Selecting::VirtualHand, Holding::Hand);
  put(0, {0.0, 0.0, -0.1});  // the rim of the device's workspace
  EXPECT_EQ(session_->techniques().current()->outcome().pointed.id, 0U);
  choose(Selecting::GoGo, Holding::GoGo);
  EXPECT_EQ(session_->techniques().current()->outcome().pointed.id, box.value);
  press(0, 1);
  ASSERT_EQ(session_->selection(), std::vector{box});
  // r + k (r - D)^2 with D = 0.6 m, k = 38.9 / m: from 0.489 m behind the middle to the middle.
  const double reach =
      go_go_reach(session_->techniques().current()->technique().selecting_settings.go_go, 0.7) - 0.6;
  EXPECT_NEAR(reach, 0.489, 1e-3);
  put(0, Vector3::Zero());
  EXPECT_NEAR((where(box) - Vector3(0.0, 0.0, -0.45 + reach)).norm(), 0.0, 1e-5);
  press(0, 0);
}

TEST_F(TechniqueHandTest, TwoHandsMoveTurnAndScaleWithoutAJump) {
  const auto box = add(Vector3::Zero(), 0.1);
  choose(Selecting::VirtualHand, Holding::TwoHands);
  put(0, {-0.05, 0.0, 0.0});
  put(1, {0.05, 0.0, 0.0});
  press(0, 1);
  ASSERT_TRUE(session_->hands().holds(0));
  put(0, {-0.05, 0.02, 0.0});
  EXPECT_NEAR((where(box) - Vector3(0.0, 0.02, 0.0)).norm(), 0.0, 1e-6);
  put(0, {-0.05, 0.0, 0.0});
  Affine3 before = place_of(box);
  press(1, 1);
  EXPECT_NEAR((place_of(box).matrix() - before.matrix()).norm(), 0.0, 1e-9) << "the other hand joins";
  put(0, {-0.1, 0.0, 0.0});
  put(1, {0.1, 0.0, 0.0});
  EXPECT_NEAR(place_of(box).linear().determinant(), 8.0, 1e-3) << "twice as far apart";
  before = place_of(box);
  press(1, 0);
  EXPECT_NEAR((place_of(box).matrix() - before.matrix()).norm(), 0.0, 1e-6) << "it lets go";
  put(0, {-0.1, 0.0, 0.03});
  EXPECT_NEAR((where(box) - before.translation() - Vector3(0.0, 0.0, 0.03)).norm(), 0.0, 1e-5);
  EXPECT_NEAR(place_of(box).linear().determinant(), 8.0, 1e-3);
  press(0, 0);
  ASSERT_TRUE(session_->history().undo());
  EXPECT_TRUE(place_of(box).matrix().isIdentity()) << "all of it was one action";
}

TEST_F(TechniqueHandTest, FlyingTakesThePointerAlong) {
  add({0.0, 0.0, -20.0}, 0.1);
  choose(Selecting::RayPointer, Holding::AlongRay, Travelling::Fly);
  put(0, {0.03, 0.01, 0.0});
  const Vector3 from_eye = session_->hands().pointer(0).tip - eye();
  press(0, 2);
  run_until(*session_, [&] { return eye().z() < 0.0; });
  press(0, 0);
  EXPECT_NEAR(eye().x(), 0.0, 1e-9);
  const Vector3 there = eye();
  run_until(*session_, [&] { return (session_->hands().pointer(0).tip - eye() - from_eye).norm() < 1e-3; });
  EXPECT_EQ(eye(), there) << "nobody flies without the button";
  EXPECT_FALSE(session_->history().undo_name() != "Add box") << "to travel is no action";
}

TEST_F(TechniqueHandTest, ATeleportArrivesSoftlyWhereTheHandPointed) {
  add({0.0, 0.0, -5.0}, 1.0);
  look_from(Vector3(0.0, 1.0, 0.6));
  choose(Selecting::RayPointer, Holding::AlongRay, Travelling::Teleport);
  put(0, Vector3::Zero());
  turn(0, Vector3::UnitX(), -std::atan2(1.0, 2.0));  // from 1 m above the floor to 2 m ahead
  press(0, 2);
  ASSERT_TRUE(session_->techniques().current()->outcome().destination);
  EXPECT_NEAR(eye().z(), 0.6, 1e-9) << "not yet";
  press(0, 0);
  run_until(*session_, [&] { return std::abs(eye().z() + 2.0) < 1e-6; });
  EXPECT_NEAR((eye() - Vector3(0.0, 1.0, -2.0)).norm(), 0.0, 1e-6);
  run_until(*session_, [&] {
    return (session_->hands().pointer(0).tip - eye() - Vector3(0.0, 0.0, -0.6)).norm() < 1e-3;
  });
}

TEST_F(TechniqueHandTest, TwoHandsOrbitByAsMuchAsTheyTurn) {
  add(Vector3::Zero(), 0.1);
  choose(Selecting::RayPointer, Holding::AlongRay, Travelling::Orbit);
  put(0, {-0.1, 0.0, 0.0});
  put(1, {0.1, 0.0, 0.0});
  press(0, 2);
  press(1, 2);
  // Both turned by 0.3 rad about the line between them: the eye goes round the other way, and stays there.
  turn(0, Vector3::UnitX(), 0.3);
  turn(1, Vector3::UnitX(), 0.3);
  const auto since = base::steady_nanoseconds();
  run_until(*session_, [&] { return base::steady_nanoseconds() > since + 50'000'000; });
  EXPECT_NEAR((eye() - Vector3(0.0, 0.6 * std::sin(0.3), 0.6 * std::cos(0.3))).norm(), 0.0, 1e-6);
  press(0, 0);
  press(1, 0);
  const Vector3 there = eye();
  run_until(*session_, [&] { return std::abs(session_->hands().pointer(1).tip.y()) < 1e-3; });
  EXPECT_NEAR((eye() - there).norm(), 0.0, 1e-9);
}

TEST_F(TechniqueHandTest, AShrunkenWorldIsMovedFartherAndGrowsBack) {
  const auto box = add({0.0, 0.0, -2.4}, 0.2);
  choose(Selecting::RayPointer, Holding::ScaledWorld);
  put(0, Vector3::Zero());
  const Vector3 from = eye();
  press(0, 1);
  put(0, {0.02, 0.0, 0.0});
  // Grasped 2.9 m from the eye with a hand at 0.6 m.
  EXPECT_NEAR(where(box).x(), 0.02 * 2.9 / 0.6, 1e-5);
  EXPECT_NEAR((eye() - from).norm(), 0.0, 1e-9);
  press(0, 0);
  EXPECT_NEAR((eye() - from).norm(), 0.0, 1e-9);
  put(0, {0.0, 0.0, 0.0});
  EXPECT_NEAR(where(box).x(), 0.02 * 2.9 / 0.6, 1e-5);
}

TEST_F(TechniqueHandTest, AnotherTechniqueLetsGoAndDoesNotTakeItAgain) {
  const auto box = add({0.0, 0.0, -1.0}, 0.2);
  choose(Selecting::RayPointer, Holding::Hand);
  press(0, 1);
  ASSERT_TRUE(session_->hands().holds(0));
  put(0, {0.01, 0.0, 0.0});
  const Vector3 there = where(box);
  EXPECT_GT(there.x(), 0.0);
  choose(Selecting::Spotlight, Holding::Hand);
  put(0, {0.05, 0.0, 0.0});
  EXPECT_FALSE(session_->hands().holds(0)) << "the button was down before";
  EXPECT_EQ(where(box), there);
  ASSERT_TRUE(session_->techniques().set(std::nullopt));
  EXPECT_EQ(session_->techniques().current(), nullptr);
  for (int i = 0; i < 5; ++i) session_->update();
  EXPECT_FALSE(session_->hands().holds(0));
  press(0, 0);
}

TEST_F(TechniqueHandTest, DoesNotGrabByTouch) {
  const auto box = add({-0.5, 0.0, 0.0}, 1.0);
  look_from(Vector3(0.3, 0.0, 0.6));
  hands_[0]->set_target({-0.31, 0.0, 0.0});
  run_until(*session_, [&] { return session_->hands().touched(0) == box; });
  choose(Selecting::LookAt, Holding::Hand);
  press(0, 1);
  for (int i = 0; i < 5; ++i) session_->update();
  EXPECT_FALSE(session_->hands().holds(0)) << "it looks past the box";
  EXPECT_EQ(session_->hands().touched(0), box);
  press(0, 0);
  ASSERT_TRUE(session_->techniques().set(std::nullopt));
  session_->update();
  press(0, 1);
  EXPECT_TRUE(session_->hands().holds(0)) << "by touch again";
}

TEST_F(TechniqueHandTest, LetsGoOfADeviceThatIsLost) {
  const auto box = add({0.0, 0.0, -1.0}, 0.2);
  choose(Selecting::RayPointer, Holding::Hand);
  press(0, 1);
  put(0, {0.01, 0.0, 0.0});
  const Vector3 there = where(box);
  hands_[0]->inject(devices::SimulatedFailure::Unplugged);
  run_until(*session_, [&] { return !session_->hands().holds(0); });
  hands_[0]->inject(devices::SimulatedFailure::None);
  run_until(*session_, [&] { return session_->hands().pointer(0).status == devices::DeviceStatus::Ok; });
  put(0, {0.0, 0.0, 0.0});
  EXPECT_FALSE(session_->hands().holds(0)) << "until the button is pressed anew";
  EXPECT_LT((where(box) - there).norm(), 1e-5) << "as far as the hand had settled";
  press(0, 0);
  press(0, 1);
  EXPECT_TRUE(session_->hands().holds(0));
}

TEST_F(TechniqueHandTest, LetsGoWhenTheWorldIsChangedByOthers) {
  const auto box = add({0.0, 0.0, -1.0}, 0.2);
  choose(Selecting::RayPointer, Holding::Hand);
  press(0, 1);
  put(0, {0.01, 0.0, 0.0});
  ASSERT_TRUE(session_->history().undo());
  session_->update();
  EXPECT_FALSE(session_->hands().holds(0));
  put(0, {0.05, 0.0, 0.0});
  EXPECT_EQ(where(box), Vector3(0.0, 0.0, -1.0));
  press(0, 0);
  put(0, {0.0, 0.0, 0.0});
  press(0, 1);
  ASSERT_TRUE(session_->hands().holds(0));
  ASSERT_TRUE(session_->history().perform(delete_subtree(session_->world(), box), "Delete box"));
  session_->update();
  EXPECT_FALSE(session_->hands().holds(0));
  EXPECT_EQ(session_->techniques().current()->outcome().pointed.id, 0U) << "it is not there any more";
}

TEST_F(TechniqueHandTest, SizesThatCannotBeChangeNothing) {
  choose(Selecting::RayPointer, Holding::Hand);
  Technique wrong;
  wrong.selecting = Selecting::Spotlight;
  wrong.selecting_settings.spotlight = std::nan("");
  EXPECT_FALSE(session_->techniques().set(wrong));
  ASSERT_NE(session_->techniques().current(), nullptr);
  EXPECT_EQ(session_->techniques().current()->technique().selecting, Selecting::RayPointer);
  for (const double size : {0.0, -1.0, 1e300, std::nan(""), HUGE_VAL})
    EXPECT_TRUE(check(desk_technique(Selecting::GoGo, Holding::GoGo, Travelling::Fly, size, 0.6))) << size;
  for (const double distance : {0.0, -1.0, 1e300, std::nan(""), HUGE_VAL})
    EXPECT_TRUE(check(desk_technique(Selecting::GoGo, Holding::GoGo, Travelling::Fly, 0.1, distance)))
        << distance;
}

TEST_F(TechniqueHandTest, ARecordingDoesTheSameOnceMoreToTheLastBit) {
  const auto group = add({0.3, 0.1, -2.0}, 0.3, "stand");
  add({-0.4, 0.0, -2.0}, 0.2, "other");
  ASSERT_TRUE(session_->history().perform(
      world::PlaceObject{group, world::at(0.3, 0.1, -2.0) * Eigen::AngleAxisd(0.7, Vector3(0.6, 0.8, 0.0))},
      "Turn"));
  EXPECT_FALSE(session_->techniques().record()) << "by touch";
  choose(Selecting::RayPointer, Holding::TwoHands, Travelling::Fly);
  const world::World before = session_->world();
  ASSERT_TRUE(session_->techniques().record());
  put(0, {0.3, 0.1, 0.013});
  press(0, 1);
  ASSERT_TRUE(session_->hands().holds(0));
  put(0, {0.31, 0.08, 0.03});
  put(1, {0.1, 0.0, 0.0});
  press(1, 1);
  turn(0, Vector3::UnitZ(), 0.4);
  put(1, {0.2, 0.1, 0.0});
  press(0, 3);  // holds and flies
  for (int i = 0; i < 20; ++i) session_->update();
  press(0, 0);
  press(1, 0);
  press(0, 1);
  put(0, {0.0, 0.0, 0.0});
  press(0, 0);
  const auto recorded = session_->techniques().stop_recording();
  ASSERT_TRUE(recorded);
  EXPECT_TRUE(recorded->is_whole);
  EXPECT_FALSE(session_->techniques().stop_recording());
  EXPECT_NE(hash(session_->world()), hash(before));
  const auto read = interaction::recording_from_text(interaction::recording_to_text(recorded->recording));
  ASSERT_TRUE(read) << read.error().message;
  world::World again = before;
  const auto actions = interaction::replay(again, *read);
  ASSERT_TRUE(actions) << actions.error().message;
  EXPECT_GE(*actions, 1U);
  EXPECT_EQ(hash(again), hash(session_->world()));
  EXPECT_EQ(hash(recorded->beginning), hash(before));
}

TEST_F(TechniqueHandTest, ARecordingIsKeptWithTheDesignThatItBeganWith) {
  add({0.0, 0.0, -1.0}, 0.2);
  choose(Selecting::RayPointer, Holding::Hand);
  ASSERT_TRUE(session_->techniques().record());
  press(0, 1);
  put(0, {0.04, 0.0, 0.0});
  press(0, 0);
  const auto recorded = session_->techniques().stop_recording();
  ASSERT_TRUE(recorded);
  const std::filesystem::path folder = ::testing::TempDir() + "icome-recording";
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "lamp.recording";
  ASSERT_TRUE(write_recording(file, *recorded));
  auto design = files::read_design(folder / "lamp.recording.icome");
  ASSERT_TRUE(design) << design.error().message;
  std::ifstream stream(file);
  const auto read = interaction::recording_from_text(std::string(std::istreambuf_iterator<char>(stream), {}));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_TRUE(interaction::replay(design->world, *read));
  EXPECT_EQ(hash(design->world), hash(session_->world()));
  EXPECT_FALSE(write_recording(folder / "none" / "lamp.recording", *recorded));
  std::filesystem::remove_all(folder);
}

TEST_F(TechniqueHandTest, DoingItOnceMoreCanBeStopped) {
  choose(Selecting::RayPointer, Holding::Hand);
  ASSERT_TRUE(session_->techniques().record());
  put(0, {0.04, 0.0, 0.0});
  const auto recorded = session_->techniques().stop_recording();
  ASSERT_TRUE(recorded);
  ASSERT_GE(recorded->recording.stream.size(), 2U);
  world::World again;
  std::vector<double> parts;
  const auto goes_on = [&](double part) {
    parts.push_back(part);
    return parts.size() < 2;
  };
  EXPECT_FALSE(interaction::replay(again, recorded->recording, goes_on));
  EXPECT_EQ(parts, (std::vector<double>{0.0, 1.0 / double(recorded->recording.stream.size())}));
}

TEST_F(TechniqueHandTest, ARecordingEndsWhereOthersChangeTheWorld) {
  const auto box = add({0.0, 0.0, -1.0}, 0.2);
  choose(Selecting::RayPointer, Holding::Hand);
  const world::World before = session_->world();
  ASSERT_TRUE(session_->techniques().record());
  press(0, 1);
  put(0, {0.04, 0.0, 0.0});
  press(0, 0);
  const std::uint64_t then = hash(session_->world());
  add({5.0, 0.0, 0.0}, 0.2);
  session_->update();
  press(0, 1);
  put(0, {0.0, 0.0, 0.0});
  press(0, 0);
  const auto recorded = session_->techniques().stop_recording();
  ASSERT_TRUE(recorded);
  EXPECT_FALSE(recorded->is_whole);
  world::World again = before;
  ASSERT_TRUE(interaction::replay(again, recorded->recording));
  EXPECT_EQ(hash(again), then);
  EXPECT_NE(where(box), Vector3(0.0, 0.0, -1.0));
}

TEST(MouseTechnique, PointsFromTheEyeThroughTheHand) {
  const auto session = start();
  const auto box = add_shape(*session, world::box(0.2), world::at(1.0, 0.5, -3.0));
  session->settle();
  ASSERT_TRUE(session->techniques().set(
      desk_technique(Selecting::RayPointer, Holding::AlongRay, Travelling::None, 0.1, 1.0)));
  session->update();
  EXPECT_EQ(session->techniques().current()->outcome().pointed.id, 0U) << "the mouse is elsewhere";
  const Vector3 eye = session->view().now().world_from_eye.translation();
  const auto aim_over = [&](const Vector3& place) {
    const Vector3 hand = eye + 0.1 * (place - eye);
    session->hands().put(hand);
    run_until(*session, [&] { return (session->hands().pointer(0).tip - hand).norm() < 1e-6; });
  };
  aim_over({1.0, 0.5, -3.0});
  EXPECT_EQ(session->techniques().current()->outcome().pointed.id, box.value);
  session->hands().hold_buttons(1);
  run_until(*session, [&] { return session->hands().holds(0); });
  aim_over({0.0, 0.5, -3.0});
  const Vector3 there = session->world().find(box)->parent_from_object.translation();
  EXPECT_NEAR(there.x(), 0.0, 0.1);
  session->hands().park();
  session->update();
  EXPECT_FALSE(session->hands().holds(0)) << "a hand that is laid aside holds nothing";
}

TEST(MouseTechnique, KeepsTheMiniatureInSightWhereverTheViewTurns) {
  const auto session = start();
  add_shape(*session, world::box(2.0), world::at(1.0, 0.5, -3.0));
  session->settle();
  ASSERT_TRUE(session->techniques().set(
      desk_technique(Selecting::Miniature, Holding::Miniature, Travelling::None, 0.1, 1.0)));
  const base::Bounds all(Vector3(0.0, -0.5, -4.0), Vector3(2.0, 1.5, -2.0));
  for (const double pitch : {0.0, -0.6, -1.5, 0.9}) {
    for (const double distance : {0.3, 4.0}) {
      interaction::View view;
      view.distance = distance;
      view.world_from_eye =
          Pose(Eigen::Translation3d(3.0, 4.0, 5.0)) *
          Pose(Eigen::AngleAxisd(0.7, Vector3::UnitY()) * Eigen::AngleAxisd(pitch, Vector3::UnitX()));
      session->view().set(view);
      session->update();
      const auto copy = session->techniques().miniature();
      ASSERT_TRUE(copy);
      for (int i = 0; i < 8; ++i) {
        const Vector3 seen =
            view.world_from_eye.inverse() * (*copy * all.corner(base::Bounds::CornerType(i)));
        EXPECT_LT(std::hypot(seen.x(), seen.y()), -seen.z() * std::tan(0.5 * view.field))
            << pitch << ' ' << distance << ' ' << seen.transpose();
      }
    }
  }
}

}  // namespace
}  // namespace icome::session
