// What user studies ask of a session: every tick, a pointer that is held, forces that can be left out.
#include <gtest/gtest.h>

#include "session/sessions.h"

namespace icome::session {
namespace {

using base::Vector3;

constexpr double kAbove = 0.52;  // m, over the unit box in the middle of the stage

/// A session with a box and a hand above it.
struct HandOverBox {
  HandOverBox() {
    auto device = hand_at(Vector3::Zero());
    hand = device.get();
    SessionSettings settings = quiet_settings();
    settings.pointers.push_back(std::move(device));
    session = start(std::move(settings));
    add_box(*session, base::Affine3::Identity());
    session->hands().set_grab({.takes_hold = false});
    session->settle();
  }

  /// The hand wants to be there, stage frame.
  void aim(const Vector3& place) const {
    const PointerView& view = session->hands().pointer(0);
    base::Pose stage_from_stylus = base::Pose::Identity();
    stage_from_stylus.linear() = view.orientation.toRotationMatrix();
    stage_from_stylus.translation() = view.tip;
    hand->set_target(view.device_from_stylus * stage_from_stylus.inverse() * place);
  }

  devices::SimulatedDevice* hand = nullptr;
  std::unique_ptr<Session> session;
};

TEST(TrialMeans, EveryTickIsKeptInItsOrder) {
  HandOverBox it;
  EXPECT_TRUE(it.session->hands().take_trace().ticks.empty());
  it.session->hands().trace(true);
  std::vector<PointerView> ticks;
  while (ticks.size() < 300) {
    it.session->update();
    const SessionHands::Ticks taken = it.session->hands().take_trace();
    EXPECT_EQ(taken.lost, 0U);
    EXPECT_NE(taken.names, nullptr);
    ticks.insert(ticks.end(), taken.ticks.begin(), taken.ticks.end());
  }
  for (std::size_t i = 1; i < ticks.size(); ++i) EXPECT_GT(ticks[i].time, ticks[i - 1].time);
  it.session->hands().trace(false);
  run_until(*it.session, [&] { return it.session->hands().take_trace().ticks.empty(); });
}

TEST(TrialMeans, AHeldPointerIsPulledBackUntilItIsLetGo) {
  HandOverBox it;
  it.aim({0.0, kAbove, 0.0});
  run_until(*it.session, [&] {
    it.aim({0.0, kAbove, 0.0});
    return (it.session->hands().pointer(0).tip - Vector3(0.0, kAbove, 0.0)).norm() < 1e-3;
  });
  it.session->hands().hold_pointer(Vector3(0.0, kAbove, 0.0));
  const Vector3 away(0.006, kAbove, 0.0);
  run_until(*it.session, [&] {
    it.aim(away);
    const PointerView& view = it.session->hands().pointer(0);
    return view.force.x() < -0.5 && view.tip.x() < 0.005;  // N, m: where hand and hold are even
  });
  const double held = it.session->hands().pointer(0).tip.x();
  EXPECT_GT(held, 0.0) << "the hand pulls, too";
  EXPECT_LT(held, away.x());
  it.session->hands().hold_pointer({});
  run_until(*it.session, [&] {
    it.aim(away);
    return (it.session->hands().pointer(0).tip - away).norm() < 5e-4;
  });
  EXPECT_GT(it.session->hands().pointer(0).force.x(), -0.5) << "nothing pulls it back any more, N";
}

TEST(TrialMeans, WithoutForcesContactsAreStillTold) {
  HandOverBox it;
  it.session->hands().give_forces(false);
  it.session->hands().trace(true);
  run_until(*it.session, [&] {
    it.aim({0.0, 0.497, 0.0});
    return it.session->hands().pointer(0).touching;
  });
  run_until(*it.session, [&] { return it.session->hands().pointer(0).tip.y() < 0.4975; });
  for (const PointerView& tick : it.session->hands().take_trace().ticks) EXPECT_EQ(tick.force.norm(), 0.0);
  it.session->hands().give_forces(true);
  run_until(*it.session, [&] { return it.session->hands().pointer(0).force.y() > 0.1; });
}

TEST(TrialMeans, HandsThatTakeNoHoldLeaveThingsWhereTheyAre) {
  HandOverBox it;
  run_until(*it.session, [&] {
    it.aim({0.0, 0.498, 0.0});
    return it.session->hands().pointer(0).touching;
  });
  it.hand->hold_buttons(1);
  run_until(*it.session, [&] { return it.session->hands().pointer(0).buttons == 1; });
  it.session->update();
  EXPECT_FALSE(it.session->hands().holds(0));
}

}  // namespace
}  // namespace icome::session
