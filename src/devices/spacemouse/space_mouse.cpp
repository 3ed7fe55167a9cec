#include "devices/spacemouse/space_mouse.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "base/clock.h"
#include "devices/spacemouse/spnav_link.h"

namespace icome::devices {
namespace {

constexpr int kButtons = 32;
constexpr int kMostEvents = 4096;  // in one read, so that a flood of events cannot hold it up

}  // namespace

base::Result<std::unique_ptr<SpaceMouse>> SpaceMouse::create(const SpaceMouseSettings& settings) {
  if (!(settings.dead >= 0.0 && settings.range > settings.dead && std::isfinite(settings.range)))
    return base::fail("3D mouse: the range must be larger than the dead zone, and neither below 0");
  auto link = SpnavLink::claim();
  if (!link) return base::fail("3D mouse: another part of the program has it; close that first");
  std::unique_ptr<SpaceMouse> mouse(new SpaceMouse(std::move(link), settings));
  mouse->look_for_it();
  if (settings.wait) return mouse;
  while (mouse->link_->state() == SpnavLink::State::Opening)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (mouse->link_->state() == SpnavLink::State::Open) return mouse;
  return base::fail("no 3D mouse: spacenavd is not running; install the package spacenavd, or start it");
}

SpaceMouse::SpaceMouse(std::unique_ptr<SpnavLink> link, const SpaceMouseSettings& settings)
    : link_(std::move(link)), settings_(settings) {}

SpaceMouse::~SpaceMouse() = default;

DeviceStatus SpaceMouse::read(NavigationState& state) {
  if (link_->state() == SpnavLink::State::Closed) look_for_it();
  take_in();
  if (link_->state() != SpnavLink::State::Open || !plugged_) return DeviceStatus::Lost;
  state = state_;
  return DeviceStatus::Ok;
}

void SpaceMouse::look_for_it() {
  const std::int64_t now = base::steady_nanoseconds();
  if (now < next_look_) return;
  next_look_ = now + std::int64_t(1e9 * std::clamp(settings_.retry, 0.0, 3600.0));
  if (!SpnavLink::somebody_listens()) return;
  state_ = {};
  plugged_ = true;
  link_->open();
}

void SpaceMouse::take_in() {
  for (int i = 0; i < kMostEvents; ++i) {
    const auto event = link_->next();
    if (!event) return;
    plugged_ = event->kind != SpnavEvent::Kind::Unplugged;  // any other event shows that it is there
    switch (event->kind) {
      case SpnavEvent::Kind::Motion: {
        const auto& [x, y, z, rx, ry, rz] = event->axes;
        // Its z points away from the user, for turns, too: with z negated, both are vectors of our frame.
        state_.push = {axis(x), axis(y), -axis(z)};
        state_.turn = {axis(rx), axis(ry), -axis(rz)};
        break;
      }
      case SpnavEvent::Kind::Button: {
        if (event->button < 0 || event->button >= kButtons) break;
        const std::uint32_t bit = 1U << event->button;
        state_.buttons = event->down ? state_.buttons | bit : state_.buttons & ~bit;
        break;
      }
      case SpnavEvent::Kind::Plugged:
      case SpnavEvent::Kind::Unplugged:
        state_ = {};
        break;
    }
  }
}

double SpaceMouse::axis(int counts) const {
  const double beyond = std::abs(double(counts)) - settings_.dead;
  if (beyond <= 0.0) return 0.0;
  return std::copysign(std::min(1.0, beyond / (settings_.range - settings_.dead)), counts);
}

}  // namespace icome::devices
