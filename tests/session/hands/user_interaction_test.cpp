#include "session/hands/user_interaction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "devices/simulated/simulated_head.h"
#include "devices/simulated/simulated_navigation.h"

namespace icome::session {
namespace {

using base::Pose;
using base::Vector3;
using devices::DeviceStatus;
using devices::NavigationState;
using devices::SimulatedHead;
using devices::SimulatedNavigation;
using interaction::NavigationMode;
using interaction::View;
using std::numbers::pi;

constexpr double kFrame = 1.0 / 60.0;  // s

NavigationState pushed(double x, double y, double z) {
  NavigationState state;
  state.push = {x, y, z};
  return state;
}

NavigationState button(std::uint32_t buttons) {
  NavigationState state;
  state.buttons = buttons;
  return state;
}

/// A user with devices that a test can move.
struct User {
  User() {
    auto mouse = std::make_unique<SimulatedNavigation>();
    auto tracker = std::make_unique<SimulatedHead>();
    navigation = mouse.get();
    head = tracker.get();
    interaction = std::make_unique<UserInteraction>(std::move(mouse), std::move(tracker));
  }
  UserInteraction::News frames(int count) {
    UserInteraction::News all;
    for (int i = 0; i < count; ++i) {
      const UserInteraction::News news = interaction->update(kFrame);
      all.home = all.home || news.home;
      all.devices.insert(all.devices.end(), news.devices.begin(), news.devices.end());
    }
    return all;
  }
  UserInteraction& operator*() const { return *interaction; }
  UserInteraction* operator->() const { return interaction.get(); }

