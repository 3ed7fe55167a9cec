#pragma once
#include <gtest/gtest.h>

#include <memory>

#include "session/sessions.h"

namespace icome::session {

/// A session with one device, a hand with a button.
class OneHandTest : public ::testing::Test {
 protected:
  /// Starts the session, with the hand in the air above the middle of the stage.
  void start_with_hand() {
    SessionSettings settings = quiet_settings();
    auto device = hand_at(start_);
    hand_ = device.get();
    settings.pointers.push_back(std::move(device));
    session_ = start(std::move(settings));
  }
  /// Waits until added things are felt, and finds the place that the view has given the stage.
  void settle() {
    session_->settle();
    offset_ = stage_offset(*session_, start_);
  }

  // Places are of the stage, m.
  base::Vector3 tip() const { return session_->hands().pointer(0).tip; }
  void aim(const base::Vector3& place) { hand_->set_target(place - offset_); }
  /// Sets the hand down there, and waits for its tip.
  void put(const base::Vector3& place) {
    hand_->put(place - offset_);
    aim(place);
    run_until(*session_, [&] { return (tip() - place).norm() < 1e-3; });
  }
  void grab() {
    hand_->hold_buttons(1);
    run_until(*session_, [&] { return session_->hands().holds(0); });
  }
  void let_go() {
    hand_->hold_buttons(0);
    run_until(*session_, [&] { return !session_->hands().holds(0); });
  }

  devices::SimulatedDevice* hand_ = nullptr;  // of the session
  std::unique_ptr<Session> session_;
  base::Vector3 offset_ = base::Vector3::Zero();  // of the stage from the device

 private:
  const base::Vector3 start_{0.0, 1.0, 0.0};  // of the device
};

}  // namespace icome::session
