#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <type_traits>

#include "base/clock.h"
#include "devices/fakes/fake_arm.h"
#include "devices/vrpn/vrpn_server.h"
#include "realtime/this_thread.h"

namespace icome::devices::fakes {

/// A VRPN server as a maker of force-feedback devices sells it: an arm (FakeArm) with a loop of its own,
/// which shares its pose and renders what clients want, up to its strongest force. Switched off, the server
/// is gone.
class FakeVrpn {
 public:
  explicit FakeVrpn(double max_force = 3.3, const ArmSettings& settings = {})
      : max_force_(max_force), arm_(settings) {
    switch_on(true);
    thread_ = std::thread([this] { run(); });
  }
  ~FakeVrpn() {
    stop_ = true;
    thread_.join();
  }

  int port() const { return port_; }
  std::string address() const { return "Pointer0@127.0.0.1:" + std::to_string(port_); }

  void switch_on(bool on) {
    locked([&] {
      server_.reset();
      if (!on) return;
      VrpnServerSettings settings;
      settings.port = port_;
      auto server = VrpnServer::create(settings);
      if (!server) return;
      server_ = std::move(*server);
      port_ = std::stoi(server_->listening().substr(server_->listening().find(':') + 1));
    });
  }
  void aim(const base::Vector3& target) {
    locked([&] { arm_.aim(target); });
  }
  void fail(ArmFault fault) {
    locked([&] { arm_.fail(fault); });
  }
  void press(std::uint32_t buttons) {
    locked([&] { buttons_ = buttons; });
  }
  double strongest() {
    return locked([this] { return arm_.strongest(); });
  }
  double held() {
    return locked([this] { return arm_.held().norm(); });
  }
  double given() {
    return locked([this] { return arm_.given(); });
  }

 private:
  template <typename Act>
  std::invoke_result_t<Act> locked(Act act) {
    const std::lock_guard lock(guard_);
    return act();
  }

  void run() {
    const std::int64_t begin = base::steady_nanoseconds();
    std::int64_t next = begin;
    while (!stop_) {
      locked([&] { tick(base::steady_nanoseconds(), begin); });
      next = std::max(next + 1'000'000, base::steady_nanoseconds());
      realtime::sleep_until(next);
    }
  }

  void tick(std::int64_t now, std::int64_t begin) {
    const double time = 1e-9 * static_cast<double>(now - begin);
    const FakeArm::Reading reading = arm_.read(time);
    PointerState state;
    state.position = reading.position;
    state.velocity = reading.velocity;
    state.buttons = buttons_;
    base::Vector3 force = base::Vector3::Zero();
    if (server_) force = server_->wanted_force(state, now);
    if (force.norm() > max_force_) force *= max_force_ / force.norm();
    arm_.push(force, time);
    if (server_) server_->feed(state, force);
  }

  double max_force_;
  std::mutex guard_;
  FakeArm arm_;
  std::uint32_t buttons_ = 0;
  int port_ = 0;
  std::unique_ptr<VrpnServer> server_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace icome::devices::fakes