  SimulatedNavigation* navigation;
  SimulatedHead* head;
  std::unique_ptr<UserInteraction> interaction;
};

/// From the right and above, 2 m off.
View from_aside() {
  return interaction::orbited(interaction::zoomed(View(), 2.0, Vector3::Zero()), pi / 2.0, 0.5);
}

/// Where a device's tip is in the eye's frame.
Vector3 seen(const UserInteraction& user, const Vector3& in_device) {
  return user.view().world_from_eye.inverse() * (user.stage_from_device() * in_device);
}

TEST(UserInteraction, WorksWithoutDevices) {
  UserInteraction user;
  user.set_view(from_aside());
  EXPECT_TRUE(user.update(kFrame).devices.empty());
  EXPECT_EQ(user.view().world_from_eye.matrix(), from_aside().world_from_eye.matrix());
  EXPECT_EQ(user.drawn_view().world_from_eye.matrix(), from_aside().world_from_eye.matrix());
}

TEST(UserInteraction, WorkspacesStandUprightAtWhatIsLookedAt) {
  UserInteraction user;
  user.set_view(from_aside());
  const Pose& pose = user.stage_from_device();
  EXPECT_TRUE(pose.translation().isApprox(interaction::looked_at(from_aside()), 1e-12) ||
              pose.translation().norm() < 1e-12);
  EXPECT_TRUE((pose.linear() * Vector3::UnitY()).isApprox(Vector3::UnitY(), 1e-12));
  // From +x, the user's right is -z.
  EXPECT_TRUE((pose.linear() * Vector3::UnitX()).isApprox(-Vector3::UnitZ(), 1e-12));
  // From straight above too.
  user.set_view(interaction::orbited(from_aside(), 0.0, pi));
  EXPECT_TRUE((user.stage_from_device().linear() * Vector3::UnitX()).isApprox(-Vector3::UnitZ(), 1e-12));
}

// Rolled by a right angle the picture's right has no level part: the heading is the one that rolling led to.
TEST(UserInteraction, WorkspacesKeepTheirHeadingInAViewOnItsSide) {
  for (const double roll : {-1.0, 1.0}) {
    const auto heading = [&](double part) {
      View view = interaction::orbited(interaction::zoomed(View(), 2.0, Vector3::Zero()), 0.7, 0.0);
      view.world_from_eye.rotate(Eigen::AngleAxisd(part * roll * pi / 2.0, Vector3::UnitZ()));
      UserInteraction user(nullptr, nullptr);
      user.set_view(view);
      return Vector3(user.stage_from_device().linear().col(0));
    };
    EXPECT_LT((heading(1.0) - heading(0.9)).norm(), 1e-3) << roll;
  }
}

TEST(UserInteraction, MovingTheViewCarriesThePointers) {
  UserInteraction user;
  const Vector3 tip(0.02, -0.03, 0.05);
  user.set_view(from_aside());
  const Vector3 before = seen(user, tip);
  user.set_view(interaction::panned(user.view(), 0.3, -0.2));
  EXPECT_TRUE(seen(user, tip).isApprox(before, 1e-12));
  user.set_view(interaction::orbited(user.view(), 0.8, 0.0));
  EXPECT_TRUE(seen(user, tip).isApprox(before, 1e-12));
  user.set_view(interaction::looked_around(user.view(), 1.2, 0.0));
  EXPECT_TRUE(seen(user, tip).isApprox(before, 1e-12));
}

TEST(UserInteraction, TheNavigationDeviceMovesTheViewAndThePointersWithIt) {
  User user;
  user->set_view(from_aside());
  const View before = user->view();
  const Vector3 tip(0.02, -0.03, 0.05);
  const Vector3 in_eye = seen(*user, tip);
  user.navigation->hold(pushed(0.0, 0.0, -0.5));
  user.frames(60);  // a second at half of one distance a second
  const Vector3 went = user->view().world_from_eye.translation() - before.world_from_eye.translation();
  EXPECT_TRUE(went.isApprox(-0.5 * before.distance * before.world_from_eye.linear().col(2), 1e-9));
  EXPECT_TRUE(seen(*user, tip).isApprox(in_eye, 1e-9));
  user.navigation->hold({});
  const Pose rest = user->view().world_from_eye;
  user.frames(10);
  EXPECT_EQ(user->view().world_from_eye.matrix(), rest.matrix());
}

TEST(UserInteraction, InHandModeItMovesTheHandsAndNotTheView) {
  User user;
  user->set_view(from_aside());
  user->set_mode(NavigationMode::Hand);
  const View view = user->view();
  user.navigation->hold(pushed(0.5, 0.0, 0.0));
  user.frames(30);
  EXPECT_EQ(user->view().world_from_eye.matrix(), view.world_from_eye.matrix());
  // A quarter of the distance to the right, which is -z here.
  EXPECT_NEAR(user->stage_from_device().translation().z(), -0.25 * view.distance, 1e-9);
  // Zooming keeps its place in the picture.
  const Vector3 place = seen(*user, Vector3::Zero());
  user->set_view(interaction::zoomed(view, 0.1, interaction::looked_at(view)));
  EXPECT_TRUE(seen(*user, Vector3::Zero()).isApprox(0.1 * place, 1e-9));
  // Turning the cap turns the workspace about the vertical.
  NavigationState state;
  state.turn = {0.3, 1.0, 0.7};
  user.navigation->hold(state);
  user.frames(60);
  EXPECT_TRUE((user->stage_from_device().linear() * Vector3::UnitY()).isApprox(Vector3::UnitY(), 1e-12));
  EXPECT_TRUE((user->stage_from_device().linear() * Vector3::UnitX()).isApprox(-Vector3::UnitX(), 1e-6));
}

TEST(UserInteraction, HandsStayInSightAndCanBeRecalled) {
  User user;
  user->set_mode(NavigationMode::Hand);
  user.navigation->hold(pushed(1.0, -1.0, 1.0));
  user.frames(60 * 60);
  EXPECT_LE(
      (user->stage_from_device().translation() - interaction::looked_at(user->view())).cwiseAbs().maxCoeff(),
      2.0 * user->view().distance + 1e-9);
  user.navigation->hold({});
  user->recall_hands();
  Vector3 last = user->stage_from_device().translation();
  for (int i = 0; i < 120; ++i) {
    user.frames(1);
    EXPECT_LT((user->stage_from_device().translation() - last).norm(), 0.2 * 4.0);  // softly
    last = user->stage_from_device().translation();
  }
  EXPECT_EQ(last, interaction::looked_at(user->view()));
}

TEST(UserInteraction, ButtonsToggleTheModeAndAskForHome) {
  User user;
  user.frames(1);
  user.navigation->hold(button(1));
  user.frames(1);
  EXPECT_EQ(user->mode(), NavigationMode::Hand);
  user.frames(20);  // held
  EXPECT_EQ(user->mode(), NavigationMode::Hand);
  user.navigation->hold(button(0));
  user.frames(1);
  user.navigation->hold(button(3));
  EXPECT_TRUE(user.frames(1).home);
  EXPECT_EQ(user->mode(), NavigationMode::Camera);
}

TEST(UserInteraction, AFlightGoesItsWayUnlessSomebodySteers) {
  User user;
  user->fly_to(from_aside(), 0.3);
  user.frames(9);
  EXPECT_FALSE(user->view().world_from_eye.isApprox(from_aside().world_from_eye, 1e-3));
  user.frames(10);
  EXPECT_EQ(user->view().world_from_eye.matrix(), from_aside().world_from_eye.matrix());

  user->fly_to(View(), 0.3);
  user.frames(9);
  user.navigation->hold(pushed(0.1, 0.0, 0.0));
  user.frames(1);
  user.navigation->hold({});
  const Pose stopped = user->view().world_from_eye;
  user.frames(60);
  EXPECT_EQ(user->view().world_from_eye.matrix(), stopped.matrix());
}

TEST(UserInteraction, TheHeadMovesTheEyeAndNoPointer) {
  User user;
  user->set_head_transfer(std::nullopt);
  user->set_view(from_aside());
  const Pose before = user->stage_from_device();
  Pose head(Eigen::AngleAxisd(0.2, Vector3::UnitY()));
  head.pretranslate(Vector3(0.06, 0.0, 0.0));
  user.head->put(head);
  user.frames(1);
  EXPECT_EQ(user->stage_from_device().matrix(), before.matrix());
  EXPECT_EQ(user->view().world_from_eye.matrix(), from_aside().world_from_eye.matrix());
  const Pose moved = user->view().world_from_eye.inverse() * user->drawn_view().world_from_eye;
  EXPECT_NEAR(moved.translation().x(), 0.1 * user->view().distance, 1e-12);
  EXPECT_TRUE(moved.linear().isApprox(head.linear(), 1e-12));
}

TEST(UserInteraction, NoMotionOfTheHeadMovesAPointer) {
  User user;
  user->set_view(from_aside());
  user.frames(1);
  const Pose before = user->stage_from_device();
  base::Random random(6);
  for (int i = 0; i < 1000; ++i) {
    Pose head(Eigen::AngleAxisd(random.uniform(-3.0, 3.0), random.direction()));
    head.pretranslate(random.uniform(0.0, 1.0) * random.direction());
    user.head->put(head);
    user.frames(1);
    if (i % 100 == 99) user->recentre_head();
    ASSERT_EQ(user->stage_from_device().matrix(), before.matrix());
    ASSERT_EQ(user->view().world_from_eye.matrix(), from_aside().world_from_eye.matrix());
    ASSERT_TRUE(user->drawn_view().world_from_eye.matrix().allFinite());
  }
}

TEST(UserInteraction, TheEyeGoesAlongWithTheHeadByTheTableOfTheThesis) {
  User user;
  user->set_view(from_aside());
  const auto right = [&] {
    return (user->view().world_from_eye.inverse() * user->drawn_view().world_from_eye).translation().x() /
           user->view().distance * UserInteraction::kScreenDistance;
  };
  Pose head = Pose::Identity();
  head.translation().x() = 0.18;
  user.head->put(head);
  user.frames(5);
  EXPECT_NEAR(right(), 0.12 + 1.5 * 0.06, 1e-12);
  user->recentre_head();
  user.frames(5);
  EXPECT_NEAR(right(), 0.0, 1e-12);
  head.translation().x() = 0.24;
  user.head->put(head);
  user.frames(5);
  EXPECT_NEAR(right(), 0.06 * 0.06 / 0.12, 1e-12) << "small movements do little";
}

TEST(UserInteraction, FiltersTheHeadAsItIsTold) {
  User user;
  user->set_head_transfer(std::nullopt);
  user->set_view(View());
  const auto right = [&] {
    return user->drawn_view().world_from_eye.translation().x() * UserInteraction::kScreenDistance;
  };
  const auto put = [&](double x) {
    user.head->put(Pose(Eigen::Translation3d(x, 0.0, 0.0)));
    user.frames(1);
  };
  for (int i = 0; i < 5; ++i) put(0.0);
  put(0.05);
  EXPECT_NEAR(right(), 0.01, 1e-12) << "the mean of five";
  user->set_head_filter({interaction::HeadFilterKind::None, 0.0});
  put(0.07);
  EXPECT_NEAR(right(), 0.07, 1e-12);
  user->set_head_filter({interaction::HeadFilterKind::None, 2.0 * kFrame});
  for (int i = 0; i < 6; ++i) put(0.01 * i);
  EXPECT_NEAR(right(), 0.07, 1e-9) << "two frames ahead";
}

TEST(UserInteraction, AHeadThatIsLostEasesBackToTheMiddleAndComesSoftly) {
  User user;
  user->set_view(View());
  user.head->put(Pose(Eigen::Translation3d(0.2, 0.0, 0.0)));
  user.frames(10);
  const auto right = [&] { return user->drawn_view().world_from_eye.translation().x(); };
  const double there = right();
  ASSERT_GT(there, 0.1);
  user.head->set_status(DeviceStatus::Lost);
  const auto told = user.frames(1).devices;
  ASSERT_EQ(told.size(), 1U);
  EXPECT_TRUE(told[0].lost);
  EXPECT_NE(told[0].text.find("simulated head tracker"), std::string::npos);
  double before = right();
  EXPECT_GT(before, 0.7 * there) << "without a jump";
  for (int i = 0; i < 60; ++i) {
    user.frames(1);
    EXPECT_LE(right(), before) << "and never away from the middle";
    before = right();
  }
  EXPECT_NEAR(right(), 0.0, 1e-3);
  user.head->set_status(DeviceStatus::Ok);
  EXPECT_EQ(user.frames(1).devices.size(), 1U);
  EXPECT_LT(right(), 0.3 * there) << "back without a jump, too";
  user.frames(60);
  EXPECT_NEAR(right(), there, 1e-9);
}

TEST(UserInteraction, TheScreenIsAWindowForTheEyeWhereTheHeadIs) {
  User user;
  user->set_view(from_aside());
  const View before = user->view();
  const Pose hand = user->stage_from_device();
  const interaction::FishTank screen = {{0.5, 0.3}, 0.6};
  user->set_fish_tank(screen);
  const View& rest = user->view();
  EXPECT_NEAR(rest.distance * std::tan(0.5 * rest.field), before.distance * std::tan(0.5 * before.field),
              1e-12)
      << "as much is seen of the plane looked at";
  EXPECT_NEAR(rest.field, 2.0 * std::atan(0.15 / 0.6), 1e-12);
  EXPECT_TRUE(interaction::looked_at(rest).isApprox(interaction::looked_at(before), 1e-9));
  base::Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 place(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.5));
    const Pose head =
        Eigen::Translation3d(place) * Eigen::AngleAxisd(random.uniform(-0.5, 0.5), random.direction());
    user.head->put(head);
    user.frames(6);  // the mean of five is there
    const double scale = rest.distance / screen.distance;
    const View& drawn = user->drawn_view();
    ASSERT_LT((rest.world_from_eye.inverse() * drawn.world_from_eye.translation() - scale * place).norm(),
              1e-9)
        << "metres of the head are metres of the screen";
    ASSERT_TRUE(drawn.world_from_eye.linear().isApprox(rest.world_from_eye.linear(), 1e-12))
        << "the picture lies in the screen, however the head is turned";
    const Vector3 left = user->drawn_view(interaction::Eye::Left).world_from_eye.translation();
    const Vector3 right = user->drawn_view(interaction::Eye::Right).world_from_eye.translation();
    const Vector3 eyes = rest.world_from_eye.linear().transpose() * (right - left) / scale;
    ASSERT_LT((eyes - 0.063 * head.linear().col(0)).norm(), 1e-9) << "the eyes lie along the head's right";
    ASSERT_LT((user->stage_from_device().translation() - hand.translation()).norm(), 1e-12)
        << "no pointer moves";
    ASSERT_TRUE(user->stage_from_device().linear().isApprox(hand.linear(), 1e-12));
  }
  user->set_fish_tank(std::nullopt);
  EXPECT_TRUE(user->view().world_from_eye.isApprox(before.world_from_eye, 1e-9));
  EXPECT_NEAR(user->view().field, before.field, 1e-12);
}

TEST(UserInteraction, EyesLieApartBesideTheMiddle) {
  UserInteraction user;
  user.set_view(from_aside());
  user.set_eye_distance(0.06);
  const View& middle = user.drawn_view();
  const auto aside = [&](interaction::Eye eye) {
    return Vector3(middle.world_from_eye.inverse() * user.drawn_view(eye).world_from_eye.translation());
  };
  const double expected = 0.03 * middle.distance / UserInteraction::kScreenDistance;
  EXPECT_TRUE(aside(interaction::Eye::Left).isApprox(Vector3(-expected, 0.0, 0.0), 1e-9));
  EXPECT_TRUE(aside(interaction::Eye::Right).isApprox(Vector3(expected, 0.0, 0.0), 1e-9));
  user.set_eye_distance(0.0);
  EXPECT_TRUE(is_same_view(user.drawn_view(interaction::Eye::Left), middle));
}

TEST(UserInteraction, TellsOfDevicesThatGoAndComeBack) {
  User user;
  EXPECT_TRUE(user.frames(10).devices.empty());
  user.navigation->hold(pushed(1.0, 0.0, 0.0));
  user.frames(5);
  user.navigation->set_status(DeviceStatus::Lost);
  const auto gone = user.frames(10).devices;
  ASSERT_EQ(gone.size(), 1U);
  EXPECT_TRUE(gone[0].lost);
  EXPECT_NE(gone[0].text.find("simulated 3D mouse"), std::string::npos);
  const Pose rest = user->view().world_from_eye;
  user.frames(60);
  EXPECT_EQ(user->view().world_from_eye.matrix(), rest.matrix());  // does not fly on
  user.navigation->hold(button(3));                                // held while it is plugged in
  user.navigation->set_status(DeviceStatus::Ok);
  const UserInteraction::News back = user.frames(10);
  ASSERT_EQ(back.devices.size(), 1U);
  EXPECT_FALSE(back.devices[0].lost);
  EXPECT_FALSE(back.home);
  EXPECT_EQ(user->mode(), NavigationMode::Camera);

  Pose head = Pose::Identity();
  head.translation().x() = 0.3;
  user.head->put(head);
  user.frames(1);
  user.head->set_status(DeviceStatus::Lost);
  EXPECT_EQ(user.frames(120).devices.size(), 1U);
  EXPECT_TRUE(user->drawn_view().world_from_eye.isApprox(user->view().world_from_eye, 1e-6));
}

TEST(UserInteraction, ADeviceThatWasNeverThereIsNotMissed) {
  User user;
  user.navigation->set_status(DeviceStatus::Lost);
  EXPECT_TRUE(user.frames(10).devices.empty());
  user.navigation->set_status(DeviceStatus::Ok);
  EXPECT_EQ(user.frames(10).devices.size(), 1U);
}

TEST(UserInteraction, ADeviceThatFallsSilentIsNotFollowedForLong) {
  User user;
  user.navigation->hold(pushed(1.0, 0.0, 0.0));
  user.frames(1);
  user.navigation->set_status(DeviceStatus::Stalled);
  user.frames(60);
  const double went = user->view().world_from_eye.translation().x();
  EXPECT_GT(went, 0.1);
  EXPECT_LT(went, 0.4);
  user.frames(60);
  EXPECT_EQ(user->view().world_from_eye.translation().x(), went);
}

TEST(UserInteraction, NothingMakesAPoseUnusable) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double endless = std::numeric_limits<double>::infinity();
  for (const double bad : {none, endless, -1e300, 1e300}) {
    User user;
    View view;
    view.distance = bad;
    view.world_from_eye.translation().y() = bad;
    user->set_view(view);
    NavigationState state;
    state.push.setConstant(bad);
    state.turn.setConstant(bad);
    user.navigation->hold(state);
    Pose head;
    head.matrix().setConstant(bad);
    user.head->put(head);
    for (const auto mode : {NavigationMode::Camera, NavigationMode::Hand}) {
      user->set_mode(mode);
      user.frames(3);
      user->update(bad);
      user->fly_to(view, bad);
      user->update(bad);
      head = Pose::Identity();
      head.translation().setConstant(bad);
      user.head->put(head);
    }
    for (const Pose& pose :
         {user->view().world_from_eye, user->drawn_view().world_from_eye, user->stage_from_device()}) {
      EXPECT_TRUE(pose.matrix().allFinite()) << bad;
      EXPECT_TRUE(pose.linear().isUnitary(1e-6)) << bad;
    }
  }
}

TEST(UserInteraction, CarriesViewAndHandsAsOneAndRightsThemSoftly) {
  User user;
  user->set_view(View{});
  user.frames(1);
  const Pose eye = user->view().world_from_eye, hands = user->stage_from_device();
  const Pose by = Eigen::Translation3d(1.0, -2.0, 3.0) * Eigen::AngleAxisd(0.4, Vector3(0.6, 0.0, 0.8)) *
                  Eigen::AngleAxisd(1.1, Vector3::UnitY());
  user->carry(by);
  EXPECT_NEAR((user->view().world_from_eye.matrix() - (by * eye).matrix()).norm(), 0.0, 1e-12);
  EXPECT_NEAR((user->stage_from_device().matrix() - (by * hands).matrix()).norm(), 0.0, 1e-12);
  user.frames(1);
  EXPECT_NEAR((user->stage_from_device().matrix() - (by * hands).matrix()).norm(), 0.0, 1e-12)
      << "it may be carried on";
  user.frames(120);
  EXPECT_NEAR((user->stage_from_device().linear().col(1) - Vector3::UnitY()).norm(), 0.0, 1e-12) << "upright";
  EXPECT_NEAR((user->stage_from_device().translation() - (by * hands).translation()).norm(), 0.0, 1e-9);
  EXPECT_NEAR((user->view().world_from_eye.matrix() - (by * eye).matrix()).norm(), 0.0, 1e-12);
  const Pose there = user->view().world_from_eye;
  Pose no_way = Pose::Identity();
  no_way.translation().x() = std::numeric_limits<double>::quiet_NaN();
  user->carry(no_way);
  EXPECT_EQ(user->view().world_from_eye.matrix(), there.matrix());
}

}  // namespace
}  // namespace icome::session
